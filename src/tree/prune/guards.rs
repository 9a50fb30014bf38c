//! Guards with less in them.

use crate::ir::tree::Guard;
use crate::tree::formula::{and, or};

/// The guard without one of its parts, for each part at each level; each part alone; and no guard at all.
pub(super) fn parts(guard: &Guard) -> Vec<Guard> {
    let mut found = inner(guard);
    if *guard != Guard::Const(true) {
        found.push(Guard::Const(true));
    }
    found
}

fn inner(guard: &Guard) -> Vec<Guard> {
    let (Guard::And(parts) | Guard::Or(parts)) = guard else {
        return Vec::new();
    };
    let join = |parts: Vec<Guard>| match guard {
        Guard::And(_) => and(parts),
        _ => or(parts),
    };
    let mut found = Vec::new();
    for (i, part) in parts.iter().enumerate() {
        let replaced = |new: Option<Guard>| {
            let before = parts.iter().take(i).cloned();
            let after = parts.iter().skip(i + 1).cloned();
            join(before.chain(new).chain(after).collect())
        };
        found.push(replaced(None));
        found.extend(inner(part).into_iter().map(|less| replaced(Some(less))));
        found.push(part.clone());
    }
    found
}

/// Every literal of the guard, without repetitions, from the left.
pub(super) fn literals(guard: &Guard) -> Vec<Guard> {
    let mut found = Vec::new();
    collect(guard, &mut found);
    found
}

fn collect(guard: &Guard, found: &mut Vec<Guard>) {
    match guard {
        Guard::Const(_) => {}
        Guard::And(parts) | Guard::Or(parts) => parts.iter().for_each(|part| collect(part, found)),
        literal => {
            if !found.contains(literal) {
                found.push(literal.clone());
            }
        }
    }
}

/// The alternatives of a guard.
pub(super) fn cubes(guard: &Guard) -> &[Guard] {
    match guard {
        Guard::Or(parts) => parts,
        guard => std::slice::from_ref(guard),
    }
}

/// The literals that stand in every alternative, and the guard without them.
pub(super) fn common(guard: &Guard) -> (Vec<Guard>, Guard) {
    let cubes = cubes(guard);
    let parts = |cube: &Guard| super::tidy::parts(cube).to_vec();
    let Some((first, rest)) = cubes.split_first() else {
        return (Vec::new(), guard.clone());
    };
    let shared: Vec<Guard> = parts(first)
        .into_iter()
        .filter(|part| rest.iter().all(|cube| parts(cube).contains(part)))
        .collect();
    let left = cubes.iter().map(|cube| {
        let own = parts(cube).into_iter();
        and(own.filter(|part| !shared.contains(part)))
    });
    (shared.clone(), or(left))
}

/// The disjunction, with what all alternatives share before it.
pub(super) fn either(a: &Guard, b: &Guard) -> Guard {
    let joined = or([a.clone(), b.clone()]);
    let (shared, rest) = common(&joined);
    and(shared.into_iter().chain([rest]))
}

/// How many literals of a guard are negated.
pub(super) fn negations(guard: &Guard) -> usize {
    match guard {
        Guard::Const(_) | Guard::Atom(_) => 0,
        Guard::Not(inner) => 1 + negations(inner),
        Guard::And(parts) | Guard::Or(parts) => parts.iter().map(negations).sum(),
    }
}
