//! `any`, `all`, `count` and `nearest` over the members of a kind.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::context::Binding;
use crate::check::types::{Type, Typed};
use crate::diagnostic::Code;
use crate::syntax::ast::{ArgKind, Ident, Ref};

impl<'a> Checker<'a> {
    /// Whether a type has members that something can range over; reported if not.
    pub fn has_members(&mut self, ty: &Type, domain: &Ident) -> bool {
        let has = matches!(ty, Type::Place(_) | Type::Wall(_) | Type::Enum(_));
        if !has {
            self.error(
                Code::E0302,
                domain.span,
                format!("`{}` has no members to range over", domain.name),
            )
            .label("a kind of places or walls, or an enum, is needed");
        }
        has
    }

    /// `any(b in bush: …)` and its relatives.
    pub fn quantified(&mut self, function: Function, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        let binder = match reference.args.as_deref() {
            Some([arg]) => match &arg.kind {
                ArgKind::Binder { name, domain, body } => Some((name, domain, body)),
                _ => None,
            },
            _ => None,
        };
        let Some((name, domain, body)) = binder else {
            return self
                .error(
                    Code::E0305,
                    span,
                    format!("`{}` ranges over a kind", reference.name.name),
                )
                .label(format!("write `{}(x in KIND: …)`", reference.name.name))
                .none();
        };
        let ty = self.named_type(domain);
        if ty == Type::Error || !self.has_members(&ty, domain) {
            return None;
        }
        self.context.scope.push(Binding::unknown(name, ty.clone()));
        if let Some(body) = body {
            let role = format!("what `{}` says of each", reference.name.name);
            self.expect(body, &Type::Bool, &role);
        } else if matches!(function, Function::Any | Function::All) {
            self.error(
                Code::E0305,
                domain.span,
                format!("`{}` says nothing of its members", reference.name.name),
            )
            .label("a condition is missing after this: `: condition`");
            self.context.scope.pop();
            return None;
        }
        self.context.scope.pop();
        self.not_yet(reference.name.span, "`any`, `all`, `count` and `nearest`");
        let ty = match function {
            Function::Count => Type::NUMBER,
            Function::Nearest => ty,
            _ => Type::Bool,
        };
        Some(Typed::unknown(ty, span))
    }
}
