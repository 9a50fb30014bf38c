//! From pest's productions to the syntax tree, with a message for each mistake on the way.

mod behavior;
mod block;
mod expr;
mod item;
mod learn;
mod number;
pub(super) use number::units_note;
mod task;
mod tree;
mod world;

use super::ast::{Comment, Expr, ExprKind, File, Ident, Item, ItemKind, Spanned};
use super::brackets;
use super::comments::docs_before;
use super::diagnose::{self, Failure};
use super::grammar::{self, Node, Parts, Rule};
use super::tokens::{Kind, Token, is_blank};
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::{FileId, Span};

/// What the tree is built with.
pub(super) struct Builder<'i> {
    file: FileId,
    text: &'i str,
    tokens: &'i [Token],
    comments: &'i [Comment],
    diagnostics: Vec<Diagnostic>,
    /// Where the last text that could not be parsed failed: what begins before that place has been reported.
    failed_at: Option<usize>,
}

impl<'i> Builder<'i> {
    pub(super) fn new(
        file: FileId,
        text: &'i str,
        tokens: &'i [Token],
        comments: &'i [Comment],
    ) -> Self {
        Self {
            file,
            text,
            tokens,
            comments,
            diagnostics: Vec::new(),
            failed_at: None,
        }
    }

    /// The tree of a whole file, and what is wrong with it.
    pub(super) fn file(mut self, node: Node<'i>) -> (File, Vec<Diagnostic>) {
        let mut items = Vec::new();
        let mut previous = None;
        for part in Parts::of(node) {
            let start = part.as_span().start();
            match part.as_rule() {
                Rule::stray_mark => self.stray_mark(&part),
                Rule::stray_close => self.stray_close(&part),
                Rule::EOI => {}
                Rule::bad_item => {
                    let span = self.bad(&part, Rule::strict_item, previous);
                    let docs = self.docs(start);
                    items.push(Item {
                        docs,
                        kind: ItemKind::Error,
                        span,
                    });
                }
                _ => {
                    previous = Some(start);
                    items.push(self.item(part));
                }
            }
        }
        let file = File {
            items,
            comments: self.comments.to_vec(),
            span: Span::new(self.file, 0, self.text.len()),
        };
        (file, self.diagnostics)
    }

    // ---- places

    /// The place of a production, without the blanks and comments that pest leaves at its end.
    fn span(&self, node: &Node<'i>) -> Span {
        let (start, end) = (node.as_span().start(), node.as_span().end());
        Span::new(self.file, start, self.trim(start, end))
    }

    fn trim(&self, start: usize, end: usize) -> usize {
        let after = self.tokens.partition_point(|token| token.end <= end);
        self.tokens
            .get(..after)
            .unwrap_or_default()
            .iter()
            .rev()
            .find(|token| token.kind != Kind::Comment)
            .map_or(start, |token| token.end.max(start))
    }

    /// The first token at or after byte `at` that is no comment.
    fn token_at(&self, at: usize) -> Option<Token> {
        let first = self.tokens.partition_point(|token| token.end <= at);
        self.tokens
            .get(first..)
            .unwrap_or_default()
            .iter()
            .find(|token| token.kind != Kind::Comment)
            .copied()
    }

    fn docs(&self, start: usize) -> Vec<String> {
        docs_before(self.text, self.comments, start).0
    }

    fn slice(&self, span: Span) -> &'i str {
        self.text.get(span.range()).unwrap_or_default()
    }

    // ---- messages

    fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Reports a token that has one right spelling here.
    fn respell(&mut self, code: Code, span: Span, message: String, right: &str) {
        let diagnostic = Diagnostic::new(code, span, message)
            .label(format!("write `{right}`"))
            .fix(format!("write `{right}`"), span, right, Applicability::Safe);
        self.report(diagnostic);
    }

    /// Reports text that does not parse as `strict`, which is tried again on it, or on what stands before it.
    fn bad(&mut self, node: &Node<'i>, strict: Rule, previous: Option<usize>) -> Span {
        let span = self.span(node);
        let start = node.as_span().start();
        if self.failed_at.is_some_and(|at| start <= at) {
            return span;
        }
        let mut failure = self.try_again(strict, start, start);
        if failure.at == start
            && let Some(previous) = previous
        {
            let again = self.try_again(strict, previous, start);
            if again.at > start || self.goes_on(start) {
                failure = again;
            }
        }
        if previous.is_some() && self.is_juxtaposed(start, failure.at) {
            failure.at = start;
            failure.expected.clear();
        }
        let (at, diagnostic) = diagnose::failure(self.file, self.text, self.tokens, &failure);
        self.failed_at = Some(at);
        self.report(diagnostic);
        span
    }

    /// Whether a text begins on the line of what stands before it and fails at its second token, which does not look
    /// like the second one of an entry: then it is the first one that does not belong there.
    fn is_juxtaposed(&self, start: usize, at: usize) -> bool {
        let index = self.tokens.partition_point(|token| token.end <= start);
        let token = |index: usize| {
            self.tokens
                .get(index)
                .filter(|token| token.kind != Kind::Comment)
        };
        let before = index.checked_sub(1).and_then(token);
        let (Some(before), Some(first), Some(second)) = (before, token(index), token(index + 1))
        else {
            return false;
        };
        let is_entry =
            before.of(self.text) == "{" || first.kind != Kind::Word || second.kind == Kind::Mark;
        self.goes_on(start) && !is_entry && second.start == at
    }

    /// Whether something stands before byte `start` on its line.
    fn goes_on(&self, start: usize) -> bool {
        let before = self.text.get(..start).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default();
        !line.chars().all(is_blank)
    }

    fn try_again(&self, strict: Rule, from: usize, start: usize) -> Failure {
        let rest = self.text.get(from..).unwrap_or_default();
        match grammar::parse(strict, rest) {
            Ok(_) => Failure {
                start,
                at: start,
                expected: Vec::new(),
                strict,
            },
            Err(stop) => {
                let blanks = |at: usize| {
                    let rest = self.text.get(at..).unwrap_or_default();
                    rest.find(|letter| !is_blank(letter)).unwrap_or(rest.len())
                };
                let at = (from + stop.at).max(start);
                Failure {
                    start,
                    at: at + blanks(at),
                    expected: stop.expected,
                    strict,
                }
            }
        }
    }

    fn stray_mark(&mut self, node: &Node<'i>) {
        let span = self.span(node);
        let mark = self.slice(span);
        let diagnostic =
            Diagnostic::new(Code::E0118, span, format!("nothing needs a `{mark}` here"))
                .label("drop it")
                .note("an entry ends where the next one begins")
                .fix(format!("drop the `{mark}`"), span, "", Applicability::Safe);
        self.report(diagnostic);
    }

    fn stray_close(&mut self, node: &Node<'i>) {
        let span = self.span(node);
        if self.failed_at.is_some_and(|at| span.range().start <= at) {
            return;
        }
        let mark = self.slice(span);
        let open = if mark == ")" { "(" } else { "{" };
        let diagnostic =
            Diagnostic::new(Code::E0103, span, format!("this `{mark}` closes nothing"))
                .label(format!("no `{open}` is open here"))
                .fix(
                    format!("drop the `{mark}`"),
                    span,
                    "",
                    Applicability::Unsafe,
                );
        self.report(diagnostic);
    }

    /// Takes the bracket that closes a block; reports it if it is missing.
    fn close(&mut self, node: Option<Node<'i>>, open: Option<Span>) {
        let Some(node) = node.filter(|node| node.as_rule() == Rule::missing_close) else {
            return;
        };
        let at = node.as_span().start();
        if self.failed_at.is_some_and(|failed| at <= failed) {
            return;
        }
        self.failed_at = Some(at);
        if let Some(open) = open {
            let diagnostic = brackets::unclosed(self.file, self.text, self.tokens, open, at);
            self.report(diagnostic);
        }
    }

    // ---- small parts

    fn name(&self, node: &Node<'i>) -> Ident {
        let written = node.as_str();
        let name = written
            .strip_prefix('`')
            .and_then(|name| name.strip_suffix('`'));
        Ident {
            name: name.unwrap_or(written).to_owned(),
            span: self.span(node),
        }
    }

    /// The next part as a name; pest has made sure that it is there.
    fn take_name(&self, parts: &mut Parts<'i>) -> Ident {
        match parts.maybe(Rule::name) {
            Some(node) => self.name(&node),
            None => Ident {
                name: String::new(),
                span: Span::new(self.file, 0, 0),
            },
        }
    }

    fn spanned<T>(&self, node: &Node<'i>, value: T) -> Spanned<T> {
        Spanned {
            node: value,
            span: self.span(node),
        }
    }

    /// Takes the `=` of a declaration, and reports `==` and `:=`.
    fn take_is(&mut self, parts: &mut Parts<'i>) -> bool {
        let Some(node) = parts.maybe(Rule::is) else {
            return false;
        };
        self.single_equals(&node);
        true
    }

    fn single_equals(&mut self, node: &Node<'i>) {
        let written = node.as_str();
        if matches!(written, "==" | ":=") {
            let span = self.span(node);
            self.respell(
                Code::E0108,
                span,
                format!("a value is given with `=`, not with `{written}`"),
                "=",
            );
        }
    }

    fn error_expr(&self, span: Span) -> Expr {
        Expr {
            kind: ExprKind::Error,
            span,
        }
    }
}
