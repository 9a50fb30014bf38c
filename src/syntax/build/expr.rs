//! Expressions.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::ast::{Axis, BinaryOp, Expr, ExprKind, Spanned, UnaryOp, chain};
use crate::syntax::diagnose::{ends_after, unclosed_quote, unfinished};
use crate::syntax::grammar::{Node, Parts, Rule};

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
            Rule::expr | Rule::conjunct => return self.junction(node),
            Rule::comparison | Rule::sum | Rule::term => return self.chain(node),
            Rule::negation | Rule::unary => return self.prefixed(node, span),
            Rule::power => return self.power(node),
            Rule::quantity => return self.quantity(node),
            Rule::boolean => ExprKind::Bool(node.as_str() == "true"),
            Rule::r#ref => self.name_or_call(node),
            Rule::choice => ExprKind::If(Box::new(self.choice(node))),
            Rule::paren => self.paren(node),
            Rule::list_expr => return self.take_expr(&mut Parts::of(node)),
            Rule::price_time => return self.price_time(node),
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
        let mut parts = Parts::of(node);
        let left = self.take_expr(&mut parts);
        self.compared(left, &mut parts, Rule::wrong_equals)
    }

    /// What `left` is compared with by a `=`, which is reported; `left` itself where the next part is no `wrong` sign.
    pub(super) fn compared(&mut self, left: Expr, parts: &mut Parts<'i>, wrong: Rule) -> Expr {
        let Some(sign) = parts.maybe(wrong) else {
            return left;
        };
        let place = self.span(&sign);
        let range = (left.span.range().start, place.range().start);
        if let Some(last) = unfinished(self.text, self.tokens, range) {
            let at = Span::new(self.file, last.start, last.end);
            let diagnostic = ends_after(at, last.of(self.text), "a value", "line");
            self.report(diagnostic);
        } else if sign.as_str() == "=>" {
            self.respell(Code::E0110, place, "`=>` is written `>=`".into(), ">=");
        } else {
            let rest = self.text.get(place.range().end..).unwrap_or_default();
            match rest.strip_prefix('!') {
                Some(rest) if !rest.starts_with('=') => {
                    let mark = Span::new(self.file, place.range().start, place.range().end + 1);
                    self.respell(Code::E0110, mark, "`=!` is written `!=`".into(), "!=");
                }
                _ => {
                    let message = "`=` gives a value; two values are compared with `==`";
                    self.respell(Code::E0109, place, message.to_owned(), "==");
                }
            }
        }
        let right = self.take_expr(parts);
        self.error_expr(left.span.to(right.span))
    }

    /// `a or b or c`
    fn junction(&mut self, node: Node<'i>) -> Expr {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let listed = std::mem::take(&mut self.in_list);
        let mut operands = vec![self.take_expr(&mut parts)];
        let mut signs = Vec::new();
        while let Some(sign) = parts.next() {
            if listed && matches!(sign.as_str(), "|" | "||" | "&" | "&&") {
                return self.parted_by_mark(&sign, parts, span);
            }
            if sign.as_rule() == Rule::wrong_choice {
                let asked = chain(operands, signs).unwrap_or_else(|| self.error_expr(span));
                return self.wrong_choice(asked, &sign, parts);
            }
            let joins_nodes = operands
                .last()
                .is_some_and(|it| self.joins_nodes(&sign, it));
            signs.push(match (joins_nodes, sign.as_str()) {
                (true, "|" | "||") => self.spanned(&sign, BinaryOp::Or),
                (true, _) => self.spanned(&sign, BinaryOp::And),
                (false, _) => self.binary(&sign),
            });
            operands.push(self.take_expr(&mut parts));
        }
        chain(operands, signs).unwrap_or_else(|| self.error_expr(span))
    }

    /// Reports `a | b` where a list has commas.
    fn parted_by_mark(&mut self, sign: &Node<'i>, rest: Parts<'i>, span: Span) -> Expr {
        let (mark, place) = (sign.as_str(), self.span(sign));
        let blank = place.range().start.saturating_sub(1);
        let from = match self.text.get(blank..place.range().start) {
            Some(" ") => blank,
            _ => place.range().start,
        };
        let message = format!("the entries of a list are parted by commas, not by `{mark}`");
        let mut diagnostic = Diagnostic::new(Code::E0101, place, message)
            .label("write `,`")
            .fix(
                "write `,`",
                Span::new(self.file, from, place.range().end),
                ",",
                Applicability::Unsafe,
            );
        if rest.into_iter().any(|part| part.as_str() == mark) {
            diagnostic = diagnostic.help("so are the others");
        }
        self.report(diagnostic);
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
            if self.by_one(left.span, op.span, &right) {
                return left;
            }
            if matches!(op.node, BinaryOp::Add | BinaryOp::Sub) {
                self.odd_sign(left.span, op.span, right.span);
            }
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

    /// Whether a mark joins what is run: then it is no `or`, in whatever spelling, which is told of its operands.
    fn joins_nodes(&self, sign: &Node<'i>, left: &Expr) -> bool {
        self.in_tree && matches!(sign.as_str(), "|" | "||" | "&" | "&&") && self.is_behavior(left)
    }

    fn binary(&mut self, sign: &Node<'i>) -> Spanned<BinaryOp> {
        let written = sign.as_str();
        let (op, right) = match written {
            "or" | "OR" | "Or" | "||" | "|" => (BinaryOp::Or, "or"),
            "and" | "AND" | "And" | "but" | "&&" | "&" => (BinaryOp::And, "and"),
            "==" | "===" | "is" => (BinaryOp::Eq, "=="),
            "!=" | "!==" | "<>" | "≠" => (BinaryOp::Ne, "!="),
            "<=" | "≤" | "=<" => (BinaryOp::Le, "<="),
            ">=" | "≥" => (BinaryOp::Ge, ">="),
            "<" => (BinaryOp::Lt, "<"),
            ">" => (BinaryOp::Gt, ">"),
            "+" => (BinaryOp::Add, "+"),
            "*" | "×" | "·" => (BinaryOp::Mul, "*"),
            "/" | "÷" => (BinaryOp::Div, "/"),
            "^" | "**" => (BinaryOp::Pow, "^"),
            is_not if is_not.starts_with("is") => (BinaryOp::Ne, "!="),
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
        self.doubled_sign(&sign, &operand);
        let written = sign.as_str();
        let (op, right) = match written {
            "not" | "NOT" | "Not" | "!" | "¬" => (UnaryOp::Not, "not"),
            "+" => (UnaryOp::Pos, "+"),
            _ => (UnaryOp::Neg, "-"),
        };
        if written == "!" && self.is_leaf(&operand) {
            let whole = self.span(&sign).to(operand.span);
            let right = format!("invert {{ {} }}", self.slice(operand.span));
            let message = "`!` negates conditions, and this is a node";
            self.report(
                Diagnostic::new(Code::E0110, self.span(&sign), message)
                    .label("a node is turned round by `invert`")
                    .fix(
                        format!("write `{right}`"),
                        whole,
                        right,
                        Applicability::Unsafe,
                    ),
            );
        } else if written == "!" && self.follows_lone_equals(&sign) {
            // `=!` is told as a whole.
        } else if matches!(written, "!" | "¬") {
            let place = self.span(&sign);
            let right = if operand.span.start == place.end {
                "not "
            } else {
                "not"
            };
            let code = match written {
                "!" => Code::E0110,
                _ => Code::E0121,
            };
            self.respell(code, place, format!("`{written}` is written `not`"), right);
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

    fn follows_lone_equals(&self, sign: &Node<'i>) -> bool {
        let before = self.text.get(..self.span(sign).range().start);
        let rest = before.and_then(|before| before.strip_suffix('='));
        rest.is_some_and(|rest| !rest.ends_with(['=', '!', '<', '>', ':', '+', '-', '*', '/']))
    }

    /// Whether an expression is a behaviour or a subtree, as far as the text shows.
    fn is_leaf(&self, expr: &Expr) -> bool {
        let ExprKind::Ref(reference) = &expr.kind else {
            return false;
        };
        self.names_leaf(&reference.name.name)
    }

    fn power(&mut self, node: Node<'i>) -> Expr {
        let mut parts = Parts::of(node);
        let mut left = self.take_expr(&mut parts);
        if let Some(node) = parts.maybe(Rule::coordinate) {
            let axis = match node.as_str() {
                ".x" => Axis::X,
                _ => Axis::Y,
            };
            left = Expr {
                span: left.span.to(self.span(&node)),
                kind: ExprKind::Coordinate(Box::new(left), axis),
            };
        }
        while let Some(node) = parts.maybe(Rule::wrong_field) {
            left = self.wrong_field(left, node);
        }
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
            let inner = self.compared(first, &mut parts, Rule::wrong_paren_equals);
            ExprKind::Paren(Box::new(inner))
        }
    }

    fn text_in_expr(&mut self, span: Span) {
        let written = self.slice(span);
        let inner = written.trim_matches(['"', '“', '”']);
        let mut diagnostic = Diagnostic::new(Code::E0107, span, "no text can stand here")
            .label("the language has no values of text")
            .note("quotation marks are for the paths of `use`");
        let number = inner.trim().parse::<f64>().is_ok_and(f64::is_finite);
        if number {
            let title = "write the number, without quotation marks";
            diagnostic = diagnostic.fix(title, span, inner.trim(), Applicability::Unsafe);
        } else if !inner.is_empty() && !inner.contains('`') {
            let name = spelled(inner).into_owned();
            let title = "name something, without quotation marks";
            diagnostic = diagnostic.fix(title, span, name, Applicability::Unsafe);
        }
        self.report(diagnostic);
    }

    /// `c ? a : b`, as other languages choose.
    fn wrong_choice(&mut self, cond: Expr, sign: &Node<'i>, mut parts: Parts<'i>) -> Expr {
        let then = self.take_expr(&mut parts);
        parts.has(Rule::colon);
        let otherwise = self.take_expr(&mut parts);
        let span = cond.span.to(otherwise.span);
        let [c, a, b] = [cond.span, then.span, otherwise.span].map(|span| self.slice(span));
        let (right, form) = match self.in_tree {
            true => (
                format!("selector {{ {c} => {a}, {b} }}"),
                "selector { … => …, … }",
            ),
            false => (
                format!("if {c} {{ {a} }} else {{ {b} }}"),
                "if … { … } else { … }",
            ),
        };
        // A selector goes on to its last child where the first one fails, too.
        let applicability = match self.in_tree {
            true => Applicability::Unsafe,
            false => Applicability::Safe,
        };
        let place = self.span(sign);
        let diagnostic = Diagnostic::new(Code::E0110, place, format!("`? :` is written `{form}`"))
            .label("not an operator here")
            .fix(format!("write `{right}`"), span, right, applicability);
        self.report(diagnostic);
        self.error_expr(span)
    }

    pub(super) fn unclosed_text(&mut self, node: &Node<'i>) {
        let quote = node.as_str().chars().next().unwrap_or('"');
        let diagnostic = unclosed_quote(self.file, self.starts(node), quote);
        self.failed_at = Some(self.span(node).range().end);
        self.report(diagnostic);
    }
}
