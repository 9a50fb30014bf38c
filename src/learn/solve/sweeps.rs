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

/// A state in which something is chosen.
#[derive(Clone, Copy, Debug)]
struct State {
    /// Its number in the problem.
    at: usize,
    /// The expected reward, with what follows in states without a choice.
    reward: f64,
    /// The part that leads back to the state, where it is kept by itself.
    back: f64,
    /// Where the states that follow end in the lists of all; they begin where those of the state before end.
    end: usize,
}

/// What follows what under one policy, in the order in which sweeps read it. States without a choice have no part in it.
#[derive(Debug)]
struct Chain {
    states: Vec<State>,
    /// The states that follow, by their places in `states`.
    next: Vec<u32>,
    weights: Vec<f64>,
}

/// What a sweep brings up to date.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Swept {
    /// Values.
    Values,
    /// A change of the values: the same without rewards.
    Change,
}

impl Chain {
    /// A problem under a policy, where states without a choice are worth `unknown`. Where `summed`, a choice that leads back to
    /// its own state is taken there again.
    fn new(
        problem: &Problem,
        taken: impl Fn(usize) -> Option<usize>,
        unknown: f64,
        summed: bool,
    ) -> Self {
        let outlook = |state: usize| problem.outlook(state, taken(state));
        let order = last_first(problem.states.len(), outlook);
        let mut places = vec![None; problem.states.len()];
        for (place, (state, _)) in (0..).zip(&order) {
            if let Some(own) = places.get_mut(*state) {
                *own = Some(place);
            }
        }
        let mut chain = Self {
            states: Vec::with_capacity(order.len()),
            next: Vec::new(),
            weights: Vec::new(),
        };
        for (at, outlook) in order {
            let (mut back, mut reward) = (0.0, outlook.reward);
            for &(to, weight) in &outlook.next {
                match places.get(to).copied().flatten() {
                    _ if summed && to == at => back += weight,
                    Some(place) => {
                        chain.next.push(place);
                        chain.weights.push(weight);
                    }
                    None => reward += weight * unknown,
                }
            }
            let end = chain.next.len();
            chain.states.push(State {
                at,
                reward,
                back,
                end,
            });
        }
        chain
    }

    /// Those of all values that belong to its states.
    fn own(&self, all: &[f64]) -> Vec<f64> {
        let own = self.states.iter();
        own.map(|state| all.get(state.at).copied().unwrap_or(0.0))
            .collect()
    }

    /// The values of all states, where those without a choice are worth `unknown`.
    fn all(&self, own: &[f64], count: usize, unknown: f64) -> Vec<f64> {
        let mut all = vec![unknown; count];
        for (state, own) in self.states.iter().zip(own) {
            if let Some(value) = all.get_mut(state.at) {
                *value = *own;
            }
        }
        all
    }

    /// One sweep over its states; the greatest change.
    fn sweep(&self, values: &mut [f64], swept: Swept) -> f64 {
        let mut change: f64 = 0.0;
        let mut begin = 0;
        for (place, state) in self.states.iter().enumerate() {
            let value = |to: usize| values.get(to).copied().unwrap_or(0.0);
            let follow = begin..state.end;
            begin = state.end;
            let next = self.next.get(follow.clone()).unwrap_or_default().iter();
            let weights = self.weights.get(follow).unwrap_or_default().iter();
            let follow = next
                .zip(weights)
                .map(|(to, weight)| weight * value(*to as usize));
            let reward = match swept {
                Swept::Values => state.reward,
                Swept::Change => 0.0,
            };
            let leaves = reward + follow.sum::<f64>();
            let worth = match state.back < STAYS {
                true => leaves / (1.0 - state.back),
                false => leaves + state.back * value(place),
            };
            if let Some(value) = values.get_mut(place) {
                change = change.max((worth - *value).abs());
                *value = worth;
            }
        }
        change
    }

    /// Values by sweeps from these: at most so many, until the greatest change is small.
    fn sweeps(&self, mut values: Vec<f64>, (most, settled): (usize, f64)) -> Vec<f64> {
        for _ in 0..most {
            if self.sweep(&mut values, Swept::Values) < settled {
                break;
            }
        }
        values
    }
}

/// The states in which something is chosen, with what is to be expected there, each behind those that follow it as far as there
/// are no circles: then a sweep brings what is at the end of a way to its beginning at once.
fn last_first<'p>(
    count: usize,
    outlook: impl Fn(usize) -> Option<&'p Outlook>,
) -> Vec<(usize, &'p Outlook)> {
    let mut order = Vec::new();
    let mut met = vec![false; count];
    let mut enter = |state: usize| {
        let is_new = met
            .get_mut(state)
            .is_some_and(|met| !std::mem::replace(met, true));
        let outlook = is_new.then(|| outlook(state)).flatten()?;
        Some((state, outlook, outlook.next.iter()))
    };
    for first in 0..count {
        let mut way = Vec::from_iter(enter(first));
        while let Some((state, outlook, next)) = way.last_mut() {
            match next.next() {
                Some((to, _)) => way.extend(enter(*to)),
                None => {
                    order.push((*state, *outlook));
                    way.pop();
                }
            }
        }
    }
    order
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
        let chain = Chain::new(self, taken, unknown, self.is_large());
        let own = chain.sweeps(chain.own(&values), (NEAR_SWEEPS, near));
        chain.all(&own, values.len(), unknown)
    }

    /// Values by sweeps as they are, at most [`SWEEPS`] of them.
    pub(super) fn sweep_all(
        &self,
        taken: impl Fn(usize) -> Option<usize>,
        values: Vec<f64>,
    ) -> Vec<f64> {
        let chain = Chain::new(self, taken, self.unknown, false);
        let own = chain.sweeps(chain.own(&values), (SWEEPS, SETTLED));
        chain.all(&own, values.len(), self.unknown)
    }

    /// Values by sweeps until nothing changes, or less than this part of the greatest value.
    pub(super) fn settle(
        &self,
        taken: impl Fn(usize) -> Option<usize>,
        values: Vec<f64>,
        settled: f64,
    ) -> Vec<f64> {
        let chain = Chain::new(self, taken, self.unknown, true);
        let sweep = |values: &mut [f64]| {
            chain.sweep(values, Swept::Values);
        };
        let change = |change: &mut [f64]| {
            chain.sweep(change, Swept::Change);
        };
        let least = |values: &[f64]| SETTLED.max(settled.max(ROUNDING) * largest(values));
        let times = if settled > 0.0 { ROUGHLY } else { EXACTLY };
        let own = rest::found(chain.own(&values), sweep, change, least, times);
        chain.all(&own, values.len(), self.unknown)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Outlook, Problem, largest};
    use super::Chain;

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

    /// A way from the first state to the last, and one into it from behind: one sweep knows all values.
    #[test]
    fn one_sweep_goes_a_whole_way() {
        const STATES: usize = 700;
        let state = |at: usize| {
            let next = match at {
                0 => vec![(STATES - 1, 1.0)],
                _ if at == STATES / 2 => Vec::new(),
                _ if at < STATES / 2 => vec![(at + 1, 1.0)],
                _ => vec![(at - 1, 1.0)],
            };
            Outlook {
                reward: 1.0,
                ticks: 1.0,
                next,
            }
        };
        let problem = Problem {
            states: (0..STATES).map(|at| vec![(0, state(at))]).collect(),
            unknown: 0.0,
        };
        let policy = problem.first();
        let taken = |state: usize| policy.get(state).copied().flatten();
        let chain = Chain::new(&problem, taken, 0.0, true);
        let own = chain.sweeps(vec![0.0; STATES], (1, 0.0));
        let values = chain.all(&own, STATES, 0.0);
        assert_eq!(values, problem.evaluate(&policy));
        assert_eq!(values[1], (STATES / 2) as f64);
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
