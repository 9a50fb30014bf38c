//! Covers as guards: what alternatives have in common is taken out of them.

use crate::ir::tree::{Atom, Composite, Guard};
use crate::logic::{Cover, Literal};
use crate::tree::formula::{and, literal, or};

/// Nodes and literals: the part of a size that adds up.
pub(super) type Cost = (usize, usize);

pub(super) fn add(a: Cost, b: Cost) -> Cost {
    (a.0 + b.0, a.1 + b.1)
}

/// Alternatives up to which every literal that several have in common is tried as the one to take out.
const THOROUGH: usize = 6;

/// The nodes that a guard, or its negation, is drawn with under a node that joins in the way `outer`.
pub(super) fn nodes(guard: &Guard, positive: bool, outer: Composite) -> Cost {
    let (joins, parts) = match (guard, positive) {
        (Guard::Const(_), _) => return (1, 0),
        (Guard::Atom(_), _) => return (1, 1),
        (Guard::Not(guard), _) => return nodes(guard, !positive, outer),
        (Guard::And(parts), true) | (Guard::Or(parts), false) => (Composite::Sequence, parts),
        (Guard::And(parts), false) | (Guard::Or(parts), true) => (Composite::Selector, parts),
    };
    let own = match joins == outer {
        true => (0, 0),
        false => (1, 0),
    };
    let parts = parts.iter().map(|part| nodes(part, positive, joins));
    parts.fold(own, add)
}

/// A guard that holds where the cover does, with as few nodes as dividing it comes to.
///
/// Algebraic division (Brayton 1987): F = Q·D + R, where Q is what is left of the alternatives with some literal, and D
/// is what F divided by Q leaves.
pub(super) fn factored(cover: &Cover, atoms: &[Atom]) -> Guard {
    let cubes = cover.cubes().iter().map(|cube| cube.literals().to_vec());
    divided(&cubes.collect::<Vec<_>>(), atoms)
}

type Cubes = [Vec<Literal>];

fn divided(cubes: &Cubes, atoms: &[Atom]) -> Guard {
    let joined = |cube: &Vec<Literal>| and(cube.iter().map(|l| literal(*l, atoms)));
    match cubes {
        [] => return Guard::Const(false),
        [cube] => return joined(cube),
        [first, ..] => {
            let common = |l: &&Literal| cubes.iter().all(|cube| cube.contains(l));
            let common: Vec<Literal> = first.iter().filter(common).copied().collect();
            if !common.is_empty() {
                let rest = without(cubes, &common);
                return and([joined(&common), divided(&rest, atoms)]);
            }
        }
    }
    let flat = or(cubes.iter().map(joined));
    let mut best = (nodes(&flat, true, Composite::Sequence), flat);
    for taken in shared(cubes) {
        let with = cubes.iter().filter(|cube| cube.contains(&taken));
        let quotient = without(&with.cloned().collect::<Vec<_>>(), &[taken]);
        let divisor = quotients(cubes, &quotient);
        let product = |cube: &Vec<Literal>| {
            divisor.iter().any(|d| {
                let left = remove(cube, d);
                left.len() + d.len() == cube.len() && quotient.contains(&left)
            })
        };
        let rest: Vec<Vec<Literal>> = cubes.iter().filter(|c| !product(c)).cloned().collect();
        let factor = and([divided(&divisor, atoms), divided(&quotient, atoms)]);
        let whole = match rest.is_empty() {
            true => factor,
            false => or([factor, divided(&rest, atoms)]),
        };
        let cost = nodes(&whole, true, Composite::Sequence);
        if cost < best.0 {
            best = (cost, whole);
        }
    }
    best.1
}

/// The literals that several alternatives have, the most frequent first; of many alternatives only the most frequent.
fn shared(cubes: &Cubes) -> Vec<Literal> {
    let mut all: Vec<Literal> = cubes.iter().flatten().copied().collect();
    all.sort_unstable();
    let mut counted: Vec<(usize, Literal)> = all
        .chunk_by(|a, b| a == b)
        .filter_map(|same| Some((same.len(), *same.first()?)))
        .filter(|(count, _)| *count > 1)
        .collect();
    counted.sort_by_key(|(count, literal)| (std::cmp::Reverse(*count), *literal));
    if cubes.len() > THOROUGH {
        counted.truncate(1);
    }
    counted.into_iter().map(|(_, literal)| literal).collect()
}

/// What is left of a cube without these literals.
fn remove(cube: &[Literal], literals: &[Literal]) -> Vec<Literal> {
    let left = cube.iter().filter(|l| !literals.contains(l));
    left.copied().collect()
}

fn without(cubes: &Cubes, literals: &[Literal]) -> Vec<Vec<Literal>> {
    cubes.iter().map(|cube| remove(cube, literals)).collect()
}

/// F divided by Q: the cubes that with every cube of Q make a cube of F.
fn quotients(cubes: &Cubes, by: &Cubes) -> Vec<Vec<Literal>> {
    let divided = |q: &Vec<Literal>| -> Vec<Vec<Literal>> {
        let holding = cubes.iter().filter(|c| q.iter().all(|l| c.contains(l)));
        holding.map(|cube| remove(cube, q)).collect()
    };
    let mut left = by.iter().map(divided);
    let first = left.next().unwrap_or_default();
    left.fold(first, |all, some| {
        all.into_iter().filter(|c| some.contains(c)).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::{factored, nodes};
    use crate::ir::Id;
    use crate::ir::tree::{Atom, Composite, Guard};
    use crate::logic::{Cover, Cube, Literal};

    fn guard(cubes: &[&str]) -> (Guard, Cover, Vec<Atom>) {
        let atoms: Vec<Atom> = (0..8).map(|i| Atom::Predicate(Id::new(i))).collect();
        let cube = |text: &str| {
            Cube::new(text.bytes().map(|letter| Literal {
                atom: usize::from(letter.to_ascii_lowercase() - b'a'),
                positive: letter.is_ascii_lowercase(),
            }))
        };
        let cover = Cover::new(cubes.iter().map(|text| cube(text)));
        (factored(&cover, &atoms), cover, atoms)
    }

    #[test]
    fn factoring_saves_nodes_and_changes_nothing() {
        // Alternatives, nodes under a sequence.
        for (cubes, expected) in [
            (&["ab", "ac"][..], 4),
            (&["ac", "ad", "bc", "bd"], 6),
            (&["ab", "cd"], 7),
            (&["abc", "abD", "e"], 8),
            (&["a", "B", "c"], 4),
            (&["a"], 1),
            (&["aBc"], 3),
            (&["ab", "ac", "ad", "ef"], 10),
        ] {
            let (guard, cover, atoms) = guard(cubes);
            assert_eq!(
                nodes(&guard, true, Composite::Sequence).0,
                expected,
                "{cubes:?}: {guard:?}"
            );
            for values in 0..1_usize << atoms.len() {
                let holds = |i: usize| values >> i & 1 == 1;
                let mut asked = |atom: Atom| holds(atoms.iter().position(|a| *a == atom).unwrap());
                assert_eq!(guard.eval(&mut asked), cover.holds(holds), "{cubes:?}");
            }
        }
    }
}
