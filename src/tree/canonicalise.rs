//! Trees to canonical form (paper, section IV): a selector of units `guard => behaviour`, one per behaviour.
//!
//! Nodes are reduced to units on a circuit, in which nested conditions stay small; the guards of the
//! units are then written out and shortened.

mod reduce;
mod shorten;
mod table;

pub(super) use shorten::shorten;
pub use table::Decided;

use super::circuit::Signal;
use super::circuit::guards::Guards;
use super::unit::{guarded, selector};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Guard, Node};
use reduce::reduce;

/// The most literals that a guard may have. A reader gives up long before.
pub(super) const LITERALS: usize = 2_000;

/// A canonical behaviour tree: from the left, the first unit whose guard holds drives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Canonical {
    /// The units, one per behaviour. No two guards of what [`canonicalise`] gives hold together, so that their order
    /// does not matter; in other orders the guards can be shorter, see [`permute`](super::permute::permute).
    pub units: Vec<Unit>,
}

/// A guard and the behaviour that it lets through.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// When the behaviour is selected.
    pub guard: Guard,
    /// The behaviour.
    pub behavior: Id<Behavior>,
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
    /// A child of a memory node that answers without a behaviour: the history does not tell that it was passed.
    Passed(Composite),
    /// Two children of a memory node end with the same behaviour: the history does not tell which one it was.
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
                "`timeout` counts ticks, which no predicate tells"
            }
            Reason::Counting(_) => "the decorator counts, which no predicate tells",
            Reason::Passed(_) => "no predicate tells that a memory node has passed a condition",
            Reason::Twice(_) => {
                "the behaviour ends two children of a memory node, and the history does not tell which"
            }
            Reason::Failure => {
                "the history does not tell that a selector of several behaviours has failed"
            }
            Reason::Large(_) => "the guard of a behaviour would have more than 2000 literals",
        }
    }
}

impl Canonical {
    /// The units as a tree.
    pub fn tree(&self) -> Node {
        let units = self.units.iter();
        selector(units.map(|unit| guarded(unit.guard.clone(), Node::Behavior(unit.behavior))))
    }

    /// The behaviour that is selected where the atoms have these values.
    pub fn select(&self, holds: &mut impl FnMut(Atom) -> bool) -> Option<Id<Behavior>> {
        let mut units = self.units.iter();
        units
            .find(|unit| unit.guard.eval(holds))
            .map(|unit| unit.behavior)
    }
}

/// The canonical form of a tree.
///
/// # Errors
/// A node whose choice depends on more than predicates and history, with the reason.
pub fn canonicalise(root: &Node) -> Result<Canonical, Irreducible> {
    let mut guards = Guards::new();
    // Atoms stand in guards as they are read in the tree.
    root.visit_atoms(&mut |atom| {
        guards.atom(atom);
    });
    let reduced = reduce(root, &mut Vec::new(), &mut guards)?;
    let mut unified: Vec<(Id<Behavior>, Signal)> = Vec::new();
    for (behavior, when) in reduced.units {
        match unified.iter_mut().find(|(known, _)| *known == behavior) {
            Some((_, before)) => *before = guards.circuit.or(*before, when),
            None => unified.push((behavior, when)),
        }
    }
    let mut units = Vec::new();
    for (behavior, when) in unified {
        let guard = shorten(when, Signal::FALSE, LITERALS, &mut guards);
        let guard = guard.ok_or(Irreducible {
            path: Vec::new(),
            reason: Reason::Large(behavior),
        })?;
        if guard != Guard::Const(false) {
            units.push(Unit { guard, behavior });
        }
    }
    Ok(Canonical { units })
}
