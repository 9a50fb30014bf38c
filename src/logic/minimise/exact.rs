//! Small problems: all primes, and the cheapest choice among them (Quine and McCluskey's covering problem).
//!
//! A prime is a cube that holds on some ON rows and on no OFF row, and of which no literal can be dropped.

use super::Effort;
use super::instance::{Cost, Instance, Pool, Prime};
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::cube::{Cube, Literal};
use std::cmp::Reverse;

/// The most primes among which a choice is made.
const PRIMES: usize = 1_500;

/// A cover of fewest cubes, then fewest literals, with the pool of its primes, and whether it is proved to be; `None`
/// where there are too many rows or primes.
pub(super) fn exact(
    instance: &Instance,
    effort: &Effort,
    account: &Account,
) -> Option<(Pool, Vec<usize>, bool)> {
    if instance.rows() > effort.exact_rows {
        return None;
    }
    let mut pool = Pool::default();
    // A step of this search takes about as long as reading eight words.
    let affordable = usize::try_from(account.left() / 8).unwrap_or(usize::MAX);
    let mut budget = effort.prime_steps.min(affordable);
    for seed in 0..instance.on.rows() {
        let before = budget;
        let found = all_through(instance, seed, &mut budget);
        let differences = instance.words() + instance.off.rows();
        account.spend((8 * (before - budget) + differences) as u64);
        for cube in found? {
            pool.add(instance, cube);
        }
        if pool.len() > PRIMES {
            return None;
        }
    }
    let step = instance.on.rows() * (1 + pool.len() / 8);
    let steps = (effort.cover_work / step).clamp(20, effort.cover_steps);
    let (chosen, is_cheapest) = cheapest(instance, &pool, steps, account);
    // Several primes may cover a cube together, which the choice does not see.
    let proved = is_cheapest && instance.on.are_minterms();
    Some((pool, chosen, proved))
}

/// All primes that hold on the ON row `seed`; `None` if the search takes more steps than the budget.
///
/// A prime through the seed is a minimal set of the seed's literals that excludes every OFF row: a minimal hitting set
/// of the sets of literals that exclude one.
fn all_through(instance: &Instance, seed: usize, budget: &mut usize) -> Option<Vec<Cube>> {
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

/// For each OFF row the literals that exclude it. Sets that contain another are left out: what hits that one hits them.
fn differences(instance: &Instance, literals: &[Literal]) -> Vec<Bits> {
    let excluding = literals.iter().map(|literal| instance.excluded(*literal));
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
    /// The number of chosen literals in each difference.
    hits: Vec<u32>,
    /// The literals that may still be chosen. One that was tried is not tried again in the branches after it.
    open: Bits,
    chosen: Vec<usize>,
    found: Vec<Vec<usize>>,
    budget: &'a mut usize,
}

impl Hitting<'_> {
    /// Completes the choice in every minimal way; differences before `from` are hit. False when the budget is spent.
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
            // A literal that hits no difference alone is superfluous, whatever follows.
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

/// The cheapest choice of primes that covers all ON rows, found by branch and bound from a greedy one. Whether it is
/// proved to be the cheapest: the search ended within `budget` steps.
fn cheapest(
    instance: &Instance,
    pool: &Pool,
    budget: usize,
    account: &Account,
) -> (Vec<usize>, bool) {
    let rows = instance.all_on();
    let best = irredundant(&rows, pool, pool.greedy(&rows));
    let useful = undominated(pool.primes());
    let mut through: Vec<(usize, Vec<usize>)> = rows
        .iter()
        .map(|row| {
            let covers = |at: &usize| pool.get(*at).is_some_and(|p| p.covers.contains(row));
            (row, useful.iter().copied().filter(covers).collect())
        })
        .collect();
    through.sort_by_key(|(row, primes)| (primes.len(), *row));
    let mut search = BranchAndBound {
        pool,
        through,
        cost: pool.cost(&best),
        best,
        budget,
        complete: true,
    };
    search.branch(&rows, &mut Vec::new(), (0, 0));
    let step = instance.on.rows() * (1 + pool.len() / 8);
    account.spend(((1 + budget - search.budget) * step) as u64);
    search.best.sort_unstable();
    (search.best, search.complete)
}

/// Drops primes that the others make superfluous, long ones first.
fn irredundant(rows: &Bits, pool: &Pool, mut chosen: Vec<usize>) -> Vec<usize> {
    let literals = |at: &usize| pool.get(*at).map_or(0, Prime::literals);
    let mut longest_first = chosen.clone();
    longest_first.sort_by_key(|at| Reverse((literals(at), *at)));
    for at in longest_first {
        let others: Vec<usize> = chosen
            .iter()
            .copied()
            .filter(|other| *other != at)
            .collect();
        let mut left = rows.clone();
        pool.among(&others).for_each(|p| left.subtract(&p.covers));
        if left.is_empty() {
            chosen = others;
        }
    }
    chosen
}

/// The primes that no other makes superfluous by covering as much with as few literals.
fn undominated(primes: &[Prime]) -> Vec<usize> {
    let mut order: Vec<(usize, &Prime)> = primes.iter().enumerate().collect();
    order.sort_by_key(|(at, prime)| (prime.literals(), Reverse(prime.covers.count()), *at));
    let mut kept: Vec<(usize, &Prime)> = Vec::new();
    for (at, prime) in order {
        // Earlier ones are no longer.
        let mut earlier = kept.iter().map(|(_, earlier)| earlier);
        if !earlier.any(|earlier| prime.covers.is_subset(&earlier.covers)) {
            kept.push((at, prime));
        }
    }
    let mut kept: Vec<usize> = kept.into_iter().map(|(at, _)| at).collect();
    kept.sort_unstable();
    kept
}

struct BranchAndBound<'a> {
    pool: &'a Pool,
    /// The primes that cover each row, rows with few of them first.
    through: Vec<(usize, Vec<usize>)>,
    best: Vec<usize>,
    cost: Cost,
    budget: usize,
    complete: bool,
}

impl BranchAndBound<'_> {
    /// Completes the chosen primes, whose cost is `spent`, in every way that may be cheaper than the best.
    fn branch(&mut self, left: &Bits, chosen: &mut Vec<usize>, spent: Cost) {
        if left.is_empty() {
            if spent < self.cost {
                self.cost = spent;
                self.best.clone_from(chosen);
            }
            return;
        }
        if self.budget == 0 {
            self.complete = false;
            return;
        }
        self.budget -= 1;
        let bound = self.bound(left);
        if (spent.0 + bound.0, spent.1 + bound.1) >= self.cost {
            return;
        }
        let pool = self.pool;
        let hardest = self.through.iter().find(|(row, _)| left.contains(*row));
        let through = hardest.into_iter().flat_map(|(_, through)| through);
        let mut through: Vec<(usize, usize, &Prime)> = through
            .filter_map(|at| Some((*at, pool.get(*at)?)))
            .map(|(at, prime)| (prime.covers.count_both(left), at, prime))
            .collect();
        through.sort_by_key(|(gain, at, prime)| (Reverse(*gain), prime.literals(), *at));
        for (_, at, prime) in through {
            chosen.push(at);
            let spent = (spent.0 + 1, spent.1 + prime.literals());
            self.branch(&left.minus(&prime.covers), chosen, spent);
            chosen.pop();
        }
    }

    /// A lower bound of the cost of covering these rows: rows without a prime in common need one each.
    fn bound(&self, left: &Bits) -> Cost {
        let mut open = left.clone();
        let mut bound = (0, 0);
        for (row, through) in &self.through {
            if !open.contains(*row) {
                continue;
            }
            let mut shortest = usize::MAX;
            for prime in self.pool.among(through) {
                shortest = shortest.min(prime.literals());
                open.subtract(&prime.covers);
            }
            bound = (bound.0 + 1, bound.1 + shortest);
        }
        bound
    }
}
