//! A pool of primes to choose a cover from.

use super::bits::Bits;
use super::cube::Cube;
use super::instance::Instance;
use rustc_hash::FxHashMap;

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

impl Pool {
    /// Takes a prime in, and says where it stands.
    pub(super) fn add(&mut self, instance: &Instance, cube: Cube) -> usize {
        let next = self.primes.len();
        let at = *self.known.entry(cube.clone()).or_insert(next);
        if at == next {
            let covers = instance.covered(&cube);
            self.primes.push(Prime { cube, covers });
        }
        at
    }

    /// The primes.
    pub(super) fn primes(&self) -> &[Prime] {
        &self.primes
    }

    /// The prime that stands there.
    pub(super) fn get(&self, at: usize) -> Option<&Prime> {
        self.primes.get(at)
    }

    /// How many there are.
    pub(super) fn len(&self) -> usize {
        self.primes.len()
    }
}
