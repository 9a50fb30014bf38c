//! Minimisation of an instance as a whole: a pool of primes, and the cheapest choice among them.

use super::bits::Bits;
use super::covering::{Choice, cheapest, greedy};
use super::cube::{Cover, Cube, Literal};
use super::expand::{Scoring, expand};
use super::instance::Instance;
use super::minimise::{Effort, Solution};
use super::primes::all_through;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

/// The most primes for an exact cover.
const EXACT_PRIMES: usize = 1_500;
/// Seeds that are expanded at a time.
const BATCH: usize = 64;

/// A cover of the instance.
///
/// Small problems are solved exactly: fewest cubes, then fewest literals (Quine and McCluskey's covering problem over
/// the primes that hold on some ON row). Larger ones by a pool of expanded primes and a greedy cover, as in BOOM
/// (Hlavička and Fišer 2001).
pub(super) fn solve(instance: &Instance, effort: &Effort) -> Solution {
    if instance.on.rows() == 0 {
        return Solution {
            cover: Cover::default(),
            proved: true,
        };
    }
    if instance.off.rows() == 0 {
        return Solution {
            cover: Cover::new([Cube::default()]),
            proved: true,
        };
    }
    let (pool, exact) = match all_primes(instance, effort) {
        Some(primes) => (primes, true),
        None => (expanded(instance, effort), false),
    };
    let on = instance.all_on();
    let choices: Vec<Choice> = pool
        .iter()
        .map(|(cube, covers)| Choice {
            covers: covers.clone(),
            weight: cube.literals().len(),
        })
        .collect();
    let chosen = if exact || choices.len() <= EXACT_PRIMES {
        let each = on.count() * (1 + choices.len() / 8);
        let steps = (effort.cover_work / each).clamp(20, effort.cover_steps);
        cheapest(&on, &choices, steps)
    } else {
        greedy(&on, &choices)
    };
    let cubes: Vec<Cube> = pool.into_keys().collect();
    Solution {
        cover: Cover::new(chosen.into_iter().filter_map(|i| cubes.get(i).cloned())),
        proved: false,
    }
}

/// Every prime with the ON rows on which it holds; `None` where there are too many.
fn all_primes(instance: &Instance, effort: &Effort) -> Option<BTreeMap<Cube, Bits>> {
    if instance.rows() > effort.exact_rows {
        return None;
    }
    let mut primes = BTreeMap::new();
    let mut budget = effort.prime_steps;
    for seed in 0..instance.on.rows() {
        for cube in all_through(instance, seed, &mut budget)? {
            if let Entry::Vacant(new) = primes.entry(cube) {
                let covers = instance.covered(new.key());
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
fn expanded(instance: &Instance, effort: &Effort) -> BTreeMap<Cube, Bits> {
    let mut pool = BTreeMap::new();
    let on = instance.all_on();
    let mut covered = Bits::empty(on.bound());
    let mut next = 0;
    while next < on.bound() {
        let mut seeds = Vec::new();
        while next < on.bound() && seeds.len() < BATCH {
            if next < effort.seeds || !covered.contains(next) {
                seeds.push(next);
            }
            next += 1;
        }
        let found = seeds.par_iter().flat_map_iter(|seed| {
            let literals: Vec<Literal> = instance.on.literals_of(*seed).collect();
            let on = &on;
            Scoring::ALL
                .into_iter()
                .map(move |scoring| expand(instance, literals.clone(), on, scoring))
        });
        for cube in found.collect::<Vec<Cube>>() {
            if let Entry::Vacant(new) = pool.entry(cube) {
                let covers = instance.covered(new.key());
                covered.unite(&covers);
                new.insert(covers);
            }
        }
    }
    pool
}
