//! Bounds on a probability, from counts.

/// The upper end of the 95 % Clopper–Pearson interval (one-sided, 1934) of a probability, after `count` hits in `n`
/// trials: the p at which so few hits have a probability of 5 %.
pub fn upper95(count: u64, n: u64) -> f64 {
    if count >= n {
        return 1.0;
    }
    let (mut low, mut high) = (count as f64 / n as f64, 1.0);
    for _ in 0..60 {
        let p = (low + high) / 2.0;
        if at_most(count, n, p) > 0.05 {
            low = p;
        } else {
            high = p;
        }
    }
    high
}

/// The lower end of the same interval.
pub fn lower95(count: u64, n: u64) -> f64 {
    1.0 - upper95(n.saturating_sub(count), n)
}

/// P(X ≤ count) of a binomial X of n trials with probability p.
fn at_most(count: u64, n: u64, p: f64) -> f64 {
    if p >= 1.0 {
        return 0.0;
    }
    let (ln_p, ln_q) = (crate::math::ln(p), crate::math::ln(1.0 - p));
    // ln of C(n, k) grows by ln((n − k) / (k + 1)) from one k to the next.
    let mut ln_choose = 0.0;
    let mut sum = 0.0;
    for k in 0..=count {
        let (k, n) = (k as f64, n as f64);
        sum += crate::math::exp(ln_choose + k * ln_p + (n - k) * ln_q);
        ln_choose += crate::math::ln((n - k) / (k + 1.0));
    }
    sum
}
