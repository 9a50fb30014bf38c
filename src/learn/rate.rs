//! How often something happens in a tick: a ratio of two sums over episodes.

use super::poisson::interval95;
use super::statistics::{Mean, Z};
use serde::{Deserialize, Serialize};

/// Counts below this are too few for the normal approximation alone.
const FEW: u64 = 20;

/// The rate of an event, pooled over the ticks of all episodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rate {
    /// How often the event happened.
    pub count: u64,
    /// The mean number in 1000 ticks: 1000 Σ counts / Σ ticks.
    pub per_1000: f64,
    /// Its 95 % interval, never below zero.
    pub ci95: [f64; 2],
}

impl Rate {
    /// The rate over episodes, each given by its count and its ticks.
    ///
    /// The interval is that of the [`ratio`] over episodes. It takes into account that events come in clusters, but a normal
    /// approximation knows little of rare events: with fewer than 20 in all, or in a single episode, the exact interval of
    /// a Poisson count is joined to it.
    pub fn of(episodes: impl Iterator<Item = (u64, u64)> + Clone) -> Self {
        let sum = |of: fn((u64, u64)) -> u64| episodes.clone().map(of).sum::<u64>();
        let (n, count, ticks) = (sum(|_| 1), sum(|(count, _)| count), sum(|(_, t)| t).max(1));
        let pairs = episodes.map(|(count, ticks)| (count as f64, ticks as f64));
        let Mean {
            mean: rate,
            mut ci95,
        } = ratio(pairs);
        if count < FEW || n < 2 {
            let [low, high] = interval95(count).map(|count| count / ticks as f64);
            ci95 = [ci95[0].min(low), ci95[1].max(high)];
        }
        Self {
            count,
            per_1000: 1000.0 * rate,
            ci95: ci95.map(|end| 1000.0 * end.max(0.0)),
        }
    }
}

/// The ratio of two sums over episodes, Σ a / Σ b, zero where Σ b is, with its 95 % interval (the ratio estimator: Cochran
/// 1977, chapter 6): r ± 1.96 s, where s² is the sum of (aᵢ − r bᵢ)² over the n episodes, times n / (n − 1) / (Σ b)².
pub fn ratio(pairs: impl Iterator<Item = (f64, f64)> + Clone) -> Mean {
    let add = |(a, b, n): (f64, f64, f64), pair: (f64, f64)| (a + pair.0, b + pair.1, n + 1.0);
    let (a, b, n) = pairs.clone().fold((0.0, 0.0, 0.0), add);
    if b <= 0.0 {
        return Mean::default();
    }
    let mean = a / b;
    let residual = |(a, b): (f64, f64)| a - mean * b;
    let squares: f64 = pairs.map(|pair| residual(pair) * residual(pair)).sum();
    let half = match n > 1.0 {
        true => Z * (squares * n / (n - 1.0)).sqrt() / b,
        false => 0.0,
    };
    Mean {
        mean,
        ci95: [mean - half, mean + half],
    }
}
