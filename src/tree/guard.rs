//! The algebra of guards: how they are built and simplified, what they consist of, and how covers become guards.
//!
//! What is built here is in negation normal form: only atoms are negated.

mod factor;
pub(super) mod partial;

pub use factor::factored;

use crate::ir::tree::{Atom, Composite, Guard};
use crate::logic::{Cover, Literal};

/// The conjunction, without nested conjunctions, repetitions and constants.
pub fn and(guards: impl IntoIterator<Item = Guard>) -> Guard {
    let mut parts: Vec<Guard> = Vec::new();
    let mut add = |guard: Guard| {
        if !parts.contains(&guard) {
            parts.push(guard);
        }
    };
    for guard in guards {
        match guard {
            Guard::Const(true) => {}
            Guard::Const(false) => return guard,
            Guard::And(inner) => inner.into_iter().for_each(&mut add),
            guard => add(guard),
        }
    }
    if parts.iter().any(|part| parts.contains(&not(part.clone()))) {
        return Guard::Const(false);
    }
    match parts.len() {
        0 => Guard::Const(true),
        1 => parts.remove(0),
        _ => Guard::And(parts),
    }
}

/// The disjunction, without nested disjunctions, repetitions and constants.
pub fn or(guards: impl IntoIterator<Item = Guard>) -> Guard {
    not(and(guards.into_iter().map(not)))
}

/// The negation, pushed down to the atoms.
pub fn not(guard: Guard) -> Guard {
    match guard {
        Guard::Const(value) => Guard::Const(!value),
        Guard::Atom(_) => Guard::Not(Box::new(guard)),
        Guard::Not(inner) => *inner,
        Guard::And(guards) => Guard::Or(guards.into_iter().map(not).collect()),
        Guard::Or(guards) => Guard::And(guards.into_iter().map(not).collect()),
    }
}

/// A literal over these atoms.
pub fn literal(literal: Literal, atoms: &[Atom]) -> Guard {
    match (atoms.get(literal.atom), literal.positive) {
        (Some(atom), true) => Guard::Atom(*atom),
        (Some(atom), false) => not(Guard::Atom(*atom)),
        (None, positive) => Guard::Const(!positive),
    }
}

/// A conjunction of literals over these atoms.
pub fn cube(literals: &[Literal], atoms: &[Atom]) -> Guard {
    and(literals.iter().map(|l| literal(*l, atoms)))
}

/// A cover over these atoms as it stands: a disjunction of conjunctions. [`factored`] gives shorter guards.
pub fn cover(cover: &Cover, atoms: &[Atom]) -> Guard {
    let cubes = cover.cubes().iter();
    let mut cubes: Vec<Guard> = cubes.map(|c| cube(c.literals(), atoms)).collect();
    match cubes.len() {
        0 => Guard::Const(false),
        1 => cubes.remove(0),
        _ => Guard::Or(cubes),
    }
}

/// A guard, or its negation, seen with the negation pushed down one level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View<'g> {
    /// Always, or never.
    Const(bool),
    /// An atom, negated if `false`.
    Literal(Atom, bool),
    /// A conjunction (a sequence) or a disjunction (a selector) of these guards, each negated if `false`.
    Join(Composite, &'g [Guard], bool),
}

impl<'g> View<'g> {
    /// The view of a guard, negated unless `positive`.
    pub fn of(guard: &'g Guard, positive: bool) -> Self {
        match (guard, positive) {
            (Guard::Const(value), _) => Self::Const(*value == positive),
            (Guard::Atom(atom), _) => Self::Literal(*atom, positive),
            (Guard::Not(guard), _) => Self::of(guard, !positive),
            (Guard::And(parts), true) | (Guard::Or(parts), false) => {
                Self::Join(Composite::Sequence, parts, positive)
            }
            (Guard::And(parts), false) | (Guard::Or(parts), true) => {
                Self::Join(Composite::Selector, parts, positive)
            }
        }
    }
}

/// The atom of a literal; `None` for any other guard.
pub fn atom(guard: &Guard) -> Option<Atom> {
    match View::of(guard, true) {
        View::Literal(atom, _) => Some(atom),
        _ => None,
    }
}

/// The guards whose conjunction a guard is.
pub fn conjuncts(guard: &Guard) -> &[Guard] {
    match guard {
        Guard::And(parts) => parts,
        Guard::Const(true) => &[],
        guard => std::slice::from_ref(guard),
    }
}

/// The guards whose disjunction a guard is.
pub fn alternatives(guard: &Guard) -> &[Guard] {
    match guard {
        Guard::Or(parts) => parts,
        guard => std::slice::from_ref(guard),
    }
}

/// Every literal of a guard, without repetitions, from the left.
pub fn literals(guard: &Guard) -> Vec<Guard> {
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

/// The negated literals of a guard, each time they occur.
pub fn negations(guard: &Guard) -> usize {
    match guard {
        Guard::Const(_) | Guard::Atom(_) => 0,
        Guard::Not(inner) => 1 + negations(inner),
        Guard::And(parts) | Guard::Or(parts) => parts.iter().map(negations).sum(),
    }
}

/// A conjunction or disjunction with its `at`-th part replaced, or left out. A guard without parts is left as it is.
pub fn with_part(guard: &Guard, at: usize, new: Option<Guard>) -> Guard {
    let replaced = |parts: &[Guard]| -> Vec<Guard> {
        let before = parts.iter().take(at).cloned();
        let after = parts.iter().skip(at + 1).cloned();
        before.chain(new.clone()).chain(after).collect()
    };
    match guard {
        Guard::And(parts) => and(replaced(parts)),
        Guard::Or(parts) => or(replaced(parts)),
        guard => guard.clone(),
    }
}

/// The conjuncts that all alternatives of a guard share, and the guard without them.
pub fn common(guard: &Guard) -> (Vec<Guard>, Guard) {
    let cubes = alternatives(guard);
    let Some((first, rest)) = cubes.split_first() else {
        return (Vec::new(), guard.clone());
    };
    let in_all = |part: &&Guard| rest.iter().all(|cube| conjuncts(cube).contains(part));
    let shared: Vec<Guard> = conjuncts(first).iter().filter(in_all).cloned().collect();
    let left = cubes.iter().map(|cube| {
        let own = conjuncts(cube).iter();
        and(own.filter(|part| !shared.contains(part)).cloned())
    });
    let left = or(left);
    (shared, left)
}

/// The disjunction, with what all alternatives share before it.
pub fn either(a: &Guard, b: &Guard) -> Guard {
    let (shared, rest) = common(&or([a.clone(), b.clone()]));
    and(shared.into_iter().chain([rest]))
}

/// The guard with constants folded, nested joins flattened, literals in the order of their atoms, and without
/// alternatives that another one covers.
pub fn simplified(guard: Guard) -> Guard {
    match guard {
        Guard::Const(_) | Guard::Atom(_) => guard,
        Guard::Not(inner) => not(simplified(*inner)),
        Guard::And(parts) => {
            let mut parts: Vec<Guard> = parts.into_iter().map(simplified).collect();
            // Literals stand as in a table, before what is longer.
            parts.sort_by_key(|part| (atom(part).is_none(), atom(part)));
            and(parts)
        }
        Guard::Or(parts) => match or(parts.into_iter().map(simplified)) {
            Guard::Or(cubes) => or(absorbed(cubes)),
            guard => guard,
        },
    }
}

/// The alternatives without those that another one covers: `a or a and b` is `a`.
fn absorbed(cubes: Vec<Guard>) -> Vec<Guard> {
    let covers = |wide: &Guard, narrow: &Guard| {
        let narrow = conjuncts(narrow);
        conjuncts(wide).iter().all(|part| narrow.contains(part))
    };
    let kept = |(i, cube): &(usize, &Guard)| {
        !cubes.iter().enumerate().any(|(j, other)| {
            // Of two equal ones the first stays.
            *i != j && covers(other, cube) && (j < *i || !covers(cube, other))
        })
    };
    let kept = cubes.iter().enumerate().filter(kept);
    kept.map(|(_, cube)| cube.clone()).collect()
}
