//! Values of a policy by sweeps over the states, each from the newest values of the others.

use super::{Outlook, Problem, largest, rest};

/// The most sweeps, and the change below which they end.
pub(super) const SWEEPS: usize = 20_000;
const SETTLED: f64 = 1e-12;

/// How often directions are begun anew: while values are rough, and at most.
const ROUGHLY: usize = 2;
const EXACTLY: usize = 120;

/// What rounding may change in a sweep, in parts of the greatest value.
const ROUNDING: f64 = 1e-14;

/// The same where the values are near, in parts of the greatest value.
const NEAR_SWEEPS: usize = 300;
const NEAR: f64 = 1e-5;

/// Where a state leads back to itself more surely than this, its stays are not summed up: without a discount the sum has no end.
const STAYS: f64 = 1.0 - 1e-9;

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
        let worth = |_, outlook: &Outlook, values: &[f64]| self.worth(outlook, values);
        for _ in 0..most {
            if self.sweep_once(&taken, &mut values, unknown, worth) < settled {
                break;
            }
        }
        values
    }

    /// One sweep by the worth of the choice that is taken in a state under the values so far; the greatest change.
    fn sweep_once(
        &self,
        taken: impl Fn(usize) -> Option<usize>,
        values: &mut [f64],
        unknown: f64,
        worth: impl Fn(usize, &Outlook, &[f64]) -> f64,
    ) -> f64 {
        let mut change: f64 = 0.0;
        for state in 0..self.states.len() {
            let outlook = self.outlook(state, taken(state));
            let worth = outlook.map_or(unknown, |outlook| worth(state, outlook, values));
            if let Some(value) = values.get_mut(state) {
                change = change.max((worth - *value).abs());
                *value = worth;
            }
        }
        change
    }

    /// Values by sweeps until nothing changes, or less than this part of the greatest value.
    pub(super) fn settle(
        &self,
        taken: impl Fn(usize) -> Option<usize>,
        values: Vec<f64>,
        settled: f64,
    ) -> Vec<f64> {
        // What a choice is worth that is taken again whenever it leads back to its own state.
        let worth = |state: usize, outlook: &Outlook, (reward, unknown), values: &[f64]| {
            let leaves = reward + outlook.leaves(state, values, unknown);
            let back = outlook.back(state);
            match back < STAYS {
                true => leaves / (1.0 - back),
                false => leaves + back * values.get(state).copied().unwrap_or(unknown),
            }
        };
        let sweep = |values: &mut [f64]| {
            self.sweep_once(&taken, values, self.unknown, |state, outlook, values| {
                worth(state, outlook, (outlook.reward, self.unknown), values)
            });
        };
        let change = |change: &mut [f64]| {
            self.sweep_once(&taken, change, 0.0, |state, outlook, values| {
                worth(state, outlook, (0.0, 0.0), values)
            });
        };
        let least = |values: &[f64]| SETTLED.max(settled.max(ROUNDING) * largest(values));
        let times = if settled > 0.0 { ROUGHLY } else { EXACTLY };
        rest::found(values, sweep, change, least, times)
    }
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
    fn sweeps_come_to_rest_where_elimination_does() {
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
