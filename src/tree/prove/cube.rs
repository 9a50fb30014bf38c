//! What a tree selects in all minterms of a cube: the cube is split only where what it leaves free decides.

use super::plan::{Plan, Reading};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Guard};
use crate::policy::{Minterm, Row};
use rustc_hash::FxHashMap;

/// What a tree comes to in a cube.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    Selects(Id<Behavior>),
    Success,
    Failure,
    /// It hangs on this atom, which the cube leaves free.
    Open(usize),
}

/// A cube: the values of its atoms, and which of them are free.
pub(super) struct Cube<'a> {
    positions: &'a FxHashMap<Atom, usize>,
    reading: Reading,
    values: Vec<bool>,
    free: Vec<bool>,
}

/// What was found where a tree does something else than it should.
pub(super) enum Fault {
    /// It does this here.
    Decides(Minterm, Option<Id<Behavior>>),
    /// The steps did not suffice.
    Spent,
}

impl<'a> Cube<'a> {
    /// The cube that a row stands for; `positions` are those of the policy's atoms.
    pub(super) fn new(row: &Row, positions: &'a FxHashMap<Atom, usize>, reading: Reading) -> Self {
        let atoms = row.minterm.len();
        let free = row.free.as_ref();
        Self {
            positions,
            reading,
            values: row.minterm.values().collect(),
            free: (0..atoms)
                .map(|i| free.is_some_and(|free| free.get(i)))
                .collect(),
        }
    }

    /// Whether a tree selects the behaviour in every minterm of the cube; `steps` are the cubes that may be looked at.
    pub(super) fn selects(
        &mut self,
        plan: &Plan,
        behavior: Id<Behavior>,
        steps: &mut usize,
    ) -> Result<(), Fault> {
        *steps = steps.checked_sub(1).ok_or(Fault::Spent)?;
        let decided = match self.node(plan) {
            Outcome::Open(atom) => {
                for value in [false, true] {
                    self.set(atom, value, false);
                    self.selects(plan, behavior, steps)?;
                }
                self.set(atom, false, true);
                return Ok(());
            }
            Outcome::Selects(chosen) => Some(chosen),
            Outcome::Success | Outcome::Failure => None,
        };
        match decided == Some(behavior) {
            true => Ok(()),
            false => Err(Fault::Decides(
                Minterm::new(self.values.iter().copied()),
                decided,
            )),
        }
    }

    fn set(&mut self, atom: usize, value: bool, free: bool) {
        if let (Some(v), Some(f)) = (self.values.get_mut(atom), self.free.get_mut(atom)) {
            (*v, *f) = (value, free);
        }
    }

    fn node(&self, plan: &Plan) -> Outcome {
        match plan {
            Plan::Condition(guard) => match self.holds(guard) {
                Ok(true) => Outcome::Success,
                Ok(false) => Outcome::Failure,
                Err(atom) => Outcome::Open(atom),
            },
            Plan::Behavior(behavior) => Outcome::Selects(*behavior),
            Plan::Reactive(kind, children) => {
                let passed = passed(*kind);
                let mut children = children.iter().map(|child| self.node(child));
                children
                    .find(|outcome| *outcome != passed)
                    .unwrap_or(passed)
            }
            Plan::Resuming(_, children) => match self.stands(children) {
                Ok(child) => child.map_or(Outcome::Failure, |(child, _)| self.node(child)),
                Err(atom) => Outcome::Open(atom),
            },
            Plan::Decorated(kind, child) => match (kind, self.node(child)) {
                (Decorator::Succeed, Outcome::Failure) => Outcome::Success,
                (Decorator::Fail, Outcome::Success) => Outcome::Failure,
                (Decorator::Invert, Outcome::Failure) => Outcome::Success,
                (Decorator::Invert, Outcome::Success) => Outcome::Failure,
                (_, outcome) => outcome,
            },
        }
    }

    /// The child at which a memory node stands.
    fn stands<'p, 't>(
        &self,
        children: &'p [(Plan<'t>, Vec<Atom>)],
    ) -> Result<Option<&'p (Plan<'t>, Vec<Atom>)>, usize> {
        let mut at = children.first();
        for ((_, ended), next) in children.iter().zip(children.iter().skip(1)) {
            let here =
                self.any(ended)? && (self.reading == Reading::Furthest || !self.any(&next.1)?);
            if here {
                at = Some(next);
                if self.reading == Reading::Unfinished {
                    break;
                }
            }
        }
        Ok(at)
    }

    fn any(&self, atoms: &[Atom]) -> Result<bool, usize> {
        first(atoms.iter().map(|atom| self.atom(*atom)), true)
    }

    fn atom(&self, atom: Atom) -> Result<bool, usize> {
        let Some(at) = self.positions.get(&atom) else {
            return Ok(false);
        };
        match (self.values.get(*at), self.free.get(*at)) {
            (_, Some(true)) => Err(*at),
            (value, _) => Ok(value.copied().unwrap_or(false)),
        }
    }

    /// The value of a guard, or a free atom that it hangs on.
    fn holds(&self, guard: &Guard) -> Result<bool, usize> {
        match guard {
            Guard::Const(value) => Ok(*value),
            Guard::Atom(atom) => self.atom(*atom),
            Guard::Not(guard) => self.holds(guard).map(|value| !value),
            Guard::And(guards) => first(guards.iter().map(|guard| self.holds(guard)), false),
            Guard::Or(guards) => first(guards.iter().map(|guard| self.holds(guard)), true),
        }
    }
}

/// The answer with which a composite goes on to its next child.
fn passed(kind: Composite) -> Outcome {
    match kind {
        Composite::Sequence => Outcome::Success,
        Composite::Selector => Outcome::Failure,
    }
}

/// `decisive` if one of the values is, whatever else is open; else the first that is open.
fn first(values: impl Iterator<Item = Result<bool, usize>>, decisive: bool) -> Result<bool, usize> {
    let mut open = None;
    for value in values {
        match value {
            Ok(value) if value == decisive => return Ok(decisive),
            Ok(_) => {}
            Err(atom) => open = open.or(Some(atom)),
        }
    }
    open.map_or(Ok(!decisive), Err)
}
