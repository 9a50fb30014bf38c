//! When two sides take the same decisions: the product automaton of their memories and the environment.

mod choices;
mod environment;
mod moment;
mod oracle;
mod product;
mod side;
mod symbolic;
pub(super) mod unfold;
mod window;

pub use environment::Environment;
use environment::Follow;

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node, Status};
use crate::policy::{Minterm, Policy};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Display, Formatter};

/// What is compared.
#[derive(Clone, Copy, Debug)]
pub enum Side<'a> {
    /// A tree, from fresh memory.
    Tree(&'a Node),
    /// A table. Where it has no row it may do anything.
    Policy(&'a Policy),
}

/// What comes of a comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The two select the same in every tick.
    Equal(Explored),
    /// They part.
    Differ(Trace),
    /// There was too much to explore; nothing was found up to here.
    Undecided(Explored),
}

/// How an answer was found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Means {
    /// By going through every state of the product automaton.
    #[default]
    Paths,
    /// Neither side has memory: by a truth table over the atoms on which their difference depends.
    Table {
        /// How many there are.
        atoms: usize,
    },
    /// The two are the same tree.
    Identity,
    /// Neither side has memory: by a SAT solver.
    Solver {
        /// How many there are.
        atoms: usize,
    },
}

/// What was explored.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Explored {
    /// How.
    pub means: Means,
    /// States of both memories and the environment.
    pub states: usize,
    /// Ticks that were tried.
    pub ticks: usize,
    /// Minterms that were reached; 0 where the environment has none of its own.
    pub minterms: usize,
    /// Recorded transitions that were taken.
    pub transitions: usize,
    /// Places where the paths go on but the environment says nothing: a selected behaviour without a record, or a
    /// minterm without a row. With none, what was explored is closed.
    pub open: usize,
    /// What the left side ticks in the same tick after the behaviour that it selected has failed, by minterm.
    pub after_failure: BTreeMap<Minterm, BTreeSet<Option<Id<Behavior>>>>,
}

impl Explored {
    /// How an answer was found, in words.
    pub fn means_text(&self) -> String {
        match self.means {
            Means::Paths => format!("{} states explored", self.states),
            Means::Identity => "they are the same tree".to_owned(),
            Means::Table { atoms: 0 } => "both reduce to the same circuit".to_owned(),
            Means::Table { atoms } => format!("by a truth table over {atoms} predicates"),
            Means::Solver { atoms } => format!("by a SAT solver over {atoms} predicates"),
        }
    }
}

/// A shortest way to a tick in which the sides select differently.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trace {
    /// What the bits of the valuations mean.
    pub atoms: Vec<Atom>,
    /// The ticks in which they still agree.
    pub steps: Vec<TraceTick>,
    /// The valuation in which they part.
    pub valuation: Minterm,
    /// What the left side selects in it.
    pub left: Option<Id<Behavior>>,
    /// What the right side selects in it.
    pub right: Option<Id<Behavior>>,
}

/// A tick of a trace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TraceTick {
    /// What held.
    pub valuation: Minterm,
    /// What both sides selected.
    pub behavior: Option<Id<Behavior>>,
    /// What it answered; running where nothing was selected.
    pub status: Status,
}

/// Whether a behaviour may answer so.
pub type MayEnd<'a> = &'a dyn Fn(Id<Behavior>, Status) -> bool;

/// What may come of a behaviour that is ticked.
pub(super) const ANSWERS: [Status; 3] = [Status::Failure, Status::Success, Status::Running];

/// How two sides that select the same go on in the same tick, by what comes of what they select.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Onward {
    /// They tick the same behaviours.
    Alike,
    /// They tick different ones.
    Differ(Parted),
    /// That is too much to explore, or they do not select the same.
    Undecided,
}

/// A shortest way to a tick in which both sides select the same, and then go on differently.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parted {
    /// What both tick in the last tick until they part, one after another, and what each answers.
    pub ended: Vec<(Id<Behavior>, Status)>,
    /// The way there; [`left`](Trace::left) and [`right`](Trace::right) are what each side ticks next.
    pub trace: Trace,
}

/// A guard asks an atom that the environment's table does not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unknown(pub Atom);

impl Display for Unknown {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let (what, number) = match self.0 {
            Atom::Predicate(predicate) => ("predicate", predicate.index()),
            Atom::Done(behavior) => ("success of behaviour", behavior.index()),
            Atom::Failed(behavior) => ("failure of behaviour", behavior.index()),
        };
        write!(
            f,
            "a guard asks for {what} {number}, which the table does not have"
        )
    }
}

impl std::error::Error for Unknown {}

/// Runs both sides in lockstep over every sequence of valuations and statuses that the environment allows.
///
/// # Errors
/// An atom that a tree asks and the environment's table does not have.
pub fn compare(left: Side, right: Side, environment: Environment) -> Result<Verdict, Unknown> {
    compare_onward(left, right, environment, &|_, _| false).map(|(verdict, _)| verdict)
}

/// As [`compare`]; where two trees select the same in every tick, also whether they go on alike in that tick, whatever comes
/// of it that may. Along what a table records, only the next behaviour is looked at.
///
/// # Errors
/// As [`compare`].
pub fn compare_onward(
    left: Side,
    right: Side,
    environment: Environment,
    may_end: MayEnd,
) -> Result<(Verdict, Onward), Unknown> {
    let sides = [left, right];
    match (left, right, environment) {
        (_, _, Environment::Greedy(table)) => {
            product::explore(sides, table, Follow::Recorded, may_end)
        }
        // A table decides on its own minterms only.
        (_, _, Environment::Observed(table))
        | (Side::Policy(table), _, _)
        | (_, Side::Policy(table), _) => {
            product::explore(sides, table, Follow::Consistent, may_end)
        }
        (Side::Tree(left), Side::Tree(right), _) if left == right => {
            let explored = Explored {
                means: Means::Identity,
                ..Explored::default()
            };
            Ok((Verdict::Equal(explored), Onward::Alike))
        }
        (Side::Tree(left), Side::Tree(right), Environment::Any(history)) => {
            symbolic::explore((left, right), (history, &[]), may_end)
        }
        (Side::Tree(left), Side::Tree(right), Environment::Possible(history, excluded)) => {
            symbolic::explore((left, right), (history, excluded), may_end)
        }
    }
}
