//! Prime implicants: cubes that hold on some ON rows, on no OFF row, and that no literal can be dropped from.

use super::bits::Bits;
use super::cube::{Cube, Literal};
use super::instance::Instance;

/// All primes that hold on the ON row `seed`, or `None` when the search for them takes more than `budget` steps.
///
/// A prime through the seed is a minimal set of the seed's literals that excludes every OFF row: a minimal hitting set
/// of the sets of literals that exclude one.
pub(super) fn all_through(
    instance: &Instance,
    seed: usize,
    budget: &mut usize,
) -> Option<Vec<Cube>> {
    let literals: Vec<Literal> = instance.on.literals_of(seed).collect();
    let differences = differences(instance, &literals);
    let mut search = Hitting {
        hits: vec![0; differences.len()],
        open: Bits::full(literals.len()),
        differences,
        chosen: Vec::new(),
        found: Vec::new(),
        budget,
    };
    let complete = search.complete(0);
    let cubes = search
        .found
        .into_iter()
        .map(|chosen| Cube::new(chosen.into_iter().filter_map(|i| literals.get(i).copied())));
    complete.then(|| cubes.collect())
}

/// For each OFF row the literals that exclude it, without sets that contain another: who hits that one hits them.
fn differences(instance: &Instance, literals: &[Literal]) -> Vec<Bits> {
    let excluding = literals.iter().map(|literal| {
        let mut rows = instance.all_off();
        if let (Some(column), meets) = instance.off.meeting(*literal) {
            rows.keep(column, !meets);
        }
        rows
    });
    let excluding: Vec<Bits> = excluding.collect();
    let row = |row| {
        let literals = excluding.iter().enumerate();
        let differ = literals.filter(|(_, rows)| rows.contains(row));
        Bits::collect(excluding.len(), differ.map(|(i, _)| i))
    };
    let mut all: Vec<Bits> = (0..instance.off.rows()).map(row).collect();
    all.sort_by_cached_key(|set| (set.count(), set.clone()));
    all.dedup();
    let mut minimal: Vec<Bits> = Vec::new();
    for set in all {
        if !minimal.iter().any(|smaller| smaller.is_subset(&set)) {
            minimal.push(set);
        }
    }
    minimal
}

struct Hitting<'a> {
    differences: Vec<Bits>,
    /// How many chosen literals each difference has.
    hits: Vec<u32>,
    /// Which literals may still be chosen: one that was tried is out of the branches after it.
    open: Bits,
    chosen: Vec<usize>,
    found: Vec<Vec<usize>>,
    budget: &'a mut usize,
}

impl Hitting<'_> {
    /// Completes what is chosen in every minimal way; differences before `from` are hit. False when the budget is spent.
    fn complete(&mut self, from: usize) -> bool {
        let Some(budget) = self.budget.checked_sub(1 + self.differences.len() / 8) else {
            return false;
        };
        *self.budget = budget;
        let unhit = self.hits.iter().skip(from).position(|hits| *hits == 0);
        let Some((at, set)) = unhit.and_then(|i| Some((from + i, self.differences.get(from + i)?)))
        else {
            self.found.push(self.chosen.clone());
            return true;
        };
        let branches = set.and(&self.open);
        let mut within = true;
        for literal in branches.iter() {
            self.open.remove(literal);
            self.chosen.push(literal);
            self.count(literal, u32::wrapping_add);
            // A literal that hits no difference alone is one too many, whatever comes after.
            if self.chosen.iter().all(|chosen| self.hits_alone(*chosen)) {
                within = self.complete(at + 1);
            }
            self.count(literal, u32::wrapping_sub);
            self.chosen.pop();
            if !within {
                break;
            }
        }
        for literal in branches.iter() {
            self.open.insert(literal);
        }
        within
    }

    fn count(&mut self, literal: usize, change: fn(u32, u32) -> u32) {
        for (set, hits) in self.differences.iter().zip(&mut self.hits) {
            if set.contains(literal) {
                *hits = change(*hits, 1);
            }
        }
    }

    fn hits_alone(&self, literal: usize) -> bool {
        let mut sets = self.differences.iter().zip(&self.hits);
        sets.any(|(set, hits)| *hits == 1 && set.contains(literal))
    }
}
