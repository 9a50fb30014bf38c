//! Names, and calls with their arguments.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Arg, ArgKind, Expr, ExprKind, Ident, Ref};
use crate::syntax::diagnose::no_such_unit;
use crate::syntax::grammar::{Node, Parts, Rule};
use crate::syntax::tokens::Kind;

impl<'i> Builder<'i> {
    pub(super) fn name_or_call(&mut self, node: Node<'i>) -> ExprKind {
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
        let mut is_unit = false;
        for part in Parts::of(node) {
            match part.as_rule() {
                // What was to be a unit is no argument.
                Rule::arg if std::mem::take(&mut is_unit) => {
                    if let Some(Arg { kind, .. }) = args.last_mut()
                        && let ArgKind::Positional(value) | ArgKind::Named(_, value) = kind
                    {
                        value.kind = ExprKind::Error;
                    }
                }
                Rule::arg => args.push(self.arg(part)),
                Rule::missing_arg_comma if self.unit_is_meant(&part, args.last()) => {
                    is_unit = true;
                }
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
            let value = self.take_expr(&mut parts);
            if parts.has(Rule::range_to) {
                ArgKind::Range(value, self.take_expr(&mut parts))
            } else {
                ArgKind::Positional(value)
            }
        };
        Arg { kind, span }
    }

    fn binder(&mut self, node: Node<'i>) -> ArgKind {
        let mut parts = Parts::of(node);
        let name = self.take_name(&mut parts);
        parts.has(Rule::kw_in);
        let domain = self.take_name(&mut parts);
        let body = parts.has(Rule::colon).then(|| self.take_expr(&mut parts));
        let span = name.span;
        let member = Box::new(Expr {
            kind: ExprKind::Ref(Ref {
                name: name.clone(),
                args: None,
                span,
            }),
            span,
        });
        ArgKind::Binder {
            name,
            domain,
            body,
            member,
        }
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
}
