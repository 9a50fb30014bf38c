//! From pest's productions to the syntax tree, with a message for each mistake on the way.

mod behavior;
mod block;
mod call;
mod choice;
mod commas;
mod entries;
mod expr;
mod field;
mod item;
mod joints;
mod layout;
mod learn;
mod lost;
mod number;
mod task;
mod test;
mod tree;
mod world;

use super::ast::{Comment, Expr, ExprKind, File, Ident, Item, ItemKind, Lost, Spanned};
use super::comments::docs_before;
use super::glance::Glance;
use super::grammar::{Node, Parts, Rule};
use super::tokens::{Kind, Token, is_blank};
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::{FileId, Span};
pub use number::unit;
use std::cell::OnceCell;

/// What the tree is built with.
pub(super) struct Builder<'i> {
    file: FileId,
    text: &'i str,
    tokens: &'i [Token],
    comments: &'i [Comment],
    /// What the text declares, once it was asked.
    glance: OnceCell<Glance<'i>>,
    /// Where the text begins whose productions are at hand.
    base: usize,
    diagnostics: Vec<Diagnostic>,
    /// Where the last text that could not be parsed failed: what begins before that place has been reported.
    failed_at: Option<usize>,
    /// Up to where statements are the rest of one that was not understood.
    lost_until: usize,
    /// What the mistakes have taken so far.
    lost: Lost,
    /// Where a `{` is missing, so that a `}` may be missing around it.
    unopened: Vec<usize>,
    /// Whether the arguments at hand are of what ranges over a kind.
    ranging: bool,
    /// Whether the call at hand ranges over a kind and binds nothing, which is reported.
    unbound: bool,
    /// How many words stand where units should, as statements of their own.
    units_missed: usize,
    /// Whether the expression at hand is a node of a tree.
    in_tree: bool,
    /// Whether the next expression is an entry of a list.
    in_list: bool,
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
            glance: OnceCell::new(),
            base: 0,
            diagnostics: Vec::new(),
            failed_at: None,
            lost_until: 0,
            lost: Lost::default(),
            unopened: Vec::new(),
            ranging: false,
            unbound: false,
            units_missed: 0,
            in_tree: false,
            in_list: false,
        }
    }

    /// The items among productions of a text that begins at byte `base`, after the item at `previous`.
    pub(super) fn items(
        &mut self,
        base: usize,
        nodes: impl IntoIterator<Item = Node<'i>>,
        previous: Option<Span>,
    ) -> Vec<Item> {
        let mut items = Vec::new();
        self.base = base;
        self.entries_after(previous, nodes, Rule::strict_item, |builder, node, span| {
            let docs = builder.docs(span);
            let kind = node.map_or(ItemKind::Error, |node| builder.item(node));
            items.push(Item { docs, kind, span });
        });
        items
    }

    /// The tree of a whole file with these items, and what is wrong with them.
    pub(super) fn file(self, items: Vec<Item>) -> (File, Vec<Diagnostic>) {
        let file = File {
            items,
            comments: self.comments.to_vec(),
            span: Span::new(self.file, 0, self.text.len()),
            lost: self.lost,
        };
        (file, self.diagnostics)
    }

    /// What the text declares, as its tokens show it.
    fn glance(&self) -> &Glance<'i> {
        self.glance
            .get_or_init(|| Glance::of(self.text, self.tokens))
    }

    // ---- places

    /// The first byte of a production.
    fn starts(&self, node: &Node<'i>) -> usize {
        self.base + node.as_span().start()
    }

    /// One past the last byte of a production.
    fn ends(&self, node: &Node<'i>) -> usize {
        self.base + node.as_span().end()
    }

    /// The place of a production, without the blanks and comments that pest leaves at its end.
    fn span(&self, node: &Node<'i>) -> Span {
        let (start, end) = (self.starts(node), self.ends(node));
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

    /// The first token at or after byte `at` that is not a comment.
    fn token_at(&self, at: usize) -> Option<Token> {
        let first = self.tokens.partition_point(|token| token.end <= at);
        self.tokens
            .get(first..)
            .unwrap_or_default()
            .iter()
            .find(|token| token.kind != Kind::Comment)
            .copied()
    }

    /// The documentation right above what stands at `span`.
    fn docs(&self, span: Span) -> Vec<String> {
        docs_before(self.text, self.comments, span.range().start)
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
            .label(format!("write `{}`", right.trim()))
            .fix(
                format!("write `{}`", right.trim()),
                span,
                right,
                Applicability::Safe,
            );
        self.report(diagnostic);
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

    /// Takes the `=` of a declaration, and reports `==` and `:=`, and `:` where no type can stand.
    fn take_is(&mut self, parts: &mut Parts<'i>) -> bool {
        if let Some(node) = parts.maybe(Rule::wrong_is) {
            self.wrong_is(&node);
            return true;
        }
        let Some(node) = parts.maybe(Rule::is) else {
            return false;
        };
        self.single_equals(&node);
        true
    }

    /// Reports a `:` before a value.
    fn wrong_is(&mut self, node: &Node<'i>) {
        let span = self.span(node);
        let message = "a value is given with `=`, not with `:`".to_owned();
        let touches = self.text.get(..span.range().start);
        let right = match touches.is_some_and(|before| before.ends_with(is_blank)) {
            true => "=",
            false => " =",
        };
        self.respell(Code::E0127, span, message, right);
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
