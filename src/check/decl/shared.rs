//! Shared expressions.

use crate::check::Checker;
use crate::check::context::Region;
use crate::check::types::Typed;
use crate::syntax::ast::{ArgKind, Let, LetBody, Ref};

impl<'a> Checker<'a> {
    /// Checks a `let` for itself.
    pub fn shared(&mut self, shared: &'a Let) {
        if self.bodies.clean.contains_key(&shared.name.span) {
            return;
        }
        let bindings = self.unknown_parameters(shared.params.as_ref());
        self.body_for_itself(&shared.name, Region::Let, bindings, |checker| {
            let typed = checker.shared_body(shared);
            checker.is_of_type(&shared.name, &typed.ty);
        });
    }

    fn shared_body(&mut self, shared: &'a Let) -> Typed {
        match (&shared.body, &shared.ty) {
            (LetBody::Expr(value), ty) => self.declared(ty.as_ref(), value, &shared.name.name),
            (LetBody::Yield(body), None) => self.yielded(body),
            (LetBody::Yield(body), Some(written)) => {
                let typed = self.yielded(body);
                let wanted = self.type_expr(written);
                let role = format!("`{}`", shared.name.name);
                self.coerce(typed, &body.value, &wanted, &role)
            }
        }
    }

    /// Looks at what a `let` of the library is given for its `course`.
    fn courses(&mut self, shared: &'a Let, reference: &'a Ref) {
        let params = shared.params.iter().flat_map(|params| &params.params);
        let names: Vec<&str> = params.map(|param| param.name.name.as_str()).collect();
        let args = reference.args.iter().flatten();
        for (arg, at) in args.zip(&names) {
            match &arg.kind {
                ArgKind::Positional(value) if *at == "course" => self.bearing_for_course(value),
                ArgKind::Named(name, value) if name.name == "course" => {
                    self.bearing_for_course(value);
                }
                _ => {}
            }
        }
    }

    /// The value of a `let` where a reference uses it.
    pub fn shared_call(
        &mut self,
        shared: &'a Let,
        library: bool,
        reference: &'a Ref,
    ) -> Option<Typed> {
        if !library {
            self.shared(shared);
        }
        let scope = self.bind_arguments(shared.params.as_ref(), library, reference)?;
        if library {
            self.courses(shared, reference);
        }
        let body = shared.name.span;
        let region = self.context.region;
        self.unrolled(body, reference, library, region, scope, |checker| {
            checker.shared_body(shared)
        })
    }
}
