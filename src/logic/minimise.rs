//! Two-level minimisation from an ON set and an OFF set.

use super::bits::Bits;
use super::columns::Columns;
use super::covering::{Choice, cheapest, greedy};
use super::cube::{Cover, Cube};
use super::primes::{Scoring, all_through, expand};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// Rows up to which all primes are sought, steps of that search, and the most primes for an exact cover.
const EXACT_ROWS: usize = 160;
const PRIME_STEPS: usize = 8_000;
const EXACT_PRIMES: usize = 1_500;
/// Steps of the exact cover, and rows times choices that they may go through.
const COVER_STEPS: usize = 4_000;
const COVER_WORK: usize = 2_000_000;
/// ON rows up to which every one of them is a seed of EXPAND.
const SEEDS: usize = 512;

/// A cover that holds on every row of `on` and on no row of `off`, of primes, none of which can be left out.
///
/// Small problems are solved exactly: fewest cubes, then fewest literals (Quine and McCluskey's covering problem over
/// the primes that hold on some ON row). Larger ones by a pool of expanded primes and a greedy cover, as in BOOM
/// (Hlavička and Fišer 2001). `on` and `off` are disjoint, and their rows differ.
pub fn minimise(columns: &Columns, on: &Bits, off: &Bits) -> Cover {
    if on.is_empty() {
        return Cover::default();
    }
    if off.is_empty() {
        return Cover::new([Cube::default()]);
    }
    let (pool, exact) = match all_primes(columns, on, off) {
        Some(primes) => (primes, true),
        None => (expanded(columns, on, off), false),
    };
    let choices: Vec<Choice> = pool
        .iter()
        .map(|(cube, covers)| Choice {
            covers: covers.clone(),
            weight: cube.literals().len(),
        })
        .collect();
    let chosen = if exact || choices.len() <= EXACT_PRIMES {
        let each = on.count() * (1 + choices.len() / 8);
        cheapest(on, &choices, (COVER_WORK / each).clamp(20, COVER_STEPS))
    } else {
        greedy(on, &choices)
    };
    let cubes: Vec<Cube> = pool.into_keys().collect();
    Cover::new(chosen.into_iter().filter_map(|i| cubes.get(i).cloned()))
}

/// Every prime with the ON rows on which it holds; `None` where there are too many.
fn all_primes(columns: &Columns, on: &Bits, off: &Bits) -> Option<BTreeMap<Cube, Bits>> {
    if on.count() + off.count() > EXACT_ROWS {
        return None;
    }
    let mut primes = BTreeMap::new();
    let mut budget = PRIME_STEPS;
    for seed in on.iter() {
        for cube in all_through(columns, seed, off, &mut budget)? {
            if let Entry::Vacant(new) = primes.entry(cube) {
                let covers = columns.cube_rows(new.key(), on);
                new.insert(covers);
            }
        }
        if primes.len() > EXACT_PRIMES {
            return None;
        }
    }
    Some(primes)
}

/// A pool of primes: from every ON row while there are few, then from rows that no prime holds on yet.
fn expanded(columns: &Columns, on: &Bits, off: &Bits) -> BTreeMap<Cube, Bits> {
    let mut pool = BTreeMap::new();
    let mut covered = Bits::empty(columns.rows());
    for (i, seed) in on.iter().enumerate() {
        if i >= SEEDS && covered.contains(seed) {
            continue;
        }
        for scoring in [Scoring::Ratio, Scoring::KeepOn, Scoring::DropOff] {
            let cube = expand(columns, seed, on, off, scoring);
            let covers = columns.cube_rows(&cube, on);
            covered = covered.or(&covers);
            pool.entry(cube).or_insert(covers);
        }
    }
    pool
}
