//! The complement of a cover.

use super::packed::Packed;
use std::collections::BTreeSet;

/// Words of cubes that may be read for each cube that the complement may have.
const WORK: usize = 64;

/// Cubes over `atoms` atoms that hold exactly where none of `cubes` does; `None` if there are more than `limit`, or if it
/// takes too much work to find them.
///
/// By Shannon expansion about the atom that most cubes fix, of those that are fixed to both values. About an atom that is
/// fixed to one value only, one half of the complement holds whatever the atom is (Brayton, Hachtel, McMullen and
/// Sangiovanni-Vincentelli 1984, chapter 3). Atoms that are cubes by themselves are fixed together, without a step for each.
pub fn complement(atoms: usize, cubes: &[Packed], limit: usize) -> Option<Vec<Packed>> {
    let mut search = Complement {
        atoms,
        limit,
        work: limit.saturating_mul(WORK),
    };
    search.of(cubes.to_vec())
}

struct Complement {
    atoms: usize,
    limit: usize,
    work: usize,
}

impl Complement {
    fn of(&mut self, cubes: Vec<Packed>) -> Option<Vec<Packed>> {
        let words = self.atoms.div_ceil(64).max(1);
        self.work = self.work.checked_sub((1 + cubes.len()) * words)?;
        if cubes.iter().any(Packed::is_universe) {
            return Some(Vec::new());
        }
        match Packed::universe(self.atoms).outside(&cubes) {
            None => return Some(Vec::new()),
            Some(left) if !left.is_universe() => return self.within(&left, &cubes),
            Some(_) => {}
        }
        match cubes.as_slice() {
            [] => return Some(vec![Packed::universe(self.atoms)]),
            [only] => return Some(self.of_one(only)),
            _ => {}
        }
        // Every cube fixes some atom; the universe alone does not.
        let (atom, unate) = split(self.atoms, &cubes)?;
        let complement = match unate {
            // Where the atom has the other value fewer cubes hold, so the complement of this half is in that one's.
            Some(value) => {
                let mut everywhere = self.of(cofactor(&cubes, atom, value))?;
                let opposite = self.of(cofactor(&cubes, atom, !value))?;
                everywhere.extend(opposite.into_iter().map(|mut cube| {
                    cube.set(atom, Some(!value));
                    cube
                }));
                everywhere
            }
            None => {
                let one = self.of(cofactor(&cubes, atom, true))?;
                let zero = self.of(cofactor(&cubes, atom, false))?;
                merge(atom, one, zero)
            }
        };
        (complement.len() <= self.limit).then_some(complement)
    }

    /// The complement where it lies in a cube.
    fn within(&mut self, left: &Packed, cubes: &[Packed]) -> Option<Vec<Packed>> {
        let others = cubes.iter().filter(|cube| cube.meets(left));
        let complement = self.of(others.map(|cube| cube.without(left)).collect())?;
        Some(complement.iter().map(|cube| cube.and(left)).collect())
    }

    /// De Morgan.
    fn of_one(&self, cube: &Packed) -> Vec<Packed> {
        let one = |(atom, value): (usize, bool)| {
            let mut cube = Packed::universe(self.atoms);
            cube.set(atom, Some(!value));
            cube
        };
        cube.fixed().map(one).collect()
    }
}

/// The atom to split by: the one that most cubes fix, of those that some fix to 1 and some to 0. Without any, the one
/// that most cubes fix, with the value.
fn split(atoms: usize, cubes: &[Packed]) -> Option<(usize, Option<bool>)> {
    let mut counts = vec![(0_usize, 0_usize); atoms];
    for (atom, value) in cubes.iter().flat_map(Packed::fixed) {
        if let Some((ones, zeros)) = counts.get_mut(atom) {
            *(if value { ones } else { zeros }) += 1;
        }
    }
    let key = |(atom, (ones, zeros)): (usize, (usize, usize))| {
        let rank = (ones.min(zeros) > 0, ones + zeros, std::cmp::Reverse(atom));
        (rank, (atom, ones, zeros))
    };
    let (_, (atom, ones, zeros)) = counts.into_iter().enumerate().map(key).max()?;
    let value = match (ones, zeros) {
        (0, 0) => return None,
        (_, 0) => Some(true),
        (0, _) => Some(false),
        _ => None,
    };
    Some((atom, value))
}

/// What the cubes are where the atom has this value.
fn cofactor(cubes: &[Packed], atom: usize, value: bool) -> Vec<Packed> {
    let there = cubes.iter().filter(|cube| cube.get(atom) != Some(!value));
    let freed = there.map(|cube| {
        let mut cube = cube.clone();
        cube.set(atom, None);
        cube
    });
    freed.collect()
}

/// The cubes of both halves; what stands in both stands once, with the atom free.
fn merge(atom: usize, one: Vec<Packed>, zero: Vec<Packed>) -> Vec<Packed> {
    let one: BTreeSet<Packed> = one.into_iter().collect();
    let zero: BTreeSet<Packed> = zero.into_iter().collect();
    let half = |cubes: &BTreeSet<Packed>, others: &BTreeSet<Packed>, value: bool| {
        let own = cubes.difference(others).cloned().map(move |mut cube| {
            cube.set(atom, Some(value));
            cube
        });
        own.collect::<Vec<Packed>>()
    };
    let mut all: Vec<Packed> = one.intersection(&zero).cloned().collect();
    all.extend(half(&one, &zero, true));
    all.extend(half(&zero, &one, false));
    all
}
