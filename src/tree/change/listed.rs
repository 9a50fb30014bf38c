//! What changed between two tables, by what both of them list: minterms beside that are free.

use super::Change;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Atom;
use crate::logic::{Bits, Columns, Minterm};
use crate::policy::Policy;
use crate::tree::canonicalise::covered;

/// A row: for each atom its value, or none if it is free.
type Cube = Vec<Option<bool>>;

/// The most pairs of rows that are looked at, and the most that may have something in common.
const PAIRS: usize = 100_000_000;
const COMMON: usize = 20_000;

/// The changes, in the order of the old decisions; `None` if rows of one table that decide differently overlap, or there
/// are too many.
pub(super) fn listed(old: &Policy, new: &Policy) -> Option<Vec<Change>> {
    let mut atoms = old.atoms.clone();
    atoms.extend(new.atoms.iter().filter(|atom| !old.atoms.contains(atom)));
    let (before, after) = (rows(old, &atoms)?, rows(new, &atoms)?);
    if before.len().saturating_mul(after.len()) > PAIRS {
        return None;
    }
    let mut common: Vec<Cube> = Vec::new();
    let mut decided = Vec::new();
    for (a, was) in &before {
        for (b, is) in &after {
            if let Some(both) = meet(a, b) {
                common.push(both);
                decided.push((*was, *is));
            }
        }
    }
    if common.len() > COMMON {
        return None;
    }
    let columns = columns(&common, atoms.len());
    let mut changes = Vec::new();
    for was in order(&before) {
        for is in order(&after).into_iter().filter(|is| *is != was) {
            let rows = decided.iter().enumerate();
            let changed = rows.filter(|(_, pair)| **pair == (was, is));
            let on = Bits::collect(decided.len(), changed.map(|(row, _)| row));
            if !on.is_empty() {
                let off = Bits::full(decided.len()).minus(&on);
                changes.push(Change {
                    when: Some(covered(&columns, &on, &off, &atoms)),
                    old: Some(was),
                    new: Some(is),
                });
            }
        }
    }
    Some(changes)
}

/// The rows of a table over more atoms than its own; `None` if some that decide differently overlap.
fn rows(policy: &Policy, atoms: &[Atom]) -> Option<Vec<(Cube, Id<Behavior>)>> {
    let place = |atom: &Atom| policy.atoms.iter().position(|other| other == atom);
    let places: Vec<Option<usize>> = atoms.iter().map(place).collect();
    let rows = policy.rows.iter().map(|row| {
        let fixed = |at: usize| {
            let free = row.free.as_ref().is_some_and(|free| free.get(at));
            (!free).then(|| row.minterm.get(at))
        };
        let cube = places.iter().map(|place| place.and_then(fixed));
        (cube.collect(), row.behavior)
    });
    let rows: Vec<(Cube, Id<Behavior>)> = rows.collect();
    // Rows of minterms are all different.
    if policy.rows.iter().all(|row| row.free.is_none()) {
        return Some(rows);
    }
    let clash = rows.iter().enumerate().any(|(at, (a, own))| {
        let others = rows.iter().take(at);
        let mut others = others.filter(|(_, other)| other != own);
        others.any(|(b, _)| meet(a, b).is_some())
    });
    (!clash).then_some(rows)
}

/// What two cubes have in common.
fn meet(a: &Cube, b: &Cube) -> Option<Cube> {
    let pairs = || a.iter().zip(b);
    let apart = |(a, b): (&Option<bool>, &Option<bool>)| a.is_some() && b.is_some() && a != b;
    (!pairs().any(apart)).then(|| pairs().map(|(a, b)| a.or(*b)).collect())
}

fn columns(cubes: &[Cube], atoms: usize) -> Columns {
    let rows: Vec<(Minterm, Option<Minterm>)> = cubes
        .iter()
        .map(|cube| {
            let values = Minterm::new(cube.iter().map(|value| *value == Some(true)));
            let free = cube.contains(&None);
            let free = free.then(|| Minterm::new(cube.iter().map(Option::is_none)));
            (values, free)
        })
        .collect();
    let rows = rows.iter();
    let words = rows.map(|(values, free)| (values.words(), free.as_ref().map(Minterm::words)));
    Columns::with_free(atoms, words)
}

/// The behaviours, in the order in which they come first.
fn order(rows: &[(Cube, Id<Behavior>)]) -> Vec<Id<Behavior>> {
    let mut order = Vec::new();
    for (_, behavior) in rows {
        if !order.contains(behavior) {
            order.push(*behavior);
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::listed;
    use crate::ir::Id;
    use crate::ir::task::History;
    use crate::ir::tree::Atom;
    use crate::policy::{Minterm, Policy, Row};
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    /// The atoms from `first` on, and for each minterm of them that is listed its decision.
    type Listing = (usize, BTreeMap<Vec<bool>, usize>);

    const ATOMS: usize = 5;

    fn listings() -> impl Strategy<Value = Listing> {
        let rows = prop::collection::btree_map(
            prop::collection::vec(any::<bool>(), ATOMS),
            0_usize..3,
            1..20,
        );
        (0_usize..3, rows)
    }

    fn atom(at: usize) -> Atom {
        Atom::Predicate(Id::new(at))
    }

    fn policy((first, rows): &Listing) -> Policy {
        let rows = rows.iter().map(|(values, behavior)| Row {
            minterm: Minterm::new(values.iter().copied()),
            free: None,
            behavior: Id::new(*behavior),
            visits: 0,
            values: Vec::new(),
        });
        Policy {
            atoms: (*first..first + ATOMS).map(atom).collect(),
            behaviors: (0..3).map(Id::new).collect(),
            history: History::default(),
            rows: rows.collect(),
            starts: Vec::new(),
            transitions: Vec::new(),
        }
    }

    proptest! {
        /// In each minterm that both tables list, just the change that took place there holds, if any did.
        #[test]
        fn a_change_holds_where_it_took_place(old in listings(), new in listings()) {
            let changes = listed(&policy(&old), &policy(&new)).unwrap();
            for (a, was) in &old.1 {
                for (b, is) in &new.1 {
                    let own = |first: usize, values: &[bool], at: usize| {
                        at.checked_sub(first).and_then(|at| values.get(at)).copied()
                    };
                    let both = |at| (own(old.0, a, at), own(new.0, b, at));
                    if (0..8).any(|at| matches!(both(at), (Some(x), Some(y)) if x != y)) {
                        continue;
                    }
                    let mut holds = |asked: Atom| {
                        let at = (0..8).find(|at| atom(*at) == asked).unwrap();
                        let (one, other) = both(at);
                        one.or(other).unwrap()
                    };
                    for change in &changes {
                        let when = change.when.as_ref().unwrap().eval(&mut holds);
                        let took = [change.old, change.new] == [Some(Id::new(*was)), Some(Id::new(*is))];
                        prop_assert_eq!(when, took);
                    }
                    prop_assert!(was == is || changes.iter().any(|change| change.old == Some(Id::new(*was))));
                }
            }
        }
    }
}
