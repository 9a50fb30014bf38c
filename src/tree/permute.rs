//! Canonical trees in other orders (paper, Theorem 2).

use super::canonicalise::{Canonical, CanonicalUnit, LITERALS, shorten};
use super::circuit::Signal;
use super::circuit::guards::Guards;
use crate::ir::Id;
use crate::ir::law::Behavior;

/// Why a canonical tree has no form in an order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unordered {
    /// The order leaves a behaviour of the tree out, or names one that it does not have or that it has named before.
    Mismatch(Id<Behavior>),
    /// The guard of this behaviour is too large to be written out.
    Large(Id<Behavior>),
}

/// The canonical tree whose units stand in this order and that selects as `canonical` does.
///
/// Theorem 2 inserts the behaviours one by one: each that a new one shifts to the right gets the negation of its guard.
/// So a guard in the new order is the old one, and not that of any unit which stood before and now stands behind. The
/// guards are then shortened by what the units before them have already taken: one that takes all that is left has the
/// guard *true*.
///
/// # Errors
/// The order is not one of the tree's behaviours, or a guard becomes too large.
pub fn permute(canonical: &Canonical, order: &[Id<Behavior>]) -> Result<Canonical, Unordered> {
    let before = &canonical.units;
    let place = |behavior: Id<Behavior>| order.iter().position(|other| *other == behavior);
    for (i, behavior) in order.iter().enumerate() {
        let known = before.iter().any(|unit| unit.behavior == *behavior);
        if !known || place(*behavior) != Some(i) {
            return Err(Unordered::Mismatch(*behavior));
        }
    }
    let mut guards = Guards::new();
    let mut shifted: Vec<(usize, &CanonicalUnit, Signal)> = Vec::new();
    for (old, unit) in before.iter().enumerate() {
        let new = place(unit.behavior).ok_or(Unordered::Mismatch(unit.behavior))?;
        let mut when = guards.signal(&unit.guard);
        for earlier in before.iter().take(old) {
            if place(earlier.behavior).is_some_and(|other| other > new) {
                let taken = guards.signal(&earlier.guard);
                when = guards.circuit.and(when, !taken);
            }
        }
        shifted.push((new, unit, when));
    }
    shifted.sort_by_key(|(new, ..)| *new);
    let mut taken = Signal::FALSE;
    let mut units = Vec::new();
    for (_, unit, when) in shifted {
        let guard = shorten(when, taken, LITERALS, &mut guards);
        units.push(CanonicalUnit {
            guard: guard.ok_or(Unordered::Large(unit.behavior))?,
            behavior: unit.behavior,
        });
        taken = guards.circuit.or(taken, when);
    }
    Ok(Canonical { units })
}
