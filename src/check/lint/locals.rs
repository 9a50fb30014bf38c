//! Which values the locals of behaviours may have: what they start with, and what the control law sets them to.

use super::cases::of_expr;
use super::causes::Lacks;
use super::ranges::range;
use super::view::View;
use super::widening::{one_of_these, settle};
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::{Expr, ExprId, Local, Temp};
use crate::ir::law::{Behavior, Block, Law, Stmt};
use crate::ir::program::Stays;
use crate::ir::table::Table;
use crate::ir::{Id, Name, Program};
use crate::syntax::ast::{self, BehaviorBody, ClauseKind, Ident, Item, ItemKind};
use std::collections::BTreeMap;

/// How often the locals of a behaviour are gone through at most.
const PASSES: usize = 3;

/// What sets each local of a behaviour.
type Set = BTreeMap<Id<Local>, Vec<ExprId>>;

impl<'a> Checker<'a> {
    /// Finds out which values the locals may have that control laws set, and warns of those that never change.
    ///
    /// Of a local that nothing sets, or that is set to itself, nothing is found out: that is told where it stands.
    pub fn values_of_locals(&mut self, items: impl Iterator<Item = &'a Item>) {
        if self.values_are_unsure() {
            return;
        }
        self.values_of_names();
        for at in 0..self.program.behaviors.len() {
            let id = Id::new(at);
            let locals = settled(&self.program, &self.program.behaviors[id]);
            if let (Some(locals), Some(law)) = (locals, &mut self.program.behaviors[id].law) {
                law.locals = locals;
            }
        }
        let mut families: BTreeMap<String, Vec<Id<Behavior>>> = BTreeMap::new();
        for (id, behavior) in self.program.behaviors.iter() {
            let family = behavior.name.family.clone();
            families.entry(family).or_default().push(id);
        }
        for item in items {
            if let ItemKind::Behavior(behavior) = &item.kind
                && let Some(instances) = families.get(&behavior.name.name)
            {
                self.locals_that_stay(behavior, instances);
            }
        }
    }

    /// Finds out which values the names may have that statements bind to what is read of the world, where one robot reads it. Of what
    /// is made of a state or a local, nothing is found out: why that has its values is told of it by its own name.
    fn values_of_names(&mut self) {
        let lets = std::mem::take(&mut self.lets);
        if !self.has_one_robot() {
            return;
        }
        let program = &self.program;
        let view = View::from(program);
        let of_world = lets.into_iter().filter(|(_, value)| {
            !program.pool.any(*value, &mut |part| {
                matches!(part, Expr::State(_) | Expr::Local(_) | Expr::Temp(_))
            })
        });
        let found = of_world.map(|(temp, value)| {
            let never = |wanted| of_expr(view, value, wanted).is_never();
            let stays = match [true, false].map(never) {
                [true, _] => Stays::Among(0b01),
                [_, true] => Stays::Among(0b10),
                _ => {
                    let (low, high) = range(view, value).ends();
                    Stays::Within(low..=high)
                }
            };
            (temp, stays)
        });
        let found: Vec<(Id<Temp>, Stays)> = found.collect();
        for (temp, stays) in found {
            self.program.temps[temp].stays = stays;
        }
    }

    /// Warns of locals that whatever sets them leaves as they are declared. Of what follows from that, nothing is said.
    fn locals_that_stay(&mut self, behavior: &'a ast::Behavior, instances: &[Id<Behavior>]) {
        let BehaviorBody::Clauses(clauses) = &behavior.body else {
            return;
        };
        for clause in clauses {
            let ClauseKind::Local { name, .. } = &clause.kind else {
                continue;
            };
            let own = self.locals_of(instances, name);
            let stays = |(behavior, local): &(Id<Behavior>, Id<Local>)| {
                let law = self.program.behaviors[*behavior].law.as_ref();
                law.is_some_and(|law| law.locals[*local].stays.is_one())
            };
            if own.is_empty() || !own.iter().all(stays) || name.name.starts_with('_') {
                continue;
            }
            for (behavior, local) in own {
                if let Some(law) = &mut self.program.behaviors[behavior].law {
                    law.locals[local].stays = Stays::ANY;
                }
            }
            let message = format!("the local `{}` never changes", name.name);
            self.warning(Code::W0205, name.span, message)
                .label("it stays as it is declared here")
                .note("whatever sets it sets it to this value");
        }
    }

    /// The locals that have this name in these instances of a behaviour.
    fn locals_of(
        &self,
        instances: &[Id<Behavior>],
        name: &Ident,
    ) -> Vec<(Id<Behavior>, Id<Local>)> {
        let mut found = Vec::new();
        for &id in instances {
            let law = self.program.behaviors[id].law.as_ref();
            let locals = law.into_iter().flat_map(|law| law.locals.iter());
            let named = locals.filter(|(_, local)| local.name == Name::word(&name.name));
            found.extend(named.map(|(local, _)| (id, local)));
        }
        found
    }

    /// What a local of these behaviours lacks, in words, if what `rests` says of each of them would not be so of all if the local had it.
    pub fn lacking_local(
        &mut self,
        behaviors: &[Id<Behavior>],
        rests: &dyn Fn(&Program, Id<Behavior>) -> bool,
    ) -> Option<String> {
        let law = self.program.behaviors[*behaviors.first()?].law.clone()?;
        for (id, local) in law.locals.iter() {
            for lacks in Lacks::of(&local.stays, 2) {
                let kept: Vec<Option<Law>> = behaviors
                    .iter()
                    .map(|behavior| self.program.behaviors[*behavior].law.clone())
                    .collect();
                for behavior in behaviors {
                    if let Some(law) = &mut self.program.behaviors[*behavior].law {
                        law.locals[id].stays = lacks.free(&law.locals[id].stays);
                    }
                }
                let rested = behaviors.iter().all(|it| rests(&self.program, *it));
                for (behavior, law) in behaviors.iter().zip(kept) {
                    self.program.behaviors[*behavior].law = law;
                }
                if !rested {
                    let initial = self.program.pool.constant(local.initial);
                    return Some(lacks.in_words(&local.name.family, &local.stays, initial, &[]));
                }
            }
        }
        None
    }
}

/// The locals of a behaviour with the values that they may have.
fn settled(program: &Program, behavior: &Behavior) -> Option<Table<Local>> {
    let mut law = behavior.law.clone()?;
    let mut set = Set::new();
    of_block(&law.control, &mut set);
    let itself = |local: Id<Local>, value: &ExprId| program.pool.get(*value) == Expr::Local(local);
    set.retain(|local, values| !values.iter().any(|value| itself(*local, value)));
    // What a local is set to may read one that comes after it.
    for _ in 0..PASSES {
        for (&local, values) in &set {
            let initial = law.locals[local].initial;
            let is_truth = matches!(program.pool.get(initial), Expr::Bool(_));
            let given = |law: &Law, values: &[ExprId]| {
                let view = View {
                    law: Some(law),
                    ..View::of(program, &behavior.name)
                };
                let settings = values.iter().map(|value| (view, *value));
                one_of_these(&program.pool, Expr::Local(local), is_truth, settings)
            };
            let first = given(&law, &[initial]);
            law.locals[local].stays = match is_truth {
                true => first.or(&given(&law, values)),
                false => settle(&first, values.len(), &mut |stays, which| {
                    law.locals[local].stays = stays.clone();
                    given(&law, values.get(which).unwrap_or_default())
                }),
            };
        }
    }
    Some(law.locals)
}

/// What sets each local in a block.
fn of_block(block: &Block, found: &mut Set) {
    for statement in &block.0 {
        match statement {
            Stmt::SetLocal(local, value) => found.entry(*local).or_default().push(*value),
            Stmt::If(_, then, otherwise) => {
                of_block(then, found);
                of_block(otherwise, found);
            }
            Stmt::Let(..) | Stmt::SetState(..) | Stmt::Drive { .. } => {}
        }
    }
}
