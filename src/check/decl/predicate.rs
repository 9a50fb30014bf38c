//! Predicates and their families.

use crate::check::Checker;
use crate::check::context::{Binding, Region};
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::ir::Id;
use crate::ir::expr::ExprId;
use crate::ir::program::Predicate;
use crate::syntax::ast::{self, Ref};

/// The id of a predicate with its arguments.
pub type PredicateId = Id<Predicate>;

impl<'a> Checker<'a> {
    /// Checks a predicate for itself.
    pub fn predicate(&mut self, predicate: &'a ast::Predicate) {
        if self.bodies.clean.contains_key(&predicate.name.span) {
            return;
        }
        let scope = self.unknown_parameters(predicate.params.as_ref());
        self.body_for_itself(&predicate.name, Region::Predicate, scope, |checker| {
            checker.predicate_body(predicate);
        });
    }

    fn predicate_body(&mut self, predicate: &'a ast::Predicate) -> Option<ExprId> {
        let Some(value) = predicate.value.as_ref() else {
            // What it says of its arguments is said by those who use it.
            let params = predicate.params.iter().flat_map(|it| &it.params);
            params.for_each(|param| self.reads(param.name.span));
            return None;
        };
        let role = format!("the predicate `{}`", predicate.name.name);
        self.expect(value, &Type::Bool, &role).scalar()
    }

    fn bound(
        &mut self,
        predicate: &'a ast::Predicate,
        library: bool,
        reference: &'a Ref,
    ) -> Option<Vec<Binding<'a>>> {
        if !library {
            self.predicate(predicate);
        }
        let params = predicate.params.as_ref();
        self.bind_arguments(params, library, reference)
    }

    /// A predicate as a truth value in an expression.
    pub fn predicate_value(
        &mut self,
        predicate: &'a ast::Predicate,
        library: bool,
        reference: &'a Ref,
    ) -> Option<Typed> {
        let span = reference.span;
        let scope = self.bound(predicate, library, reference)?;
        if predicate.value.is_none() {
            return self
                .error(
                    Code::E0207,
                    span,
                    format!("the predicate `{}` is declared only", reference.name.name),
                )
                .label("it has no definition to evaluate")
                .also(predicate.name.span, "declared here, without `= …`")
                .none();
        }
        let value = self.predicate_under(scope, predicate, library, reference);
        Some(Typed::new(Type::Bool, value, span))
    }

    /// The predicate with the given arguments, as an atom of tables and trees.
    pub fn predicate_instance(
        &mut self,
        predicate: &'a ast::Predicate,
        library: bool,
        reference: &'a Ref,
    ) -> Option<PredicateId> {
        let scope = self.bound(predicate, library, reference)?;
        if scope.iter().any(|binding| binding.value == Value::Unknown) {
            return None;
        }
        let name = self.instance_name(predicate.params.as_ref(), reference, &scope);
        let name = self.owned(name);
        if let Some(known) = self.predicates.get(&name) {
            return *known;
        }
        // A predicate that is declared only has no value, and is an atom all the same.
        let when = match predicate.value {
            Some(_) => self
                .predicate_under(scope, predicate, library, reference)
                .map(Some),
            None => Some(None),
        };
        let id = when.map(|when| {
            let name = name.clone();
            self.program.predicates.push(Predicate { name, when })
        });
        self.predicates.insert(name, id);
        id
    }

    /// The value of a predicate under arguments.
    fn predicate_under(
        &mut self,
        scope: Vec<Binding<'a>>,
        predicate: &'a ast::Predicate,
        library: bool,
        reference: &'a Ref,
    ) -> Option<ExprId> {
        let body = predicate.name.span;
        let region = Region::Predicate;
        self.unrolled(body, reference, library, region, scope, |checker| {
            checker.predicate_body(predicate)
        })
        .flatten()
    }
}
