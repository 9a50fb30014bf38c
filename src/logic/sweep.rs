//! A cover from the left: primes for the rows that none holds on yet, the widest first.

use super::bits::Bits;
use super::cube::{Cube, Literal};
use super::expand::{Scoring, expand};
use super::instance::Instance;
use super::pool::Pool;
use super::random::{Random, sample};
use rayon::prelude::*;

/// Words of rows that one expansion goes through, from which on expansions go to several threads.
const PARALLEL: usize = 20_000;

/// Primes of the pool that cover `rows` together.
///
/// Literals are weighed on the rows that are still open, so that what few rows have in common is not drowned by the
/// others. Each time some open rows are seeds of EXPAND; of the primes found the widest is taken, and those that cover
/// nearly as many of the rows that it leaves.
pub(super) fn sweep(
    instance: &Instance,
    pool: &mut Pool,
    rows: &Bits,
    seeds: usize,
    scorings: &[Scoring],
    random: &mut Random,
) -> Vec<usize> {
    let mut open = rows.clone();
    let mut cover = Vec::new();
    while !open.is_empty() {
        let seeds = sample(open.iter(), open.count(), seeds, random);
        let mut found: Vec<usize> = expansions(instance, &seeds, &open, scorings)
            .into_iter()
            .map(|cube| pool.add(instance, cube))
            .collect();
        found.sort_unstable();
        found.dedup();
        let mut widest = 0;
        while let Some((gain, at)) = best(pool, &found, &open) {
            if gain == 0 || 2 * gain <= widest {
                break;
            }
            widest = widest.max(gain);
            if let Some(prime) = pool.get(at) {
                open.subtract(&prime.covers);
            }
            cover.push(at);
        }
        // Without a gain the rows that are left cannot be told from OFF rows; the caller's sets are disjoint.
        if widest == 0 {
            break;
        }
    }
    cover
}

/// The prime that covers most open rows, of several the shortest, then the first.
fn best(pool: &Pool, among: &[usize], open: &Bits) -> Option<(usize, usize)> {
    let gains = among.iter().filter_map(|at| {
        let prime = pool.get(*at)?;
        let gain = prime.covers.count_both(open);
        let key = (
            gain,
            std::cmp::Reverse(prime.literals()),
            std::cmp::Reverse(*at),
        );
        Some((key, *at))
    });
    gains
        .max_by_key(|(key, _)| *key)
        .map(|((gain, ..), at)| (gain, at))
}

/// A prime for each seed and scoring, in this order on any number of threads.
pub(super) fn expansions(
    instance: &Instance,
    seeds: &[usize],
    open: &Bits,
    scorings: &[Scoring],
) -> Vec<Cube> {
    let one = |(seed, scoring): (usize, Scoring)| {
        let literals: Vec<Literal> = instance.on.literals_of(seed).collect();
        expand(instance, literals, open, scoring)
    };
    let pairs = seeds
        .iter()
        .flat_map(|seed| scorings.iter().map(|s| (*seed, *s)));
    if instance.words() < PARALLEL {
        return pairs.map(one).collect();
    }
    pairs.collect::<Vec<_>>().into_par_iter().map(one).collect()
}
