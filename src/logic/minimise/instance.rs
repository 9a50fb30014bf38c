//! What a cover has to hold on and what it may not meet, and the primes that are found for it.

use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::cube::{Cube, Literal};
use rustc_hash::FxHashMap;
use std::cmp::Reverse;

/// A problem of minimisation: the rows on which a cover holds, and those that it does not meet.
#[derive(Clone, Debug)]
pub(super) struct Instance {
    /// The rows that lie in the cover.
    pub(super) on: Columns,
    /// The rows that the cover does not meet.
    pub(super) off: Columns,
}

impl Instance {
    /// The problem over these rows of a table.
    pub(super) fn new(columns: &Columns, on: &[usize], off: &[usize]) -> Self {
        Self {
            on: columns.pick(on),
            off: columns.pick(off),
        }
    }

    /// The number of rows.
    pub(super) fn rows(&self) -> usize {
        self.on.rows() + self.off.rows()
    }

    /// The number of words in all columns: the work of reading the whole problem once.
    pub(super) fn words(&self) -> usize {
        (self.on.rows().div_ceil(64) + self.off.rows().div_ceil(64)) * self.on.atoms()
    }

    /// All ON rows.
    pub(super) fn all_on(&self) -> Bits {
        Bits::full(self.on.rows())
    }

    /// All OFF rows.
    pub(super) fn all_off(&self) -> Bits {
        Bits::full(self.off.rows())
    }

    /// The OFF rows that a literal excludes: those that it does not meet.
    pub(super) fn excluded(&self, literal: Literal) -> Bits {
        let mut rows = self.all_off();
        if let (Some(column), meets) = self.off.meeting(literal) {
            rows.keep(column, !meets);
        }
        rows
    }
}

/// A prime with the ON rows that lie in it.
#[derive(Clone, Debug)]
pub(super) struct Prime {
    /// The prime.
    pub(super) cube: Cube,
    /// The ON rows that lie in it.
    pub(super) covers: Bits,
}

impl Prime {
    /// The number of literals.
    pub(super) fn literals(&self) -> usize {
        self.cube.literals().len()
    }
}

/// Primes in the order in which they were found, each once.
#[derive(Clone, Debug, Default)]
pub(super) struct Pool {
    primes: Vec<Prime>,
    known: FxHashMap<Cube, usize>,
}

/// What covers are compared by: cubes, then literals.
pub(super) type Cost = (usize, usize);

impl Pool {
    /// Adds a prime that is not known yet, and gives its number.
    pub(super) fn add(&mut self, instance: &Instance, cube: Cube) -> usize {
        let next = self.primes.len();
        let at = *self.known.entry(cube.clone()).or_insert(next);
        if at == next {
            let covers = instance.on.cube_rows(&cube, &instance.all_on());
            self.primes.push(Prime { cube, covers });
        }
        at
    }

    /// The primes.
    pub(super) fn primes(&self) -> &[Prime] {
        &self.primes
    }

    /// The primes with these numbers.
    pub(super) fn among<'a>(&'a self, cover: &'a [usize]) -> impl Iterator<Item = &'a Prime> {
        cover.iter().filter_map(|at| self.primes.get(*at))
    }

    /// The prime with this number.
    pub(super) fn get(&self, at: usize) -> Option<&Prime> {
        self.primes.get(at)
    }

    /// The number of primes.
    pub(super) fn len(&self) -> usize {
        self.primes.len()
    }

    /// The cost of a cover of these primes.
    pub(super) fn cost(&self, cover: &[usize]) -> Cost {
        (cover.len(), self.among(cover).map(Prime::literals).sum())
    }

    /// The prime that covers most open rows, with their number; of several the shortest, then the first. `None` if none
    /// covers any.
    pub(super) fn widest(
        &self,
        among: impl Iterator<Item = usize>,
        open: &Bits,
    ) -> Option<(usize, usize)> {
        let gains = among.filter_map(|at| {
            let prime = self.primes.get(at)?;
            let gain = prime.covers.count_both(open);
            Some((gain, Reverse(prime.literals()), Reverse(at)))
        });
        let (gain, _, Reverse(at)) = gains.max()?;
        (gain > 0).then_some((at, gain))
    }

    /// A cover of these rows, greedily by the prime that covers most open ones.
    pub(super) fn greedy(&self, rows: &Bits) -> Vec<usize> {
        let mut open = rows.clone();
        let mut cover = Vec::new();
        while let Some((at, _)) = self.widest(0..self.len(), &open) {
            if let Some(prime) = self.primes.get(at) {
                open.subtract(&prime.covers);
            }
            cover.push(at);
        }
        cover
    }
}
