//! Ruin and recreate: a part of a cover is taken out, and what it leaves is covered anew.
//!
//! The rows that only the removed cubes covered are few, so EXPAND finds for them what it could not see among all. It
//! does the work of REDUCE, EXPAND and LASTGASP in Espresso at once.

use super::bits::Bits;
use super::cube::Literal;
use super::expand::Scoring;
use super::instance::Instance;
use super::pool::Pool;
use super::random::Random;
use super::shortest::shortest;
use super::sweep::sweep;

/// How often the search for one short cube may go through all columns.
const SHORTEST: usize = 32;

/// Number of cubes, then of literals.
pub(super) type Cost = (usize, usize);

/// The cost of a cover of primes of the pool.
pub(super) fn cost(pool: &Pool, cover: &[usize]) -> Cost {
    let literals = cover.iter().filter_map(|at| pool.get(*at));
    (cover.len(), literals.map(|prime| prime.literals()).sum())
}

/// How often each row is covered.
fn multiplicity(pool: &Pool, cover: &[usize], rows: usize) -> Vec<u32> {
    let mut times = vec![0; rows];
    for prime in cover.iter().filter_map(|at| pool.get(*at)) {
        for row in prime.covers.iter() {
            if let Some(times) = times.get_mut(row) {
                *times += 1;
            }
        }
    }
    times
}

/// Drops primes that the others make superfluous: long ones first, then those that cover fewest rows.
pub(super) fn irredundant(pool: &Pool, cover: &mut Vec<usize>, rows: usize) {
    let mut times = multiplicity(pool, cover, rows);
    let mut order = cover.clone();
    order.sort_by_cached_key(|at| {
        let prime = pool.get(*at);
        let literals = prime.map_or(0, |prime| prime.literals());
        let covers = prime.map_or(0, |prime| prime.covers.count());
        (std::cmp::Reverse(literals), covers, *at)
    });
    for at in order {
        let Some(prime) = pool.get(at) else { continue };
        let twice = |row| times.get(row).is_some_and(|times| *times > 1);
        if prime.covers.iter().all(twice) {
            for row in prime.covers.iter() {
                if let Some(times) = times.get_mut(row) {
                    *times -= 1;
                }
            }
            cover.retain(|other| *other != at);
        }
    }
}

/// Tries `rounds` changes, and as many after each that made the cover cheaper, while no more than `work` words of rows
/// are gone through.
pub(super) fn improve(
    instance: &Instance,
    pool: &mut Pool,
    mut cover: Vec<usize>,
    rounds: usize,
    mut work: usize,
    random: &mut Random,
) -> Vec<usize> {
    let words = instance.on.rows().div_ceil(64);
    let rows = instance.on.rows();
    irredundant(pool, &mut cover, rows);
    let mut best = cost(pool, &cover);
    let mut left = rounds;
    while left > 0 && cover.len() > 1 {
        left -= 1;
        match work.checked_sub((pool.len() + cover.len()) * words + 2 * instance.words()) {
            Some(less) => work = less,
            None => break,
        }
        let mut next = cover.clone();
        let removed = ruin(&mut next, random);
        let mut open = instance.all_on();
        for prime in next.iter().filter_map(|at| pool.get(*at)) {
            open.subtract(&prime.covers);
        }
        next.extend(recreate(instance, pool, &open, &removed, random, &mut work));
        irredundant(pool, &mut next, rows);
        next.sort_unstable();
        let reached = cost(pool, &next);
        if reached < best {
            left = rounds;
        }
        if reached <= best {
            best = reached;
            cover = next;
        }
    }
    cover
}

/// Takes one to three primes out.
fn ruin(cover: &mut Vec<usize>, random: &mut Random) -> Vec<usize> {
    let count = 1 + random.below(3.min(cover.len()));
    let mut removed = Vec::new();
    while removed.len() < count {
        removed.push(cover.swap_remove(random.below(cover.len())));
    }
    removed
}

/// The literals that hold on all of the rows.
fn shared(instance: &Instance, rows: &Bits) -> Option<Vec<Literal>> {
    let first = rows.first()?;
    let holds = |literal: &Literal| match instance.on.inside(*literal) {
        (Some(column), true) => rows.is_subset(column),
        (Some(column), false) => rows.is_disjoint(column),
        (None, _) => false,
    };
    Some(instance.on.literals_of(first).filter(holds).collect())
}

/// Primes for the open rows: one for all, where there is one shorter than what was removed; else new ones, or what the
/// pool has.
fn recreate(
    instance: &Instance,
    pool: &mut Pool,
    open: &Bits,
    removed: &[usize],
    random: &mut Random,
    work: &mut usize,
) -> Vec<usize> {
    let Some(shared) = shared(instance, open) else {
        return Vec::new();
    };
    let (_, literals) = cost(pool, removed);
    let limit = match removed {
        [_] => literals,
        _ => usize::MAX,
    };
    let granted = (SHORTEST * instance.words()).min(*work);
    let mut left = granted;
    let short = shortest(instance, &shared, limit, &mut left);
    *work -= granted - left;
    if let Some(cube) = short {
        return vec![pool.add(instance, cube)];
    }
    let all = Scoring::ALL;
    let scoring = random.below(all.len());
    let scoring = all.get(scoring).copied().unwrap_or(Scoring::Ratio);
    let fresh = sweep(instance, pool, open, 2, &[scoring], random);
    let chosen = choose(pool, open);
    let covered = |cover: &[usize]| cost(pool, cover);
    if covered(&chosen) < covered(&fresh) {
        chosen
    } else {
        fresh
    }
}

/// A greedy choice out of the whole pool.
fn choose(pool: &Pool, rows: &Bits) -> Vec<usize> {
    let mut open = rows.clone();
    let mut cover = Vec::new();
    while !open.is_empty() {
        let gains = pool.primes().iter().enumerate().map(|(at, prime)| {
            let gain = prime.covers.count_both(&open);
            (
                gain,
                std::cmp::Reverse(prime.literals()),
                std::cmp::Reverse(at),
            )
        });
        let Some((gain, _, std::cmp::Reverse(at))) = gains.max() else {
            break;
        };
        let Some(prime) = pool.get(at).filter(|_| gain > 0) else {
            break;
        };
        open.subtract(&prime.covers);
        cover.push(at);
    }
    cover
}
