//! Values of a policy by sweeps over the states, each from the newest values of the others.

use super::{Problem, largest, rest};

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

/// A state under a policy.
#[derive(Clone, Copy, Debug)]
struct State {
    /// The expected reward.
    reward: f64,
    /// The part that leads back to the state, where it is kept by itself.
    back: f64,
    /// Where the states that follow end in the lists of all; they begin where those of the state before end.
    end: usize,
}

/// What follows what under one policy, in the order in which sweeps read it.
#[derive(Debug)]
struct Chain {
    /// `None` where nothing is chosen.
    states: Vec<Option<State>>,
    next: Vec<u32>,
    weights: Vec<f64>,
}

/// What a sweep brings up to date.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Swept {
    /// Values, where states without a choice are worth so much.
    Values(f64),
    /// A change of the values: the same without rewards.
    Change,
}

impl Chain {
    /// A problem under a policy. Where `summed`, a choice that leads back to its own state is taken there again.
    fn new(problem: &Problem, taken: impl Fn(usize) -> Option<usize>, summed: bool) -> Self {
        let mut chain = Self {
            states: Vec::with_capacity(problem.states.len()),
            next: Vec::new(),
            weights: Vec::new(),
        };
        for state in 0..problem.states.len() {
            let Some(outlook) = problem.outlook(state, taken(state)) else {
                chain.states.push(None);
                continue;
            };
            let mut back = 0.0;
            for &(to, weight) in &outlook.next {
                if summed && to == state {
                    back += weight;
                    continue;
                }
                chain.next.push(u32::try_from(to).unwrap_or(u32::MAX));
                chain.weights.push(weight);
            }
            chain.states.push(Some(State {
                reward: outlook.reward,
                back,
                end: chain.next.len(),
            }));
        }
        chain
    }

    /// One sweep over all states; the greatest change.
    fn sweep(&self, values: &mut [f64], swept: Swept) -> f64 {
        let mut change: f64 = 0.0;
        let mut begin = 0;
        let unknown = match swept {
            Swept::Values(unknown) => unknown,
            Swept::Change => 0.0,
        };
        for (at, state) in self.states.iter().enumerate() {
            let Some(state) = state else {
                if let Some(value) = values.get_mut(at) {
                    change = change.max((unknown - *value).abs());
                    *value = unknown;
                }
                continue;
            };
            let value = |to: usize| values.get(to).copied().unwrap_or(unknown);
            let follow = begin..state.end;
            begin = state.end;
            let next = self.next.get(follow.clone()).unwrap_or_default().iter();
            let weights = self.weights.get(follow).unwrap_or_default().iter();
            let follow = next
                .zip(weights)
                .map(|(to, weight)| weight * value(*to as usize));
            let reward = match swept {
                Swept::Values(_) => state.reward,
                Swept::Change => 0.0,
            };
            let leaves = reward + follow.sum::<f64>();
            let worth = match state.back < STAYS {
                true => leaves / (1.0 - state.back),
                false => leaves + state.back * value(at),
            };
            if let Some(value) = values.get_mut(at) {
                change = change.max((worth - *value).abs());
                *value = worth;
            }
        }
        change
    }

    /// Values by sweeps from these: at most so many, until the greatest change is small.
    fn sweeps(
        &self,
        mut values: Vec<f64>,
        unknown: f64,
        (most, settled): (usize, f64),
    ) -> Vec<f64> {
        for _ in 0..most {
            if self.sweep(&mut values, Swept::Values(unknown)) < settled {
                break;
            }
        }
        values
    }
}

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
        let chain = Chain::new(self, taken, self.is_large());
        chain.sweeps(values, unknown, (NEAR_SWEEPS, near))
    }

    /// Values by sweeps as they are, at most [`SWEEPS`] of them.
    pub(super) fn sweep_all(
        &self,
        taken: impl Fn(usize) -> Option<usize>,
        values: Vec<f64>,
    ) -> Vec<f64> {
        let chain = Chain::new(self, taken, false);
        chain.sweeps(values, self.unknown, (SWEEPS, SETTLED))
    }

    /// Values by sweeps until nothing changes, or less than this part of the greatest value.
    pub(super) fn settle(
        &self,
        taken: impl Fn(usize) -> Option<usize>,
        values: Vec<f64>,
        settled: f64,
    ) -> Vec<f64> {
        let chain = Chain::new(self, taken, true);
        let sweep = |values: &mut [f64]| {
            chain.sweep(values, Swept::Values(self.unknown));
        };
        let change = |change: &mut [f64]| {
            chain.sweep(change, Swept::Change);
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
