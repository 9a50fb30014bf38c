//! What a plan selects, in sets of minterms.

use super::Reading;
use super::lattice::Answers;
use super::plan::Plan;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Guard};

/// Sets of minterms in some form, and what a plan selects in them.
pub(in crate::tree) trait Sets {
    type Set: Clone;
    /// Why it is not known in which minterms of a set something holds.
    type Open;

    /// The empty set.
    fn none(&self) -> Self::Set;
    /// Whether a set is known to be empty.
    fn is_none(&self, set: &Self::Set) -> bool;
    fn both(&mut self, a: &Self::Set, b: &Self::Set) -> Self::Set;
    fn either(&mut self, a: Self::Set, b: &Self::Set) -> Self::Set;
    fn minus(&mut self, a: Self::Set, b: &Self::Set) -> Self::Set;

    /// Those among these in which a guard holds.
    fn holds(&mut self, guard: &Guard, among: &Self::Set) -> Result<Self::Set, Self::Open>;
    /// Those among these in which one of the atoms holds.
    fn any(&mut self, atoms: &[Atom], among: &Self::Set) -> Result<Self::Set, Self::Open>;
    /// In these the behaviour is selected.
    fn select(&mut self, behavior: Id<Behavior>, among: Self::Set);

    /// Reads a node that is reached in these.
    fn reach(
        &mut self,
        plan: &Plan,
        by: Reading,
        among: Self::Set,
    ) -> Result<Answers<Self::Set>, Self::Open>
    where
        Self: Sized,
    {
        read(plan, by, among, self)
    }
}

/// Selects what a plan does in these minterms; in those that are returned it answers without a behaviour.
pub(in crate::tree) fn read<S: Sets>(
    plan: &Plan,
    by: Reading,
    among: S::Set,
    sets: &mut S,
) -> Result<Answers<S::Set>, S::Open> {
    if sets.is_none(&among) {
        return Ok(nowhere(sets));
    }
    match plan {
        Plan::Condition(guard) => {
            let success = sets.holds(guard, &among)?;
            let failure = sets.minus(among, &success);
            Ok(Answers { success, failure })
        }
        Plan::Behavior(behavior) => {
            sets.select(*behavior, among);
            Ok(nowhere(sets))
        }
        Plan::Reactive(kind, children) => {
            let mut whole = Answers {
                success: among,
                failure: sets.none(),
            };
            for child in children {
                let part = sets.reach(child, by, whole.success)?.seen_from(*kind);
                whole.success = part.success;
                whole.failure = sets.either(whole.failure, &part.failure);
            }
            Ok(whole.seen_from(*kind))
        }
        Plan::Resuming(kind, children) => {
            let stands = stands(children, by, among, sets)?;
            let mut whole = nowhere(sets);
            for ((child, _), here) in children.iter().zip(stands) {
                let part = sets.reach(child, by, here)?.seen_from(*kind);
                whole.success = sets.either(whole.success, &part.success);
                whole.failure = sets.either(whole.failure, &part.failure);
            }
            Ok(whole.seen_from(*kind))
        }
        Plan::Decorated(kind, child) => {
            let answers = read(child, by, among, sets)?;
            let none = sets.none();
            Ok(answers.decorated(*kind, none, |a, b| sets.either(a, &b)))
        }
    }
}

fn nowhere<S: Sets>(sets: &S) -> Answers<S::Set> {
    Answers {
        success: sets.none(),
        failure: sets.none(),
    }
}

/// Where a memory node stands at each of its children, among these.
fn stands<S: Sets>(
    children: &[(Plan, Vec<Atom>)],
    by: Reading,
    among: S::Set,
    sets: &mut S,
) -> Result<Vec<S::Set>, S::Open> {
    let ended: Result<Vec<S::Set>, S::Open> = children
        .iter()
        .map(|(_, ended)| sets.any(ended, &among))
        .collect();
    let ended = ended?;
    // Each child but the first stands behind another.
    let behind: Vec<(&S::Set, &S::Set)> = ended.iter().zip(ended.iter().skip(1)).collect();
    let mut left = among;
    let mut stands = Vec::new();
    match by {
        Reading::Furthest => {
            for (before, _) in behind.into_iter().rev() {
                stands.push(sets.both(&left, before));
                left = sets.minus(left, before);
            }
            stands.push(left);
            stands.reverse();
        }
        Reading::Unfinished => {
            for (before, own) in behind {
                let here = sets.both(&left, before);
                let here = sets.minus(here, own);
                left = sets.minus(left, &here);
                stands.push(here);
            }
            stands.insert(0, left);
        }
    }
    Ok(stands)
}
