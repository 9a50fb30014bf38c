//! The whole program.

use super::expr::{Binary, Expr, ExprId, Pool, Temp};
use super::input::Input;
use super::law::{Behavior, Block};
use super::name::Name;
use super::table::{Id, Table};
use super::task::{Claim, Learner, Task};
use super::test::Test;
use super::tree::{Atom, Status, Tree};
use super::tunable::Tunable;
use super::world::World;
use rustc_hash::FxHashSet;
use std::ops::RangeInclusive;

/// A checked program.
#[derive(Clone, Debug, Default)]
pub struct Program {
    /// Every expression.
    pub pool: Pool,
    /// Every name that a statement binds.
    pub temps: Table<Temp>,
    /// The world; a program of declared names alone has none.
    pub world: Option<World>,
    /// The inputs; a program with a world has none.
    pub inputs: Table<Input>,
    /// The state variables.
    pub states: Table<State>,
    /// The events, in the order in which they are evaluated.
    pub events: Table<Event>,
    /// What every tick does.
    pub each_tick: Block,
    /// What events do, in order.
    pub effects: Vec<Effect>,
    /// The predicates.
    pub predicates: Table<Predicate>,
    /// The behaviours.
    pub behaviors: Table<Behavior>,
    /// The tasks.
    pub tasks: Table<Task>,
    /// The learners.
    pub learners: Table<Learner>,
    /// The trees.
    pub trees: Table<Tree>,
    /// The claims.
    pub claims: Vec<Claim>,
    /// The tests of trees.
    pub tests: Vec<Test>,
    /// The numbers that may be tuned. Each is a constant of the expressions that it stands in.
    pub tunables: Table<Tunable>,
}

/// A state variable; a point is two of them.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Its name, with the coordinate if it is one of a point.
    pub name: Name,
    /// How its number is to be read.
    pub kind: ValueKind,
    /// Its value at the start of an episode; a constant.
    pub initial: ExprId,
    /// The values that it may have, as far as the text shows.
    pub stays: Stays,
}

/// The values that a state may have.
#[derive(Clone, Debug, PartialEq)]
pub enum Stays {
    /// From the least to the greatest, both included.
    Within(RangeInclusive<f64>),
    /// Those of an enum, or the truth values, whose bits are set.
    Among(u64),
}

impl Stays {
    /// Any number.
    pub const ANY: Self = Self::Within(f64::NEG_INFINITY..=f64::INFINITY);
}

/// How a number is to be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// 0 or 1.
    Bool,
    /// A quantity in SI base units.
    Quantity,
    /// The index of a variant.
    Enum(Vec<Name>),
}

/// An event.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Its name.
    pub name: Name,
    /// Whether it happens in this tick.
    pub when: ExprId,
}

/// What an event does.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// Whether it is done.
    pub on: ExprId,
    /// What is done.
    pub block: Block,
}

/// A predicate.
#[derive(Clone, Debug, PartialEq)]
pub struct Predicate {
    /// Its name, with its arguments, such as `vis(A)`.
    pub name: Name,
    /// When it holds; `None` if it is declared only.
    pub when: Option<ExprId>,
}

impl Program {
    /// What `or` joins in a condition, from left to right, each once. Of an event that it names, that is both the event and what `or`
    /// joins in it if events are to be `opened`.
    pub fn alternatives(&self, condition: ExprId, opened: bool) -> Vec<ExprId> {
        let (mut open, mut seen) = (vec![condition], FxHashSet::default());
        let mut found = Vec::new();
        while let Some(id) = open.pop() {
            if !seen.insert(id) {
                continue;
            }
            match self.pool.get(id) {
                Expr::Binary(Binary::Or, left, right) => {
                    open.extend([right, left]);
                    continue;
                }
                Expr::Event(event) if opened => open.push(self.events[event].when),
                _ => {}
            }
            found.push(id);
        }
        found
    }

    /// The name of an atom.
    pub fn atom_name(&self, atom: Atom) -> Name {
        match atom {
            Atom::Predicate(id) => self.predicates[id].name.clone(),
            Atom::Done(id) => Name::history(Atom::DONE, &self.behaviors[id].name),
            Atom::Failed(id) => Name::history(Atom::FAILED, &self.behaviors[id].name),
        }
    }

    /// Whether a behaviour may end so; one that is declared only may.
    pub fn may_end(&self, behavior: Id<Behavior>, status: Status) -> bool {
        let Some(law) = &self.behaviors[behavior].law else {
            return true;
        };
        let constant = |id| self.pool.constant(id);
        match status {
            Status::Running => true,
            Status::Failure => {
                constant(law.requires) != Some(1.0) || constant(law.fail) != Some(0.0)
            }
            Status::Success => {
                constant(law.succeed) != Some(0.0) && constant(law.requires) != Some(0.0)
            }
        }
    }

    /// The atoms of a task's minterms: its predicates, then `done` and `failed` of its behaviours as its history
    /// window keeps them.
    pub fn atoms(&self, task: Id<Task>) -> Vec<Atom> {
        let task = &self.tasks[task];
        let remembered = |status: Status| {
            let behaviors = task.choose.iter().copied();
            behaviors.filter(move |_| task.history.keeps(status))
        };
        task.observe
            .iter()
            .copied()
            .map(Atom::Predicate)
            .chain(remembered(Status::Success).map(Atom::Done))
            .chain(remembered(Status::Failure).map(Atom::Failed))
            .collect()
    }
}
