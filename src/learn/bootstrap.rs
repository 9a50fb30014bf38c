//! The figures of a few runs: the interquartile mean with a bootstrap interval (Agarwal, Schwarzer, Castro, Courville and
//! Bellemare 2021).

use crate::random::Random;

/// The mean of the middle half of a sample: a quarter of its weight is cut off at either end, values on the border
/// counting in part. Zero without a sample.
pub fn interquartile_mean(sample: &[f64]) -> f64 {
    let mut sorted = sample.to_vec();
    sorted.sort_by(f64::total_cmp);
    middle(&sorted)
}

fn middle(sorted: &[f64]) -> f64 {
    let n = sorted.len() as f64;
    if sorted.is_empty() {
        return 0.0;
    }
    let (from, to) = (n / 4.0, 3.0 * n / 4.0);
    let weighted = sorted.iter().enumerate().map(|(i, value)| {
        let (low, high) = (i as f64, i as f64 + 1.0);
        value * (high.min(to) - low.max(from)).max(0.0)
    });
    weighted.sum::<f64>() / (to - from)
}

/// The number of resamples.
const DRAWS: u64 = 2000;

/// The stream of the bootstrap's random numbers.
const BOOTSTRAP: u64 = u64::MAX - 2;

/// The 95 % interval of the interquartile mean by the percentile bootstrap (Efron 1979): the same sample gives the same
/// interval. The interval of a single value is that value.
pub fn interval95(sample: &[f64]) -> [f64; 2] {
    let n = sample.len();
    let mut random = Random::new(n as u64, BOOTSTRAP, 0);
    let mut drawn = vec![0.0; n];
    let mut means: Vec<f64> = (0..DRAWS)
        .map(|_| {
            for value in &mut drawn {
                let at = random.below(n as u64) as usize;
                *value = sample.get(at).copied().unwrap_or_default();
            }
            drawn.sort_by(f64::total_cmp);
            middle(&drawn)
        })
        .collect();
    means.sort_by(f64::total_cmp);
    [0.025, 0.975].map(|share| quantile(&means, share))
}

/// The quantile of sorted values, between neighbours in proportion.
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    let place = share * sorted.len().saturating_sub(1) as f64;
    let at = |i: f64| sorted.get(i as usize).copied().unwrap_or_default();
    let (low, high) = (at(place.floor()), at(place.ceil()));
    low + (high - low) * (place - place.floor())
}
