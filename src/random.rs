//! The random numbers of an episode.

mod ziggurat;
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use serde::{Deserialize, Serialize};
use ziggurat::Ziggurat;

/// A generator (xoshiro256++, Blackman and Vigna 2021) that is a function of a seed, a stream and an episode alone.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Random {
    bits: Bits,
    #[serde(skip, default = "Ziggurat::get")]
    ziggurat: &'static Ziggurat,
}

/// The source of random bits.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Bits(Xoshiro256PlusPlus);

impl Bits {
    #[inline]
    pub(super) fn word(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// Uniform in [0, 1).
    #[inline]
    pub(super) fn unit(&mut self) -> f64 {
        fraction(self.word())
    }
}

/// The upper 53 bits of a word as a number in [0, 1).
#[inline]
pub(super) fn fraction(word: u64) -> f64 {
    (word >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
}

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014): every bit of the input moves every bit of the output.
fn mix(word: u64) -> u64 {
    let word = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let word = (word ^ (word >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let word = (word ^ (word >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    word ^ (word >> 31)
}

impl Random {
    /// The generator of one episode: `mix(mix(mix(seed) ^ stream) ^ episode)` seeds it.
    pub fn new(seed: u64, stream: u64, episode: u64) -> Self {
        let word = mix(mix(mix(seed) ^ stream) ^ episode);
        Self {
            bits: Bits(Xoshiro256PlusPlus::seed_from_u64(word)),
            ziggurat: Ziggurat::get(),
        }
    }

    /// 64 random bits.
    #[inline]
    pub fn word(&mut self) -> u64 {
        self.bits.word()
    }

    /// Uniform in [0, 1), a multiple of 2⁻⁵³.
    #[inline]
    pub fn unit(&mut self) -> f64 {
        self.bits.unit()
    }

    /// Uniform in [a, b).
    #[inline]
    pub fn uniform(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.unit()
    }

    /// True with probability `p`.
    #[inline]
    pub fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }

    /// One of 0 … n − 1; 0 if n is 0. The bias is below n / 2⁶⁴.
    #[inline]
    pub fn below(&mut self, n: u64) -> u64 {
        ((u128::from(self.word()) * u128::from(n)) >> 64) as u64
    }

    /// Standard Gaussian, by the ziggurat (Marsaglia and Tsang 2000; in the form of Doornik 2005).
    #[inline]
    pub fn gaussian(&mut self) -> f64 {
        self.ziggurat.draw(&mut self.bits)
    }
}
