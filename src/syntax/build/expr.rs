//! Expressions.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{
    Arg, ArgKind, BinaryOp, Choice, Expr, ExprKind, Ident, Otherwise, Ref, Spanned, UnaryOp, Yield,
};
use crate::syntax::diagnose::{no_such_unit, quote_name};
use crate::syntax::grammar::{Node, Parts, Rule};
use crate::syntax::tokens::Kind;

impl<'i> Builder<'i> {
    /// The next part as an expression; pest has made sure that it is there.
    pub(super) fn take_expr(&mut self, parts: &mut Parts<'i>) -> Expr {
        match parts.next() {
            Some(node) => self.expr(node),
            None => self.error_expr(Span::new(self.file, 0, 0)),
        }
    }

    pub(super) fn expr(&mut self, node: Node<'i>) -> Expr {
        let span = self.span(&node);
        let kind = match node.as_rule() {
            Rule::condition => return self.condition(node),
            Rule::expr | Rule::conjunct | Rule::comparison | Rule::sum | Rule::term => {
                return self.chain(node);
            }
            Rule::negation | Rule::unary => return self.prefixed(node, span),
            Rule::power => return self.power(node),
            Rule::quantity => return self.quantity(node),
            Rule::boolean => ExprKind::Bool(node.as_str() == "true"),
            Rule::r#ref => self.name_or_call(node),
            Rule::choice => ExprKind::If(Box::new(self.choice(node))),
            Rule::paren => self.paren(node),
            Rule::string => {
                self.text_in_expr(span);
                ExprKind::Error
            }
            Rule::unclosed_string | Rule::unclosed_name => {
                self.unclosed_text(&node);
                ExprKind::Error
            }
            _ => ExprKind::Error,
        };
        Expr { kind, span }
    }

    fn condition(&mut self, node: Node<'i>) -> Expr {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let left = self.take_expr(&mut parts);
        let Some(sign) = parts.maybe(Rule::wrong_equals) else {
            return left;
        };
        let place = self.span(&sign);
        let message = "`=` gives a value; two values are compared with `==`".to_owned();
        self.respell(Code::E0109, place, message, "==");
        self.take_expr(&mut parts);
        self.error_expr(span)
    }

    /// `a + b - c`, leaning to the left.
    fn chain(&mut self, node: Node<'i>) -> Expr {
        let compares = node.as_rule() == Rule::comparison;
        let mut parts = Parts::of(node);
        let mut left = self.take_expr(&mut parts);
        let mut first: Option<Spanned<BinaryOp>> = None;
        while let Some(sign) = parts.next() {
            let op = self.binary(&sign);
            let right = self.take_expr(&mut parts);
            let span = left.span.to(right.span);
            if compares && let Some(first) = first {
                self.comparisons(first, op, span);
                left = self.error_expr(span);
                break;
            }
            first = first.or(Some(op));
            left = self.joined(left, op, right, span);
        }
        left
    }

    fn joined(&mut self, left: Expr, op: Spanned<BinaryOp>, right: Expr, span: Span) -> Expr {
        if op.node == BinaryOp::Div
            && let Some(quantity) = self.blank_in_unit(&left, &right, span)
        {
            return quantity;
        }
        Expr {
            kind: ExprKind::Binary {
                op,
                left: Box::new(left),
                right: Box::new(right),
            },
            span,
        }
    }

    fn comparisons(&mut self, first: Spanned<BinaryOp>, second: Spanned<BinaryOp>, span: Span) {
        let message = "comparisons do not chain";
        let whole = self.slice(span);
        let middle_start = first.span.range().end;
        let middle = self
            .text
            .get(middle_start..second.span.range().start)
            .unwrap_or_default()
            .trim();
        let mut diagnostic = Diagnostic::new(Code::E0111, second.span, message)
            .label("a second comparison")
            .also(first.span, "the first one");
        if !middle.is_empty() && whole.len() < 80 {
            diagnostic = diagnostic.fix(
                "compare twice",
                second.span.before(),
                format!("and {middle} "),
                Applicability::Unsafe,
            );
        }
        self.report(diagnostic.help("join two comparisons with `and`"));
    }

    fn binary(&mut self, sign: &Node<'i>) -> Spanned<BinaryOp> {
        let written = sign.as_str();
        let (op, right) = match written {
            "or" | "||" | "|" => (BinaryOp::Or, "or"),
            "and" | "&&" | "&" => (BinaryOp::And, "and"),
            "==" | "===" => (BinaryOp::Eq, "=="),
            "!=" | "!==" | "<>" | "≠" => (BinaryOp::Ne, "!="),
            "<=" | "≤" => (BinaryOp::Le, "<="),
            ">=" | "≥" => (BinaryOp::Ge, ">="),
            "<" => (BinaryOp::Lt, "<"),
            ">" => (BinaryOp::Gt, ">"),
            "+" => (BinaryOp::Add, "+"),
            "*" | "×" | "·" => (BinaryOp::Mul, "*"),
            "/" | "÷" => (BinaryOp::Div, "/"),
            "^" | "**" => (BinaryOp::Pow, "^"),
            _ => (BinaryOp::Sub, "-"),
        };
        self.operator(sign, written, right);
        self.spanned(sign, op)
    }

    /// Reports an operator in the spelling of another language, or of a word processor.
    fn operator(&mut self, sign: &Node<'i>, written: &str, right: &str) {
        if written == right {
            return;
        }
        let code = if written.is_ascii() {
            Code::E0110
        } else {
            Code::E0121
        };
        let span = self.span(sign);
        self.respell(
            code,
            span,
            format!("`{written}` is written `{right}`"),
            right,
        );
    }

    fn prefixed(&mut self, node: Node<'i>, span: Span) -> Expr {
        let mut parts = Parts::of(node);
        let sign = parts
            .maybe(Rule::not_op)
            .or_else(|| parts.maybe(Rule::sign));
        let operand = self.take_expr(&mut parts);
        let Some(sign) = sign else {
            return operand;
        };
        let written = sign.as_str();
        let (op, right) = match written {
            "not" | "!" | "¬" => (UnaryOp::Not, "not"),
            "+" => (UnaryOp::Pos, "+"),
            _ => (UnaryOp::Neg, "-"),
        };
        if written == "!" {
            let place = self.span(&sign);
            let right = if operand.span.start == place.end {
                "not "
            } else {
                "not"
            };
            self.respell(Code::E0110, place, "`!` is written `not`".into(), right);
        } else {
            self.operator(&sign, written, right);
        }
        Expr {
            kind: ExprKind::Unary {
                op: self.spanned(&sign, op),
                operand: Box::new(operand),
            },
            span,
        }
    }

    fn power(&mut self, node: Node<'i>) -> Expr {
        let mut parts = Parts::of(node);
        let left = self.take_expr(&mut parts);
        let Some(sign) = parts.maybe(Rule::power_op) else {
            return left;
        };
        let op = self.binary(&sign);
        let right = self.take_expr(&mut parts);
        let span = left.span.to(right.span);
        self.joined(left, op, right, span)
    }

    fn paren(&mut self, node: Node<'i>) -> ExprKind {
        let mut parts = Parts::of(node);
        parts.has(Rule::open_paren);
        let first = self.take_expr(&mut parts);
        if parts.has(Rule::comma) {
            let second = self.take_expr(&mut parts);
            ExprKind::Point(Box::new(first), Box::new(second))
        } else {
            ExprKind::Paren(Box::new(first))
        }
    }

    // ---- choices

    fn choice(&mut self, node: Node<'i>) -> Choice {
        self.choice_parts(Parts::of(node))
    }

    fn choice_parts(&mut self, mut parts: Parts<'i>) -> Choice {
        let place = parts.maybe(Rule::kw_if).map(|node| self.span(&node));
        let cond = self.take_expr(&mut parts);
        let then = self.take_yield(&mut parts);
        let otherwise = match parts.maybe(Rule::choice_else) {
            Some(node) => self.choice_else(node, place.unwrap_or(cond.span), then.span),
            None => Otherwise::Yield(self.no_yield(then.span.after())),
        };
        Choice {
            cond,
            then,
            otherwise,
        }
    }

    fn choice_else(&mut self, node: Node<'i>, place: Span, then: Span) -> Otherwise {
        let mut parts = Parts::of(node);
        if let Some(word) = parts.maybe(Rule::wrong_else_if) {
            self.else_if(&word);
            let span = self.span(&word);
            let choice = self.choice_parts(parts);
            let end = otherwise_end(&choice.otherwise);
            return Otherwise::If(Box::new(choice), span.to(end));
        }
        if parts.has(Rule::missing_else) {
            let diagnostic = Diagnostic::new(Code::E0126, place, "a value by `if` needs an `else`")
                .label("what is the value if this does not hold?")
                .also(then, "the value if it holds");
            self.report(diagnostic);
            return Otherwise::Yield(self.no_yield(then.after()));
        }
        parts.has(Rule::kw_else);
        match parts.maybe(Rule::choice) {
            Some(node) => {
                let span = self.span(&node);
                Otherwise::If(Box::new(self.choice(node)), span)
            }
            None => Otherwise::Yield(self.take_yield(&mut parts)),
        }
    }

    fn take_yield(&mut self, parts: &mut Parts<'i>) -> Yield {
        match parts.maybe(Rule::r#yield) {
            Some(node) => self.yields(node),
            None => self.no_yield(Span::new(self.file, 0, 0)),
        }
    }

    fn no_yield(&self, span: Span) -> Yield {
        Yield {
            bindings: Vec::new(),
            value: Box::new(self.error_expr(span)),
            span,
        }
    }

    pub(super) fn yields(&mut self, node: Node<'i>) -> Yield {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        parts.has(Rule::open_brace);
        let mut bindings = Vec::new();
        while let Some(node) = parts.maybe(Rule::binding) {
            bindings.push(self.binding(node));
        }
        let value = Box::new(self.take_expr(&mut parts));
        if let Some(mark) = parts.maybe(Rule::stray_mark) {
            self.stray_mark(&mark);
        }
        Yield {
            bindings,
            value,
            span,
        }
    }

    // ---- names and calls

    fn name_or_call(&mut self, node: Node<'i>) -> ExprKind {
        let call = self.reference(node);
        let right = match call.name.name.as_str() {
            "True" | "TRUE" => "true",
            "False" | "FALSE" => "false",
            _ => return ExprKind::Ref(call),
        };
        if call.args.is_some()
            || self.declares(&call.name.name)
            || self.slice(call.span).starts_with('`')
        {
            return ExprKind::Ref(call);
        }
        let message = format!("`{}` is written `{right}`", call.name.name);
        self.respell(Code::E0119, call.span, message, right);
        ExprKind::Bool(right == "true")
    }

    pub(super) fn reference(&mut self, node: Node<'i>) -> Ref {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let written = parts.maybe(Rule::name);
        let name = written.as_ref().map_or(
            Ident {
                name: String::new(),
                span,
            },
            |node| self.name(node),
        );
        let args = parts.maybe(Rule::args).map(|args| {
            if let Some(written) = written.as_ref() {
                self.touching(written, &args);
            }
            self.args(args)
        });
        Ref { name, args, span }
    }

    /// Reports blanks between a name and its parenthesis.
    pub(super) fn touching(&mut self, name: &Node<'i>, args: &Node<'i>) {
        let (end, start) = (name.as_span().end(), args.as_span().start());
        if end == start {
            return;
        }
        let open = Span::new(self.file, start, start + 1);
        let diagnostic = Diagnostic::new(Code::E0113, open, "the `(` of a call touches its name")
            .label("a blank stands before this")
            .fix(
                "drop the blank",
                Span::new(self.file, end, start),
                "",
                Applicability::Safe,
            );
        self.report(diagnostic);
    }

    pub(super) fn args(&mut self, node: Node<'i>) -> Vec<Arg> {
        let mut args: Vec<Arg> = Vec::new();
        for part in Parts::of(node) {
            match part.as_rule() {
                Rule::arg => args.push(self.arg(part)),
                Rule::missing_arg_comma if self.unit_is_meant(&part, args.last()) => {}
                Rule::missing_arg_comma => {
                    let before = args.last().map(|arg| arg.span);
                    self.missing_comma(&part, before, "arguments");
                }
                _ => {}
            }
        }
        args
    }

    /// Reports a word that follows a number as no unit, rather than as an argument of its own.
    fn unit_is_meant(&mut self, node: &Node<'i>, before: Option<&Arg>) -> bool {
        let value = before.map(|arg| &arg.kind);
        let (Some(ArgKind::Positional(value) | ArgKind::Named(_, value)), Some(word)) =
            (value, self.token_at(node.as_span().start()))
        else {
            return false;
        };
        let bare = matches!(&value.kind, ExprKind::Number(literal) if literal.unit.is_none());
        let gap = self
            .text
            .get(value.span.range().end..word.start)
            .unwrap_or_default();
        if !bare || gap.contains('\n') || word.kind != Kind::Word {
            return false;
        }
        let span = Span::new(self.file, word.start, word.end);
        let diagnostic = no_such_unit(span, self.slice(span), &[]);
        self.report(diagnostic);
        true
    }

    fn arg(&mut self, node: Node<'i>) -> Arg {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let kind = if let Some(node) = parts.maybe(Rule::binder) {
            self.binder(node)
        } else if let Some(node) = parts.maybe(Rule::named) {
            self.named(node)
        } else {
            ArgKind::Positional(self.take_expr(&mut parts))
        };
        Arg { kind, span }
    }

    fn binder(&mut self, node: Node<'i>) -> ArgKind {
        let mut parts = Parts::of(node);
        let name = self.take_name(&mut parts);
        parts.has(Rule::kw_in);
        let domain = self.take_name(&mut parts);
        let body = parts.has(Rule::colon).then(|| self.take_expr(&mut parts));
        ArgKind::Binder { name, domain, body }
    }

    fn named(&mut self, node: Node<'i>) -> ArgKind {
        let mut parts = Parts::of(node);
        let name = self.take_name(&mut parts);
        if let Some(sign) = parts.maybe(Rule::named_is)
            && sign.as_str() == ":"
        {
            let span = self.span(&sign);
            let diagnostic = Diagnostic::new(
                Code::E0127,
                span,
                format!(
                    "the argument `{}` is given with `=`, not with `:`",
                    name.name
                ),
            )
            .label("write `=`")
            .fix(
                "write `=`",
                name.span.after().to(span),
                " =",
                Applicability::Safe,
            );
            self.report(diagnostic);
        }
        let value = self.take_expr(&mut parts);
        ArgKind::Named(name, value)
    }

    // ---- texts

    fn text_in_expr(&mut self, span: Span) {
        let written = self.slice(span);
        let inner = written.trim_matches(['"', '“', '”']);
        let mut diagnostic = Diagnostic::new(Code::E0107, span, "no text can stand here")
            .label("the language has no values of text")
            .note("quotation marks are for the paths of `use`");
        if !inner.is_empty() && !inner.contains('`') {
            diagnostic = diagnostic.fix(
                "name something, in backquotes",
                span,
                format!("`{inner}`"),
                Applicability::Unsafe,
            );
        }
        self.report(diagnostic);
    }

    pub(super) fn unclosed_text(&mut self, node: &Node<'i>) {
        let start = node.as_span().start();
        let span = self.span(node);
        let quote = node.as_str().chars().next().unwrap_or('"');
        let place = Span::new(self.file, start, start + quote.len_utf8());
        let message = format!("this {} is not closed on its line", quote_name(quote));
        let diagnostic = Diagnostic::new(Code::E0106, place, message)
            .label("no second one follows")
            .note("names and texts do not go over the end of a line");
        self.failed_at = Some(span.range().end);
        self.report(diagnostic);
    }
}

/// The place at which what follows an `else` ends.
fn otherwise_end(otherwise: &Otherwise) -> Span {
    match otherwise {
        Otherwise::If(_, span) => *span,
        Otherwise::Yield(end) => end.span,
    }
}
