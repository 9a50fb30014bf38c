//! Bounds on a probability that hold after every trial at once, so that one may stop as soon as they say enough.
//!
//! ```text
//! evidence against p after k hits in n trials = ∏ (k + ½) / (n + 1) over hits, … over misses  /  p^k (1 − p)^(n − k)
//! ```
//!
//! The numerator bets on each trial by the ones before it (Krichevsky and Trofimov 1981). Where p is the truth this ratio is
//! a martingale that starts at 1, and reaches 20 with a probability of at most 5 %, however long one goes on (Ville 1939;
//! Robbins 1970). What it has not reached 20 against is the interval.

use crate::math::ln;

/// The evidence that excludes a probability, for 95 %.
const EXCLUDED: f64 = 20.0;

/// Trials so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Anytime {
    hits: u64,
    trials: u64,
    ln_bets: f64,
}

impl Anytime {
    /// Takes note of a trial.
    pub fn add(&mut self, hit: bool) {
        let alike = match hit {
            true => self.hits,
            false => self.trials - self.hits,
        };
        self.ln_bets += ln((alike as f64 + 0.5) / (self.trials as f64 + 1.0));
        self.hits += u64::from(hit);
        self.trials += 1;
    }

    /// How many of the trials were hits.
    pub fn hits(&self) -> u64 {
        self.hits
    }

    /// How many trials there were.
    pub fn trials(&self) -> u64 {
        self.trials
    }

    /// Whether the trials have excluded, now or before if one stopped there, that this is the probability of a hit.
    pub fn excludes(&self, p: f64) -> bool {
        let part = |count: u64, p: f64| match count {
            0 => 0.0,
            count => count as f64 * ln(p),
        };
        let likely = part(self.hits, p) + part(self.trials - self.hits, 1.0 - p);
        self.ln_bets - likely >= ln(EXCLUDED)
    }

    /// Whether the probability of a hit is above this, at 95 %.
    pub fn is_above(&self, p: f64) -> bool {
        self.hits as f64 > p * self.trials as f64 && self.excludes(p)
    }

    /// Whether the probability of a hit is below this, at 95 %.
    pub fn is_below(&self, p: f64) -> bool {
        (self.hits as f64) < p * self.trials as f64 && self.excludes(p)
    }

    /// All probabilities that are not excluded, at 95 %.
    pub fn interval95(&self) -> [f64; 2] {
        let mean = self.hits as f64 / self.trials.max(1) as f64;
        let edge = |mut inside: f64, mut outside: f64| {
            if !self.excludes(outside) {
                return outside;
            }
            for _ in 0..60 {
                let p = (inside + outside) / 2.0;
                match self.excludes(p) {
                    true => outside = p,
                    false => inside = p,
                }
            }
            outside
        };
        [edge(mean, 0.0), edge(mean, 1.0)]
    }
}
