//! Large problems: a cover of expanded primes, and what ruin and recreate makes of it.
//!
//! Some cubes are taken out of a cover, and the rows that only they covered are covered anew. These rows are few, so
//! EXPAND finds for them what it could not see among all. This does the work of REDUCE, EXPAND and LASTGASP in Espresso
//! at once. The pool of all primes that were ever found is that of BOOM (Hlavička and Fišer 2001).

use super::Effort;
use super::expand::{Scoring, sweep};
use super::instance::{Instance, Pool, Prime};
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::cube::{Cube, Literal};
use crate::logic::random::Random;
use std::cmp::Reverse;

/// The search for one short cube may read the whole problem this many times.
const SHORTEST: usize = 32;

/// A cover, and the pool of its primes; `None` if the account is spent before there is one.
pub(super) fn heuristic(
    instance: &Instance,
    effort: &Effort,
    account: &Account,
) -> Option<(Pool, Vec<usize>)> {
    let mut pool = Pool::default();
    let mut random = Random::new(0);
    let on = instance.all_on();
    let all = &Scoring::ALL;
    let cover = sweep(
        instance,
        &mut pool,
        &on,
        effort.seeds,
        all,
        &mut random,
        account,
    )?;
    let cover = improve(instance, &mut pool, cover, effort, &mut random, account);
    Some((pool, cover))
}

/// The number of primes that cover each row.
fn multiplicity(pool: &Pool, cover: &[usize], rows: usize) -> Vec<u32> {
    let mut times = vec![0; rows];
    for prime in pool.among(cover) {
        for row in prime.covers.iter() {
            if let Some(times) = times.get_mut(row) {
                *times += 1;
            }
        }
    }
    times
}

/// Drops primes that the others make superfluous: long ones first, then those that cover fewest rows.
fn irredundant(pool: &Pool, cover: &mut Vec<usize>, rows: usize) {
    let mut times = multiplicity(pool, cover, rows);
    let mut order = cover.clone();
    order.sort_by_cached_key(|at| {
        let prime = pool.get(*at);
        let literals = prime.map_or(0, Prime::literals);
        let covers = prime.map_or(0, |prime| prime.covers.count());
        (Reverse(literals), covers, *at)
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

/// Tries some changes, and as many again after each that makes the cover cheaper, within the work that is allowed.
fn improve(
    instance: &Instance,
    pool: &mut Pool,
    mut cover: Vec<usize>,
    effort: &Effort,
    random: &mut Random,
    account: &Account,
) -> Vec<usize> {
    let rows = instance.on.rows();
    let words = rows.div_ceil(64);
    irredundant(pool, &mut cover, rows);
    let mut best = pool.cost(&cover);
    let mut work = effort.work;
    let rounds = effort.rounds * (cover.len() + 24);
    let mut left = rounds;
    while left > 0 && cover.len() > 1 {
        left -= 1;
        let step = (pool.len() + cover.len()) * words + 2 * instance.words();
        account.spend((step + 8 * (pool.len() + cover.len())) as u64);
        match work.checked_sub(step) {
            Some(less) if !account.is_spent() => work = less,
            _ => break,
        }
        let mut next = cover.clone();
        let removed = ruin(&mut next, random);
        let mut open = instance.all_on();
        pool.among(&next).for_each(|p| open.subtract(&p.covers));
        let granted = Left {
            work: &mut work,
            account,
        };
        match recreate(instance, pool, &open, &removed, random, granted) {
            Some(primes) => next.extend(primes),
            None => break,
        }
        irredundant(pool, &mut next, rows);
        next.sort_unstable();
        let reached = pool.cost(&next);
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

/// What may still be spent on one cover, and on all.
struct Left<'a> {
    work: &'a mut usize,
    account: &'a Account,
}

/// Takes one to three primes out of a cover.
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

/// Primes for the open rows: one for all if there is one shorter than the one removed; else new ones or, if they are
/// cheaper, those of the pool. `None` if the account is spent.
fn recreate(
    instance: &Instance,
    pool: &mut Pool,
    open: &Bits,
    removed: &[usize],
    random: &mut Random,
    Left { work, account }: Left,
) -> Option<Vec<usize>> {
    let Some(shared) = shared(instance, open) else {
        return Some(Vec::new());
    };
    let (_, literals) = pool.cost(removed);
    let limit = match removed {
        [_] => literals,
        _ => usize::MAX,
    };
    let granted = (SHORTEST * instance.words()).min(*work);
    let mut left = granted;
    let short = shortest(instance, &shared, limit, &mut left);
    *work -= granted - left;
    account.spend((granted - left) as u64);
    if let Some(cube) = short {
        return Some(vec![pool.add(instance, cube)]);
    }
    let all = Scoring::ALL;
    let scoring = random.below(all.len());
    let scoring = all.get(scoring).copied().unwrap_or(Scoring::Ratio);
    let fresh = sweep(instance, pool, open, 2, &[scoring], random, account)?;
    let chosen = pool.greedy(open);
    let words = 2 + open.bound().div_ceil(64);
    account.spend(((1 + chosen.len()) * pool.len() * words) as u64);
    Some(match pool.cost(&chosen) < pool.cost(&fresh) {
        true => chosen,
        false => fresh,
    })
}

/// A shortest cube of these literals, with fewer than `limit`, that meets no OFF row, as far as a search finds it that
/// reads no more words of rows than the budget.
///
/// It is a smallest set of literals that contains, for every OFF row, one that excludes it.
fn shortest(
    instance: &Instance,
    literals: &[Literal],
    limit: usize,
    budget: &mut usize,
) -> Option<Cube> {
    let all = Cube::new(literals.iter().copied());
    let met = instance.off.cube_meets(&all, &instance.all_off());
    if !met.is_empty() {
        return None;
    }
    let excludes = literals.iter().map(|literal| instance.excluded(*literal));
    let mut search = Shortest {
        excludes: excludes.collect(),
        chosen: Vec::new(),
        best: None,
        limit,
        budget,
    };
    search.extend(&instance.all_off(), &Bits::full(literals.len()));
    let best = search.best?;
    let chosen = best.into_iter().filter_map(|i| literals.get(i).copied());
    Some(Cube::new(chosen))
}

struct Shortest<'a> {
    /// The OFF rows that each literal excludes.
    excludes: Vec<Bits>,
    chosen: Vec<usize>,
    best: Option<Vec<usize>>,
    /// Cubes with as many literals are too long.
    limit: usize,
    budget: &'a mut usize,
}

impl Shortest<'_> {
    /// Adds literals out of `open` until none of the rows in `left` is left.
    fn extend(&mut self, left: &Bits, open: &Bits) {
        let rows = left.count();
        if rows == 0 {
            self.limit = self.chosen.len();
            self.best = Some(self.chosen.clone());
            return;
        }
        if *self.budget == 0 || self.chosen.len() + 1 >= self.limit {
            return;
        }
        *self.budget = self
            .budget
            .saturating_sub(open.count() * left.words().len());
        let counts = open
            .iter()
            .filter_map(|i| Some((self.excludes.get(i)?.count_both(left), i)));
        let mut counts: Vec<(usize, usize)> = counts.filter(|(count, _)| *count > 0).collect();
        counts.sort_unstable_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
        let most: Vec<usize> = counts.iter().map(|(count, _)| *count).collect();
        let mut open = open.clone();
        // The literal that excludes most is tried first, and none before it in the list is tried with it again.
        for (at, (_, literal)) in counts.into_iter().enumerate() {
            let may = self.limit.saturating_sub(1 + self.chosen.len());
            if most.iter().skip(at).take(may).sum::<usize>() < rows {
                return;
            }
            open.remove(literal);
            let Some(excludes) = self.excludes.get(literal) else {
                continue;
            };
            let after = left.minus(excludes);
            self.chosen.push(literal);
            self.extend(&after, &open);
            self.chosen.pop();
        }
    }
}
