//! The exact interval of a Poisson count.

use crate::math::{exp, ln};

/// The 95 % interval of the mean of a Poisson variable that was seen to be `count` (Garwood 1936): at its lower end so
/// great a count has a probability of 2.5 %, at its upper end so small a one.
pub fn interval95(count: u64) -> [f64; 2] {
    let low = match count.checked_sub(1) {
        None => 0.0,
        Some(below) => mean(below, 0.975),
    };
    [low, mean(count, 0.025)]
}

/// The mean at which a Poisson variable is at most `count` with this probability.
fn mean(count: u64, probability: f64) -> f64 {
    let (mut low, mut high) = (0.0, count as f64 + 10.0 * (count as f64 + 1.0).sqrt());
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if at_most(count, middle) > probability {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// P(X ≤ count) of a Poisson variable X.
fn at_most(count: u64, mean: f64) -> f64 {
    if mean <= 0.0 {
        return 1.0;
    }
    // ln of meanᵏ / k! grows by ln(mean / (k + 1)) from one k to the next.
    let (mut ln_term, mut sum) = (-mean, 0.0);
    for k in 0..=count {
        sum += exp(ln_term);
        ln_term += ln(mean / (k as f64 + 1.0));
    }
    sum
}
