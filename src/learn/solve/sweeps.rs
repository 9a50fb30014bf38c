//! Values of a policy by sweeps over the states, each from the newest values of the others.

use super::{Problem, largest};
use nalgebra::{DMatrix, DVector};

/// The most sweeps, and the change below which they end.
pub(super) const SWEEPS: usize = 20_000;
const SETTLED: f64 = 1e-12;

/// How many sweeps there are between two steps ahead, and what part of the last change may be left after one.
const AHEAD: usize = 10;
const WORTHWHILE: f64 = 0.9;

/// What rounding may change in a sweep, in parts of the greatest value.
const ROUNDING: f64 = 1e-14;

/// The same where the values are near, in parts of the greatest value.
const NEAR_SWEEPS: usize = 300;
const NEAR: f64 = 1e-5;

impl Problem {
    /// About the value of every state under a policy, by a few sweeps from values that are near, where states without a choice
    /// are worth `unknown`.
    pub fn evaluate_near(
        &self,
        policy: &[Option<usize>],
        values: Vec<f64>,
        unknown: f64,
    ) -> Vec<f64> {
        let near = NEAR * largest(&values);
        let taken = |state| policy.get(state).copied().flatten();
        self.sweep(taken, values, unknown, (NEAR_SWEEPS, near))
    }

    /// Values by sweeps as they are, at most [`SWEEPS`] of them.
    pub(super) fn sweep_all(
        &self,
        taken: impl Fn(usize) -> Option<usize>,
        values: Vec<f64>,
    ) -> Vec<f64> {
        self.sweep(taken, values, self.unknown, (SWEEPS, SETTLED))
    }

    /// Values by sweeps in place (Gauss and Seidel) under a policy, from these values: at most so many, until the greatest
    /// change is small.
    fn sweep(
        &self,
        taken: impl Fn(usize) -> Option<usize>,
        mut values: Vec<f64>,
        unknown: f64,
        (most, settled): (usize, f64),
    ) -> Vec<f64> {
        for _ in 0..most {
            if self.sweep_once(&taken, &mut values, unknown) < settled {
                break;
            }
        }
        values
    }

    /// One sweep; the greatest change.
    fn sweep_once(
        &self,
        taken: impl Fn(usize) -> Option<usize>,
        values: &mut [f64],
        unknown: f64,
    ) -> f64 {
        let mut change: f64 = 0.0;
        for state in 0..self.states.len() {
            let outlook = self.outlook(state, taken(state));
            let worth = outlook.map_or(unknown, |outlook| self.worth(outlook, values));
            if let Some(value) = values.get_mut(state) {
                change = change.max((worth - *value).abs());
                *value = worth;
            }
        }
        change
    }

    /// Values by sweeps until nothing changes, or less than this part of the greatest value. Where little is discounted, what is left to change shrinks by a small part in
    /// each sweep; so after every few sweeps comes a step ahead, to where their changes would cancel best (reduced rank
    /// extrapolation, Eddy 1979). A step that leads nowhere better is taken back.
    pub(super) fn settle(
        &self,
        taken: impl Fn(usize) -> Option<usize>,
        mut values: Vec<f64>,
        settled: f64,
    ) -> Vec<f64> {
        let mut before = (f64::INFINITY, values.clone());
        for _ in 0..SWEEPS / AHEAD {
            let mut seen = vec![values.clone()];
            let mut change = f64::INFINITY;
            for at in 0..AHEAD {
                change = self.sweep_once(&taken, &mut values, self.unknown);
                if at == 0 && change > WORTHWHILE * before.0 {
                    values = before.1.clone();
                    seen = vec![values.clone()];
                    change = self.sweep_once(&taken, &mut values, self.unknown);
                }
                seen.push(values.clone());
            }
            if change < SETTLED.max(settled.max(ROUNDING) * largest(&values)) {
                break;
            }
            before = (change, values.clone());
            if let Some(ahead) = ahead(&seen) {
                values = ahead;
            }
        }
        values
    }
}

/// From values one sweep after another, v₀ to vₖ, those where the sweeps would come to rest if all changes shrank as these
/// have: v₀ + Σ ξᵢ uᵢ over the changes uᵢ = vᵢ₊₁ − vᵢ, with ξ such that u₀ + Σ ξᵢ (uᵢ₊₁ − uᵢ) is least.
fn ahead(seen: &[Vec<f64>]) -> Option<Vec<f64>> {
    let rows = seen.iter().map(|values| DVector::from_column_slice(values));
    let values: Vec<DVector<f64>> = rows.collect();
    let between = |from: &[DVector<f64>]| -> Vec<DVector<f64>> {
        let pairs = from.iter().zip(from.iter().skip(1));
        pairs.map(|(one, next)| next - one).collect()
    };
    let changes = between(&values);
    let bends = DMatrix::from_columns(&between(&changes));
    let first = changes.first()?;
    let gram = bends.tr_mul(&bends);
    let right = -bends.tr_mul(first);
    let largest = gram.diagonal().max();
    let parts = gram.svd(true, true).solve(&right, 1e-14 * largest).ok()?;
    let steps = changes.iter().zip(parts.iter());
    let rest = steps.fold(values.first()?.clone(), |sum, (change, part)| {
        sum + change * *part
    });
    let finite = rest.iter().all(|value| value.is_finite());
    finite.then(|| rest.iter().copied().collect())
}

#[cfg(test)]
mod tests {
    use super::super::{Outlook, Problem, largest};

    /// States on a ring, each of which leads on, stays or leaps; little is lost on the way.
    fn ring(kept: f64) -> Problem {
        const STATES: usize = 90;
        let state = |at: usize| {
            let next = [(at + 1, 0.6), (at, 0.3), (7 * at + 3, 0.1)];
            Outlook {
                reward: (at % 7) as f64 - 2.0,
                ticks: 1.0,
                next: next
                    .iter()
                    .map(|&(to, part)| (to % STATES, part * kept))
                    .collect(),
            }
        };
        Problem {
            states: (0..STATES).map(|at| vec![(0, state(at))]).collect(),
            unknown: 0.0,
        }
    }

    #[test]
    fn sweeps_with_steps_ahead_agree_with_elimination() {
        for kept in [0.5, 0.99, 0.9999] {
            let problem = ring(kept);
            let policy = problem.first();
            let exact = problem.eliminate(&policy).unwrap();
            let taken = |state: usize| policy.get(state).copied().flatten();
            let settled = problem.settle(taken, vec![0.0; exact.len()], 0.0);
            let largest = largest(&exact);
            for (settled, exact) in settled.iter().zip(&exact) {
                let apart = (settled - exact).abs() / largest;
                assert!(apart < 1e-7, "{kept}: {settled} for {exact}");
            }
        }
    }

    #[test]
    fn a_sum_without_an_end_grows_and_is_no_hang() {
        let problem = ring(1.0);
        let policy = problem.first();
        let taken = |state: usize| policy.get(state).copied().flatten();
        let settled = problem.settle(taken, vec![0.0; 90], 0.0);
        assert!(settled.iter().all(|value| value.is_finite()));
    }
}
