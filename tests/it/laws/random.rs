//! Where choices come from: numbers of a seed, or the bytes of an input.

use std::collections::VecDeque;

/// Choices, one after another.
pub(crate) enum Random {
    /// Marsaglia's xorshift, 64 bits.
    Seeded(u64),
    /// A byte for each choice; 0 when there are no more.
    Given(VecDeque<u8>),
}

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        let mut random = Self::Seeded(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        for _ in 0..8 {
            random.next();
        }
        random
    }

    pub(crate) fn given(bytes: &[u8]) -> Self {
        Self::Given(bytes.iter().copied().collect())
    }

    pub(crate) fn next(&mut self) -> u64 {
        match self {
            Self::Seeded(state) => {
                *state ^= *state << 13;
                *state ^= *state >> 7;
                *state ^= *state << 17;
                *state
            }
            Self::Given(bytes) => u64::from(bytes.pop_front().unwrap_or(0)) << 11,
        }
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.next() >> 11) as usize % n
    }

    pub(crate) fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }
}
