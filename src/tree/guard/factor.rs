//! Covers as guards in which alternatives share what they have in common.
//!
//! Algebraic division (Brayton 1987): F = Q·D + R, where Q is what remains of the alternatives that have some literal
//! once it is taken out, D is F divided by Q, and R is the rest.

use super::{and, cube, or};
use crate::ir::tree::{Atom, Composite, Guard};
use crate::logic::{Cover, Literal};
use crate::tree::size::Price;

/// Alternatives up to which every literal that several have in common is tried as the one to take out.
const THOROUGH: usize = 6;

/// A guard that holds where the cover does, with as few nodes as division finds.
pub fn factored(cover: &Cover, atoms: &[Atom]) -> Guard {
    let cubes = cover.cubes().iter().map(|cube| cube.literals().to_vec());
    divided(&cubes.collect::<Vec<_>>(), atoms)
}

type Cubes = [Vec<Literal>];

fn divided(cubes: &Cubes, atoms: &[Atom]) -> Guard {
    match cubes {
        [] => return Guard::Const(false),
        [only] => return cube(only, atoms),
        [first, ..] => {
            let in_all = |l: &&Literal| cubes.iter().all(|cube| cube.contains(l));
            let common: Vec<Literal> = first.iter().filter(in_all).copied().collect();
            if !common.is_empty() {
                let rest = without(cubes, &common);
                return and([cube(&common, atoms), divided(&rest, atoms)]);
            }
        }
    }
    let flat = or(cubes.iter().map(|c| cube(c, atoms)));
    let mut best = (Price::of_guard(&flat, Composite::Sequence), flat);
    for taken in shared(cubes) {
        let with = cubes.iter().filter(|cube| cube.contains(&taken));
        let quotient = without(&with.cloned().collect::<Vec<_>>(), &[taken]);
        let divisor = quotients(cubes, &quotient);
        let is_product = |cube: &Vec<Literal>| {
            divisor.iter().any(|d| {
                let left = remove(cube, d);
                left.len() + d.len() == cube.len() && quotient.contains(&left)
            })
        };
        let rest: Vec<Vec<Literal>> = cubes.iter().filter(|c| !is_product(c)).cloned().collect();
        let factor = and([divided(&divisor, atoms), divided(&quotient, atoms)]);
        let whole = match rest.is_empty() {
            true => factor,
            false => or([factor, divided(&rest, atoms)]),
        };
        let price = Price::of_guard(&whole, Composite::Sequence);
        if price < best.0 {
            best = (price, whole);
        }
    }
    best.1
}

/// The literals that several alternatives have, the most frequent first; where there are many alternatives, only that one.
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

/// A cube without these literals.
fn remove(cube: &[Literal], literals: &[Literal]) -> Vec<Literal> {
    let left = cube.iter().filter(|l| !literals.contains(l));
    left.copied().collect()
}

fn without(cubes: &Cubes, literals: &[Literal]) -> Vec<Vec<Literal>> {
    cubes.iter().map(|cube| remove(cube, literals)).collect()
}

/// F divided by Q: the cubes whose conjunction with every cube of Q is a cube of F.
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
    use super::factored;
    use crate::ir::Id;
    use crate::ir::tree::{Atom, Composite, Guard};
    use crate::logic::{Cover, Cube, Literal};
    use crate::tree::size::Price;

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
                Price::of_guard(&guard, Composite::Sequence).nodes,
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
