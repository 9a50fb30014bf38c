//! Two-level minimisation from an ON set and an OFF set.
//!
//! A problem takes these steps:
//!
//! 1. `split`: ON cubes become their minterms where these are few, since several primes may cover one cube together. Where
//!    there are more, smaller parts of the cubes are tried beside them.
//! 2. `core`: a large table is minimised by a sample of its rows, which grows by the rows that the cover gets wrong.
//! 3. `instance`: the rows of the sample, ON and OFF apart, and the pool of the primes that are found for them.
//! 4. `exact`, for small problems: all primes, and the cheapest choice among them.
//! 5. `expand` and `improve`, for all others: a cover of some primes, parts of which are found anew.

pub(super) mod core;
mod exact;
mod expand;
mod improve;
mod instance;
mod split;

use super::account::Account;
use super::bits::Bits;
use super::columns::Columns;
use super::cube::{Cover, Cube};
use core::Core;
use instance::Instance;

/// The work that a minimisation may take. It is counted, never timed, so that every machine finds the same cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Rows of the largest problem for which all primes are sought.
    pub exact_rows: usize,
    /// Steps of the search for all primes.
    pub prime_steps: usize,
    /// Steps of the search for the cheapest choice among them.
    pub cover_steps: usize,
    /// The product of rows and primes that this search may read.
    pub cover_work: usize,
    /// Seeds of EXPAND that are tried at a time.
    pub seeds: usize,
    /// Changes to a cover, for each of its cubes, that are tried without success before it is taken.
    pub rounds: usize,
    /// Words of rows that these changes may read.
    pub work: usize,
}

impl Default for Effort {
    fn default() -> Self {
        Self {
            exact_rows: 160,
            prime_steps: 8_000,
            cover_steps: 4_000,
            cover_work: 2_000_000,
            seeds: 4,
            rounds: 8,
            work: 1 << 28,
        }
    }
}

impl Effort {
    /// Just enough to compare costs.
    #[must_use]
    pub(super) fn quick(&self) -> Self {
        Self { rounds: 0, ..*self }
    }
}

/// A cover.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Solution {
    /// The cover.
    pub cover: Cover,
    /// Whether it is proved that no other cover has fewer cubes, or as many and fewer literals.
    pub proved: bool,
}

/// A cover that contains every row of `on` and meets no row of `off`, of primes, none of which can be left out.
///
/// `on` and `off` are disjoint, and no row of one meets a row of the other.
pub fn minimise(columns: &Columns, on: &Bits, off: &Bits) -> Cover {
    minimise_with(columns, on, off, &Effort::default()).cover
}

/// As [`minimise`], with an effort, and whether the cover is proved to be smallest.
pub fn minimise_with(columns: &Columns, on: &Bits, off: &Bits, effort: &Effort) -> Solution {
    let found = minimise_within(columns, on, off, effort, &Account::unlimited());
    found.unwrap_or_else(|| Solution {
        cover: Cover::new(on.iter().map(|row| Cube::new(columns.literals_of(row)))),
        proved: false,
    })
}

/// As [`minimise_with`]; `None` if the account is spent before there is a cover.
pub fn minimise_within(
    columns: &Columns,
    on: &Bits,
    off: &Bits,
    effort: &Effort,
    account: &Account,
) -> Option<Solution> {
    match split::split(columns, on, off) {
        Some((columns, on, off)) => by_core(&columns, &on, &off, effort, account),
        None => {
            let whole = by_core(columns, on, off, effort, account)?;
            Some(by_parts(columns, on, off, whole, effort, account))
        }
    }
}

/// The solution, or that of the same problem with finer ON rows if its cover costs less: there several primes may cover an
/// ON cube together.
fn by_parts(
    columns: &Columns,
    on: &Bits,
    off: &Bits,
    whole: Solution,
    effort: &Effort,
    account: &Account,
) -> Solution {
    let cost = |solution: &Solution| (solution.cover.cubes().len(), solution.cover.literals());
    if whole.proved || effort.rounds == 0 || account.is_spent() {
        return whole;
    }
    let finer = split::finer(columns, on, off, &whole.cover);
    let finer = finer.and_then(|(columns, on, off)| {
        account.spend((columns.atoms() * columns.rows()) as u64);
        by_core(&columns, &on, &off, effort, account)
    });
    match finer {
        Some(finer) if finer.proved || cost(&finer) < cost(&whole) => finer,
        _ => whole,
    }
}

fn by_core(
    columns: &Columns,
    on: &Bits,
    off: &Bits,
    effort: &Effort,
    account: &Account,
) -> Option<Solution> {
    let quick = effort.quick();
    let mut core = Core::new(columns, on, off, &quick);
    while !core.refine(account)? {}
    core.finish(effort, account)
}

/// A cover of an instance as a whole; `None` if the account is spent.
fn solve(instance: &Instance, effort: &Effort, account: &Account) -> Option<Solution> {
    let trivial = |cover| {
        Some(Solution {
            cover,
            proved: true,
        })
    };
    if instance.on.rows() == 0 {
        return trivial(Cover::default());
    }
    if instance.off.rows() == 0 {
        return trivial(Cover::new([Cube::default()]));
    }
    if account.is_spent() {
        return None;
    }
    let (pool, chosen, proved) = match exact::exact(instance, effort, account) {
        Some(found) => found,
        None => {
            let (pool, chosen) = improve::heuristic(instance, effort, account)?;
            (pool, chosen, false)
        }
    };
    let primes = pool.among(&chosen);
    Some(Solution {
        cover: Cover::new(primes.map(|prime| prime.cube.clone())),
        proved,
    })
}
