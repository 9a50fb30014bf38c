//! Prime implicants: cubes that hold on some ON rows, on no OFF row, and that no literal can be dropped from.

use super::bits::Bits;
use super::columns::Columns;
use super::cube::{Cube, Literal};

/// All primes that hold in the row `seed`, or `None` when the search for them takes more than `budget` steps.
///
/// A prime through the seed is a minimal set of the seed's literals that excludes every OFF row: a minimal hitting set
/// of the sets of atoms in which the OFF rows differ from the seed.
pub fn all_through(
    columns: &Columns,
    seed: usize,
    off: &Bits,
    budget: &mut usize,
) -> Option<Vec<Cube>> {
    let differences = differences(columns, seed, off);
    let mut search = Hitting {
        hits: vec![0; differences.len()],
        open: Bits::full(columns.atoms()),
        differences,
        chosen: Vec::new(),
        found: Vec::new(),
        budget,
    };
    let complete = search.complete(0);
    let cubes = search.found.into_iter().map(|atoms| {
        Cube::new(atoms.into_iter().map(|atom| Literal {
            atom,
            positive: columns.value(seed, atom),
        }))
    });
    complete.then(|| cubes.collect())
}

/// The atoms in which OFF rows differ from the seed, without sets that contain another: who hits that one hits them.
fn differences(columns: &Columns, seed: usize, off: &Bits) -> Vec<Bits> {
    let mut all: Vec<Bits> = off
        .iter()
        .map(|row| {
            let differs =
                |(_, column): &(usize, &Bits)| column.contains(row) != column.contains(seed);
            Bits::collect(
                columns.atoms(),
                columns.iter().filter(differs).map(|(atom, _)| atom),
            )
        })
        .collect();
    all.sort_by_cached_key(|set| (set.count(), set.clone()));
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
    /// How many chosen atoms each difference has.
    hits: Vec<u32>,
    /// Which atoms may still be chosen: one that was tried is out of the branches after it.
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
        for atom in branches.iter() {
            self.open.remove(atom);
            self.chosen.push(atom);
            self.count(atom, u32::wrapping_add);
            // An atom that hits no difference alone is one too many, whatever comes after.
            if self.chosen.iter().all(|chosen| self.hits_alone(*chosen)) {
                within = self.complete(at + 1);
            }
            self.count(atom, u32::wrapping_sub);
            self.chosen.pop();
            if !within {
                break;
            }
        }
        for atom in branches.iter() {
            self.open.insert(atom);
        }
        within
    }

    fn count(&mut self, atom: usize, change: fn(u32, u32) -> u32) {
        for (set, hits) in self.differences.iter().zip(&mut self.hits) {
            if set.contains(atom) {
                *hits = change(*hits, 1);
            }
        }
    }

    fn hits_alone(&self, atom: usize) -> bool {
        let mut sets = self.differences.iter().zip(&self.hits);
        sets.any(|(set, hits)| *hits == 1 && set.contains(atom))
    }
}

/// How EXPAND weighs a literal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scoring {
    /// OFF rows excluded per ON row lost.
    Ratio,
    /// Fewest ON rows lost, then most OFF rows excluded.
    KeepOn,
    /// Most OFF rows excluded, then fewest ON rows lost.
    DropOff,
}

/// One prime through the seed: from the cube without literals, adds the literal of the seed that scores best until no
/// OFF row is left, then drops literals while none comes back.
pub fn expand(columns: &Columns, seed: usize, on: &Bits, off: &Bits, scoring: Scoring) -> Cube {
    let mut open: Vec<Literal> = columns.literals_of(seed).collect();
    let (mut kept, mut left) = (on.clone(), off.clone());
    let mut chosen = Vec::new();
    while !left.is_empty() {
        let (ons, offs) = (kept.count(), left.count());
        let mut best: Option<((u64, u64), Literal)> = None;
        for literal in &open {
            let (mut k, mut l) = (kept.clone(), left.clone());
            columns.restrict(&mut k, *literal);
            columns.restrict(&mut l, *literal);
            let (lost, gone) = ((ons - k.count()) as u64, (offs - l.count()) as u64);
            if gone == 0 {
                continue;
            }
            let score = match scoring {
                Scoring::Ratio => (gone * (1 << 20) / (lost + 1), gone),
                Scoring::KeepOn => (u64::MAX - lost, gone),
                Scoring::DropOff => (gone, u64::MAX - lost),
            };
            if best.is_none_or(|(top, _)| score > top) {
                best = Some((score, *literal));
            }
        }
        // A row that is both ON and OFF cannot be told apart; the caller's sets are disjoint.
        let Some((_, literal)) = best else { break };
        columns.restrict(&mut kept, literal);
        columns.restrict(&mut left, literal);
        open.retain(|l| *l != literal);
        chosen.push(literal);
    }
    prune(columns, Cube::new(chosen), on, off)
}

/// The cube without the literals that it can do without; those that cost most ON rows go first.
pub fn prune(columns: &Columns, mut cube: Cube, on: &Bits, off: &Bits) -> Cube {
    loop {
        let shorter = cube
            .literals()
            .iter()
            .map(|literal| cube.without(*literal))
            .filter(|shorter| columns.cube_rows(shorter, off).is_empty())
            .enumerate()
            .max_by_key(|(i, shorter)| {
                (
                    columns.cube_rows(shorter, on).count(),
                    std::cmp::Reverse(*i),
                )
            });
        match shorter {
            Some((_, shorter)) => cube = shorter,
            None => return cube,
        }
    }
}
