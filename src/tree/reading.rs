//! Memory read from the history (paper, section IV, Figures 4 and 5).
//!
//! What a tree with memory selects depends on what its nodes remember, and a policy sees only predicates and the history
//! window. So each memory node is taken to stand where the window shows it. `plan` finds out by which terminations the
//! children of memory nodes end, or why the history does not show them; `sets` follows such a plan through sets of minterms.
//! [Proofs](super::prove) follow it through the rows of a table, [canonical forms](super::canonicalise) through a circuit.

mod lattice;
mod plan;
mod sets;

pub(super) use lattice::{Answers, Approximation, May};
pub(super) use plan::{After, Plan, plan};
pub(super) use sets::{Sets, read};

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Composite, Decorator};
use std::fmt::{self, Display, Formatter};

/// Where a memory node stands, as the history window shows it. With a window of one termination the two are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// After the furthest child that has ended (paper, Figures 4 and 5).
    Furthest,
    /// After the first child that has ended while the next has not. A longer window still holds how the node ended the last
    /// time; so read, a node that has started over is seen to have.
    Unfinished,
}

/// Why a tree has no canonical form, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Irreducible {
    /// The way to the node from the root: the numbers of children. `guard => node` is a sequence of two.
    pub path: Vec<usize>,
    /// Why it cannot be reduced.
    pub reason: Reason,
}

/// What more than predicates and the history a node depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// What follows this child is reached only by the status of its behaviour in the same tick.
    Status(Composite),
    /// Several children at a time.
    Parallel,
    /// A count.
    Counting(Decorator),
    /// A child of a memory node that answers without a behaviour: the history does not show that it was passed.
    Passed(Composite),
    /// Two children of a memory node end with the same behaviour: the history does not show which one it was.
    Twice(Id<Behavior>),
    /// A memory node goes by the failure of a selector whose next child is ticked in the same tick.
    Failure,
    /// The guard of this behaviour is too large to be written out.
    Large(Id<Behavior>),
}

impl Irreducible {
    /// Why, in words.
    pub fn message(&self) -> &'static str {
        match self.reason {
            Reason::Status(Composite::Selector) => {
                "what follows is reached only when this behaviour fails, in the same tick"
            }
            Reason::Status(Composite::Sequence) => {
                "what follows is reached only when this behaviour succeeds, in the same tick"
            }
            Reason::Parallel => "`parallel` ticks several children at a time",
            Reason::Counting(Decorator::Timeout(_)) => {
                "`timeout` counts ticks, and no predicate shows the count"
            }
            Reason::Counting(_) => "the decorator counts, and no predicate shows the count",
            Reason::Passed(_) => {
                "a memory node can pass this child without a behaviour, and the history does not show it"
            }
            Reason::Twice(_) => {
                "the behaviour ends two children of a memory node, and the history does not show which"
            }
            Reason::Failure => {
                "a memory node goes on when this child ends, and the history does not show when"
            }
            Reason::Large(_) => "the guard of a behaviour would have more than 2000 literals",
        }
    }
}

impl Display for Irreducible {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        f.write_str("at root")?;
        for child in &self.path {
            write!(f, "/{child}")?;
        }
        write!(f, ": {}", self.message())
    }
}

impl std::error::Error for Irreducible {}
