//! Two-level minimisation from an ON set and an OFF set.

use super::bits::Bits;
use super::columns::Columns;
use super::core::Core;
use super::cube::Cover;
use super::split::split;

/// How much work a minimisation may take. It is counted, never timed, so that every machine finds the same cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Rows up to which all primes are sought, and steps of that search.
    pub exact_rows: usize,
    /// Steps of the search for all primes.
    pub prime_steps: usize,
    /// Steps of the search for the cheapest cover, and rows times primes that they may go through.
    pub cover_steps: usize,
    /// Rows times primes that the search for the cheapest cover may go through.
    pub cover_work: usize,
    /// Covers that are built from the left, and seeds of EXPAND at a time.
    pub sweeps: usize,
    /// Seeds of EXPAND that are tried at a time.
    pub seeds: usize,
    /// Changes that are tried on a cover, for each of its cubes, before it is left as it is.
    pub rounds: usize,
    /// Words of rows that these changes may go through.
    pub work: usize,
}

impl Default for Effort {
    fn default() -> Self {
        Self {
            exact_rows: 160,
            prime_steps: 8_000,
            cover_steps: 4_000,
            cover_work: 2_000_000,
            sweeps: 1,
            seeds: 4,
            rounds: 8,
            work: 1 << 28,
        }
    }
}

impl Effort {
    /// Just enough to tell cheap from dear.
    #[must_use]
    pub(super) fn quick(&self) -> Self {
        Self {
            sweeps: 1,
            rounds: 0,
            ..*self
        }
    }
}

/// A cover with what is known of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Solution {
    /// The cover.
    pub cover: Cover,
    /// Whether no other cover has fewer cubes, nor as many with fewer literals.
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
    match split(columns, on, off) {
        Some((columns, on, off)) => by_core(&columns, &on, &off, effort),
        None => by_core(columns, on, off, effort),
    }
}

fn by_core(columns: &Columns, on: &Bits, off: &Bits, effort: &Effort) -> Solution {
    let quick = effort.quick();
    let mut core = Core::new(columns, on, off, &quick);
    while !core.refine() {}
    core.finish(effort)
}
