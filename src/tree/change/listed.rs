//! What changed between two tables, by what both of them list: minterms beside that are free.

use super::Change;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Atom;
use crate::logic::{Bits, Columns, Minterm};
use crate::policy::Policy;
use crate::tree::canonicalise::covered;
use crate::tree::equivalence::Side;
use crate::tree::tick::Runner;

/// A row: for each atom its value, or none if it is free.
type Cube = Vec<Option<bool>>;

/// What was decided, and what is decided now.
type Decided = [Option<Id<Behavior>>; 2];

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
                decided.push([Some(*was), Some(*is)]);
            }
        }
    }
    let known = |rows: &[(Cube, Id<Behavior>)]| order(rows.iter().map(|(_, own)| Some(*own)));
    let orders = [known(&before), known(&after)];
    changed(&common, &decided, &orders, &atoms)
}

/// The changes between a table whose rows are minterms and a tree without memory that asks nothing else, where the table has a
/// row; `None` if they are others than that, or there are too many rows.
pub(super) fn beside(sides: [Side; 2]) -> Option<Vec<Change>> {
    let (policy, root, is_new) = match sides {
        [Side::Policy(policy), Side::Tree(root)] => (policy, root, true),
        [Side::Tree(root), Side::Policy(policy)] => (policy, root, false),
        _ => return None,
    };
    let minterms = policy.rows.iter().all(|row| row.free.is_none());
    if root.remembers() || !minterms || policy.rows.len() > COMMON {
        return None;
    }
    let mut runner = Runner::new(root, &policy.atoms).ok()?;
    let decided = policy.rows.iter().map(|row| {
        let selected = runner.select(row.minterm.words());
        let listed = Some(row.behavior);
        match is_new {
            true => [listed, selected],
            false => [selected, listed],
        }
    });
    let decided: Vec<Decided> = decided.collect();
    let atoms = policy.atoms.len();
    let cubes = policy.rows.iter().map(|row| {
        let values = (0..atoms).map(|at| Some(row.minterm.get(at)));
        values.collect()
    });
    let cubes: Vec<Cube> = cubes.collect();
    let orders =
        [0, 1].map(|side: usize| order(decided.iter().filter_map(|pair| pair.get(side).copied())));
    changed(&cubes, &decided, &orders, &policy.atoms)
}

/// What is decided otherwise in these cubes, in the order of the decisions.
fn changed(
    cubes: &[Cube],
    decided: &[Decided],
    orders: &[Vec<Option<Id<Behavior>>>; 2],
    atoms: &[Atom],
) -> Option<Vec<Change>> {
    if cubes.len() > COMMON {
        return None;
    }
    let columns = columns(cubes, atoms.len());
    let mut changes = Vec::new();
    for was in &orders[0] {
        for is in orders[1].iter().filter(|is| *is != was) {
            let rows = decided.iter().enumerate();
            let changed = rows.filter(|(_, pair)| **pair == [*was, *is]);
            let on = Bits::collect(decided.len(), changed.map(|(row, _)| row));
            if !on.is_empty() {
                let off = Bits::full(decided.len()).minus(&on);
                changes.push(Change {
                    when: Some(covered(&columns, &on, &off, atoms)),
                    ended: Vec::new(),
                    old: *was,
                    new: *is,
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

/// The decisions, in the order in which they come first.
fn order(decisions: impl Iterator<Item = Option<Id<Behavior>>>) -> Vec<Option<Id<Behavior>>> {
    let mut order = Vec::new();
    for decision in decisions {
        if !order.contains(&decision) {
            order.push(decision);
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::{Change, beside, listed};
    use crate::ir::Id;
    use crate::ir::task::History;
    use crate::ir::tree::{Atom, Guard, Node};
    use crate::policy::{Minterm, Policy, Row};
    use crate::tree::equivalence::Side;
    use crate::tree::unit::{guarded, selector};
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
            fields: Vec::new(),
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

        /// Beside a tree, in each minterm that the table lists just the change holds from what the one does to what the other does,
        /// also where the tree does nothing.
        #[test]
        fn a_tree_is_compared_where_the_table_has_a_row(
            table in listings(),
            asked in prop::collection::vec((0_usize..ATOMS, any::<bool>(), 0_usize..3), 0..4),
        ) {
            let policy = policy(&table);
            let units = asked.iter().map(|(at, value, behavior)| {
                let asks = Guard::Atom(atom(table.0 + at));
                let asks = if *value { asks } else { Guard::Not(Box::new(asks)) };
                guarded(asks, Node::Behavior(Id::new(*behavior)))
            });
            let root = selector(units);
            let changes = beside([Side::Tree(&root), Side::Policy(&policy)]).unwrap();
            let turned = beside([Side::Policy(&policy), Side::Tree(&root)]).unwrap();
            for (values, is) in &table.1 {
                let first = asked.iter().find(|(at, value, _)| values[*at] == *value);
                let was = first.map(|(_, _, behavior)| Id::new(*behavior));
                let mut holds = |asked: Atom| {
                    let at = (0..ATOMS).find(|at| atom(table.0 + at) == asked).unwrap();
                    values[at]
                };
                let mut took = |old, new, changes: &[Change]| {
                    let of = |change: &&Change| change.when.as_ref().unwrap().eval(&mut holds);
                    let held: Vec<_> = changes.iter().filter(of).collect();
                    match old == new {
                        true => held.is_empty(),
                        false => matches!(held.as_slice(), [it] if it.old == old && it.new == new),
                    }
                };
                let is = Some(Id::new(*is));
                prop_assert!(took(was, is, &changes));
                prop_assert!(took(is, was, &turned));
            }
        }
    }
}
