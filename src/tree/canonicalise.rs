//! Trees to canonical form (paper, section IV): a selector of units `guard => behaviour`, one per behaviour.
//!
//! Memory is [read from the history](super::reading) over a circuit, in which nested conditions stay small; the guards of
//! the units are then written out and shortened.

mod shorten;
mod table;
mod units;

pub(super) use shorten::{covered, shorten};
pub use table::{Decided, Divided};

use super::circuit::Signal;
use super::circuit::guards::Guards;
use super::reading::{After, Irreducible, Reading, Reason, Sets, plan};
use super::unit::{guarded, selector};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Guard, Node};
use units::Units;

/// The most literals that a guard may have. A reader gives up long before.
pub(super) const LITERALS: usize = 2_000;

/// A canonical behaviour tree: from the left, the first unit whose guard holds drives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Canonical {
    /// The units, one per behaviour. No two guards of what [`canonicalise`] gives hold together, so that their order
    /// does not matter; in other orders the guards can be shorter, see [`permute`](super::permute::permute).
    pub units: Vec<CanonicalUnit>,
}

/// A guard and the behaviour that it lets through.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CanonicalUnit {
    /// When the behaviour is selected.
    pub guard: Guard,
    /// The behaviour.
    pub behavior: Id<Behavior>,
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

/// The canonical form of a tree whose memory is read from the history in this way.
///
/// # Errors
/// A node whose choice depends on more than predicates and history, with the reason.
pub fn canonicalise(root: &Node, by: Reading) -> Result<Canonical, Irreducible> {
    let mut guards = Guards::new();
    // Atoms stand in guards as they are read in the tree.
    root.visit_atoms(&mut |atom| {
        guards.atom(atom);
    });
    let unified = decisions(root, by, &mut guards)?;
    let mut units = Vec::new();
    for (behavior, when) in unified {
        let guard = shorten(when, Signal::FALSE, LITERALS, &mut guards);
        let guard = guard.ok_or(Irreducible {
            path: Vec::new(),
            reason: Reason::Large(behavior),
        })?;
        if guard != Guard::Const(false) {
            units.push(CanonicalUnit { guard, behavior });
        }
    }
    Ok(Canonical { units })
}

/// When a tree selects each of its behaviours, in the order of its leaves.
pub(super) fn decisions(
    root: &Node,
    by: Reading,
    guards: &mut Guards,
) -> Result<Vec<(Id<Behavior>, Signal)>, Irreducible> {
    let plan = plan(root, After::Nothing, &mut Guards::new())?;
    let mut units = Units {
        guards: &mut *guards,
        found: Vec::new(),
    };
    let Ok(_) = units.reach(&plan, by, Signal::TRUE);
    let found = units.found;
    let mut unified: Vec<(Id<Behavior>, Signal)> = Vec::new();
    for (behavior, when) in found {
        match unified.iter_mut().find(|(known, _)| *known == behavior) {
            Some((_, before)) => *before = guards.circuit.or(*before, when),
            None => unified.push((behavior, when)),
        }
    }
    Ok(unified)
}
