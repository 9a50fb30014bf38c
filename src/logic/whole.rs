//! Minimisation of an instance as a whole: a pool of primes, and the cheapest choice among them.

use super::covering::{Choice, cheapest};
use super::cube::{Cover, Cube};
use super::expand::Scoring;
use super::improve::{cost, improve, irredundant};
use super::instance::Instance;
use super::minimise::{Effort, Solution};
use super::pool::Pool;
use super::primes::all_through;
use super::random::Random;
use super::sweep::sweep;

/// The most primes for an exact cover.
const EXACT_PRIMES: usize = 1_500;

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
    let (pool, chosen, proved) = match all_primes(instance, effort) {
        Some(primes) => {
            let (chosen, cheapest) = exact(instance, &primes, effort);
            // A cube may be covered by several primes together, which the choice does not see.
            let proved = cheapest && instance.on.are_minterms();
            (primes, chosen, proved)
        }
        None => {
            let (pool, chosen) = heuristic(instance, effort);
            (pool, chosen, false)
        }
    };
    let cubes = chosen.into_iter().filter_map(|at| pool.get(at));
    Solution {
        cover: Cover::new(cubes.map(|prime| prime.cube.clone())),
        proved,
    }
}

/// Every prime that an ON row lies in; `None` where there are too many.
fn all_primes(instance: &Instance, effort: &Effort) -> Option<Pool> {
    if instance.rows() > effort.exact_rows {
        return None;
    }
    let mut primes = Pool::default();
    let mut budget = effort.prime_steps;
    for seed in 0..instance.on.rows() {
        for cube in all_through(instance, seed, &mut budget)? {
            primes.add(instance, cube);
        }
        if primes.len() > EXACT_PRIMES {
            return None;
        }
    }
    Some(primes)
}

fn exact(instance: &Instance, pool: &Pool, effort: &Effort) -> (Vec<usize>, bool) {
    let on = instance.all_on();
    let choices: Vec<Choice> = pool
        .primes()
        .iter()
        .map(|prime| Choice {
            covers: prime.covers.clone(),
            weight: prime.literals(),
        })
        .collect();
    let each = on.count() * (1 + choices.len() / 8);
    let steps = (effort.cover_work / each).clamp(20, effort.cover_steps);
    cheapest(&on, &choices, steps)
}

fn heuristic(instance: &Instance, effort: &Effort) -> (Pool, Vec<usize>) {
    let mut pool = Pool::default();
    let mut random = Random::new(0);
    let on = instance.all_on();
    let rows = instance.on.rows();
    let mut best: Option<Vec<usize>> = None;
    for _ in 0..effort.sweeps {
        let mut cover = sweep(
            instance,
            &mut pool,
            &on,
            effort.seeds,
            &Scoring::ALL,
            &mut random,
        );
        irredundant(&pool, &mut cover, rows);
        if best
            .as_ref()
            .is_none_or(|best| cost(&pool, &cover) < cost(&pool, best))
        {
            best = Some(cover);
        }
    }
    let cover = best.unwrap_or_default();
    let rounds = effort.rounds * (cover.len() + 24);
    let cover = improve(instance, &mut pool, cover, rounds, effort.work, &mut random);
    (pool, cover)
}
