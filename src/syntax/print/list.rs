//! Lists in parentheses: arguments and parameters.

use super::Printer;
use super::doc::{Brackets, Break, Doc, Entry, Part, row};
use super::names::{ident, type_expr};
use crate::source::Span;
use crate::syntax::ast::{Arg, ArgKind, Param, Params, Ref};

impl Printer<'_> {
    /// A name with its arguments.
    pub(super) fn call<'a>(&self, call: &'a Ref) -> Doc<'a> {
        self.call_with(call, |args| args)
    }

    /// A call whose arguments stand in columns.
    pub(super) fn call_in_columns<'a>(&self, call: &'a Ref) -> Doc<'a> {
        self.call_with(call, |mut args| {
            if let Part::List(list) = &mut args.part {
                list.columns = true;
            }
            args
        })
    }

    fn call_with<'a>(&self, call: &'a Ref, list: impl FnOnce(Doc<'a>) -> Doc<'a>) -> Doc<'a> {
        let name = ident(&call.name);
        let doc = match &call.args {
            Some(args) => row![name, list(self.args(args, call.span))],
            None => name,
        };
        doc.grouped(call.span, Break::TooLong)
            .settled(call.span.range().end)
    }

    /// The arguments of a call that stands at `call`.
    pub(super) fn args<'a>(&self, args: &'a [Arg], call: Span) -> Doc<'a> {
        let entries = args
            .iter()
            .map(|arg| Entry::new(arg.span, self.arg(arg)))
            .collect();
        in_parens(entries, call)
    }

    pub(super) fn arg<'a>(&self, arg: &'a Arg) -> Doc<'a> {
        match &arg.kind {
            ArgKind::Positional(value) => self.expr(value),
            ArgKind::Named(name, value) => row![ident(name), " = ", self.expr(value)],
            ArgKind::Range(low, high) => row![self.expr(low), " .. ", self.expr(high)],
            ArgKind::Binder {
                name, domain, body, ..
            } => {
                let head = row![ident(name), " in ", ident(domain)];
                match body {
                    Some(body) => row![head, ": ", self.expr(body)],
                    None => head,
                }
            }
        }
    }

    /// Parameters, one a line where one line cannot hold them.
    pub(super) fn params<'a>(&self, params: Option<&'a Params>) -> Doc<'a> {
        let Some(params) = params else {
            return Doc::nothing();
        };
        let list = self.param_list(params).grouped(params.span, Break::TooLong);
        row![Doc::hoist(params.span.range().start), list]
    }

    /// Parameters on one line.
    pub(super) fn flat_params<'a>(&self, params: Option<&'a Params>) -> Doc<'a> {
        params.map_or(Doc::nothing(), |params| self.param_list(params).flat())
    }

    fn param_list<'a>(&self, params: &'a Params) -> Doc<'a> {
        let entries = params
            .params
            .iter()
            .map(|param| Entry::new(param.span, self.param(param)))
            .collect();
        in_parens(entries, params.span)
    }

    fn param<'a>(&self, param: &'a Param) -> Doc<'a> {
        let head = row![ident(&param.name), ": ", type_expr(&param.ty)];
        match &param.default {
            Some(value) => row![head, " = ", self.expr(value)].flat(),
            None => head,
        }
    }
}

/// Entries in parentheses; these are never broken where they are empty.
fn in_parens(entries: Vec<Entry<'_>>, span: Span) -> Doc<'_> {
    if entries.is_empty() {
        Doc::from("()")
    } else {
        Doc::list(Brackets::PARENS, span, entries)
    }
}
