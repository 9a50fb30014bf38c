//! Behaviours: bodies are checked for themselves, then once more for every set of arguments that is used.

use crate::check::Checker;
use crate::check::context::Region;
use crate::check::types::{Type, Value};
use crate::diagnostic::Code;
use crate::ir::expr::{Expr, Local};
use crate::ir::law::{Behavior, Law};
use crate::ir::program::Stays;
use crate::ir::table::Table;
use crate::ir::{Id, Name};
use crate::syntax::ast::{self, BehaviorBody, Ref};

/// The id of a behaviour with its arguments.
pub type BehaviorId = Id<Behavior>;

impl<'a> Checker<'a> {
    /// Checks a behaviour for itself.
    pub fn behavior(&mut self, behavior: &'a ast::Behavior) {
        if self.bodies.clean.contains_key(&behavior.name.span) {
            return;
        }
        let scope = self.unknown_parameters(behavior.params.as_ref());
        self.body_for_itself(&behavior.name, Region::Clause, scope, |checker| {
            checker.behavior_body(behavior, Table::default());
        });
    }

    /// The behaviour with the given arguments: a known value, or an unknown one inside a body that is checked for
    /// itself. `None` if a mistake was reported.
    pub fn behavior_instance(
        &mut self,
        behavior: &'a ast::Behavior,
        library: bool,
        reference: &'a Ref,
    ) -> Option<Value> {
        // What an alias holds is held by what it stands for.
        let mut locals = std::mem::take(&mut self.held);
        if !library {
            self.behavior(behavior);
        }
        let params = behavior.params.as_ref();
        let mut scope = self.bind_arguments(params, library, reference)?;
        if scope.iter().any(|binding| binding.value == Value::Unknown) {
            return Some(Value::Unknown);
        }
        let name = self.instance_name(behavior.params.as_ref(), reference, &scope);
        let name = self.owned(name);
        if let Some(known) = self.behaviors.get(&name).copied() {
            self.calls_library(library, reference, known);
            return known.map(Value::Behavior);
        }
        // Arguments that change are evaluated at the start and held, but for a `target`, which is read afresh.
        let held = scope.iter_mut().filter(|it| it.ty != Type::Target);
        for binding in held {
            binding.value = binding.value.clone().map(|id| {
                if self.program.pool.constant(id).is_some() {
                    return id;
                }
                let local = locals.push(Local {
                    name: Name::word(&binding.name.name),
                    initial: id,
                    stays: Stays::ANY,
                });
                self.program.pool.leaf(Expr::Local(local))
            });
        }
        let body = behavior.name.span;
        let region = Region::Clause;
        let law = self.unrolled(body, reference, library, region, scope, |checker| {
            checker.behavior_body(behavior, locals)
        });
        let id = law.flatten().map(|law| {
            self.program.behaviors.push(Behavior {
                name: name.clone(),
                law,
            })
        });
        self.calls_library(library, reference, id);
        self.behaviors.insert(name, id);
        id.map(Value::Behavior)
    }

    /// The law of a behaviour whose arguments `locals` hold; one that is declared only has none.
    fn behavior_body(
        &mut self,
        behavior: &'a ast::Behavior,
        locals: Table<Local>,
    ) -> Option<Option<Law>> {
        match &behavior.body {
            BehaviorBody::Declared => {
                // Whoever runs it reads what it is given.
                for param in behavior.params.iter().flat_map(|params| &params.params) {
                    self.reads(param.name.span);
                }
                Some(None)
            }
            BehaviorBody::Alias(target) => {
                self.context.region = Region::Tree;
                self.held = locals;
                let target = self.alias(target);
                self.held = Table::default();
                let target = target?;
                Some(self.program.behaviors[target].law.clone())
            }
            BehaviorBody::Clauses(clauses) => self.law(clauses, locals).map(Some),
        }
    }

    fn alias(&mut self, target: &'a Ref) -> Option<BehaviorId> {
        let typed = self.reference(target)?;
        match (&typed.ty, &typed.value) {
            (_, Value::Behavior(id)) => Some(*id),
            (Type::Behavior | Type::Error, _) => None,
            (other, _) => self
                .error(Code::E0203, target.span, "an alias names a behaviour")
                .this_is(other)
                .none(),
        }
    }
}
