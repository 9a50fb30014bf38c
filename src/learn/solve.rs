//! Finite semi-Markov decision problems, solved exactly (Howard 1960; Puterman 1994, chapters 6 and 11).

mod elimination;
mod rest;
mod sweeps;

use elimination::solved;
use serde::{Deserialize, Serialize};
use sweeps::SWEEPS;

/// What a choice is expected to bring.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outlook {
    /// The expected reward.
    pub reward: f64,
    /// The expected ticks.
    pub ticks: f64,
    /// The states that may follow, each with its probability times the expected discount on the way to it. A part that
    /// is missing from the sum of a probability distribution is the end, or discounted away.
    pub next: Vec<(usize, f64)>,
}

impl Outlook {
    /// The part that leads back to a state.
    fn back(&self, state: usize) -> f64 {
        let back = self.next.iter().filter(|(to, _)| *to == state);
        back.map(|(_, weight)| weight).sum()
    }

    /// What follows where it leads away from a state is worth.
    fn leaves(&self, state: usize, values: &[f64], unknown: f64) -> f64 {
        let away = self.next.iter().filter(|(to, _)| *to != state);
        let value = |to: usize| values.get(to).copied().unwrap_or(unknown);
        away.map(|&(to, weight)| weight * value(to)).sum()
    }

    /// The means of these sums over `count` decisions.
    pub fn over(&self, count: f64) -> Self {
        let next = self.next.iter();
        Self {
            reward: self.reward / count,
            ticks: self.ticks / count,
            next: next.map(|&(to, factors)| (to, factors / count)).collect(),
        }
    }
}

/// A problem: for each state, the choices that are known there, by their numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Problem {
    /// The choices of each state. A state without any has the value `unknown`.
    pub states: Vec<Vec<(usize, Outlook)>>,
    /// The value of a state without choices.
    pub unknown: f64,
}

/// A policy that no single other choice improves, with its value in each state.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The place in its state's list of the choice that is taken; `None` where there is none.
    pub policy: Vec<Option<usize>>,
    /// The values.
    pub values: Vec<f64>,
}

/// The most states for which a policy is evaluated by elimination, whose cost is cubic; above, by sweeps.
const ELIMINATED: usize = 600;

/// The most improvements of a policy; far fewer are ever needed.
const IMPROVEMENTS: usize = 200;

/// The most of them by rough values.
const ROUGH_ONES: usize = 100;

/// The least gain that counts as better, above the noise of the elimination.
const BETTER: f64 = 1e-9;

/// While many states have a policy that still gets better: the change below which sweeps end, and the least gain that counts, in
/// parts of the greatest value.
const ROUGH: f64 = 1e-7;
const ROUGHLY_BETTER: f64 = 1e-5;

/// What may be left to come of the expected meetings of all states.
const LEFT: f64 = 1e-3;

impl Problem {
    /// What a choice is worth under the values of the states that follow it.
    pub fn worth(&self, outlook: &Outlook, values: &[f64]) -> f64 {
        let value = |state: usize| values.get(state).copied().unwrap_or(self.unknown);
        let next = outlook.next.iter();
        outlook.reward + next.map(|&(to, weight)| weight * value(to)).sum::<f64>()
    }

    /// What a choice is worth that is taken again whenever it leads back to its own state, under the values of the others.
    pub fn lasting(&self, state: usize, outlook: &Outlook, values: &[f64]) -> f64 {
        let leaves = outlook.reward + outlook.leaves(state, values, self.unknown);
        leaves / (1.0 - outlook.back(state)).max(1e-6)
    }

    /// A low value among those of states with choices: one in ten is lower. For states of which nothing is known.
    pub fn low(&self, values: &[f64]) -> f64 {
        let known = self.states.iter().zip(values);
        let known = known.filter(|(choices, _)| !choices.is_empty());
        let mut known: Vec<f64> = known.map(|(_, value)| *value).collect();
        known.sort_by(f64::total_cmp);
        known.get(known.len() / 10).copied().unwrap_or(0.0)
    }

    /// The policy that takes the first choice of every state.
    pub fn first(&self) -> Vec<Option<usize>> {
        let choices = self.states.iter();
        choices
            .map(|choices| (!choices.is_empty()).then_some(0))
            .collect()
    }

    /// The same problem where each tick costs so much.
    pub fn at_cost(&self, cost: f64) -> Self {
        self.with(self.unknown, |o| o.reward - cost * o.ticks)
    }

    /// The same problem with ticks for its rewards, and no ticks in states without choices.
    pub fn of_ticks(&self) -> Self {
        self.with(0.0, |o| o.ticks)
    }

    fn with(&self, unknown: f64, reward: impl Fn(&Outlook) -> f64) -> Self {
        let mut problem = self.clone();
        problem.unknown = unknown;
        for (_, outlook) in problem.states.iter_mut().flatten() {
            outlook.reward = reward(outlook);
        }
        problem
    }

    /// Whether there are so many states that policies are evaluated by sweeps.
    pub fn is_large(&self) -> bool {
        self.states.len() > ELIMINATED
    }

    /// About the ticks that could be simulated while the problem is solved: one for two transitions that sweeps go over. None where
    /// there are few states.
    pub fn work(&self) -> u64 {
        if !self.is_large() {
            return 0;
        }
        let outlooks = self.states.iter().flatten();
        let transitions = outlooks.map(|(_, outlook)| outlook.next.len() as u64);
        transitions.sum::<u64>() / 2
    }

    /// Policy iteration: evaluates exactly, takes what is better, until nothing is.
    pub fn solve(&self) -> Solution {
        self.solve_from(self.unsolved())
    }

    /// The policy that takes the first choice of every state, with no values yet.
    pub fn unsolved(&self) -> Solution {
        Solution {
            policy: self.first(),
            values: vec![self.unknown; self.states.len()],
        }
    }

    /// The same from a solution that may be near. Where states are few it is sought from nothing, which costs little: then it does
    /// not hang on what was solved before which of two equal choices is taken.
    pub fn solve_near(&self, near: Solution) -> Solution {
        match self.is_large() {
            true => self.solve_from(near),
            false => self.solve(),
        }
    }

    /// The same from the solution of a problem with the same states and choices.
    pub fn solve_from(&self, near: Solution) -> Solution {
        self.solve_until(near, 0.0)
    }

    /// The same for a problem of counts, whose chance is greater than the roughness of values: where there are many states, until
    /// nothing seems better by rough values.
    pub fn estimate_from(&self, near: Solution) -> Solution {
        self.solve_until(near, ROUGH)
    }

    /// Policy iteration by values that are rough up to this part of the greatest at last, where there are many states.
    fn solve_until(&self, near: Solution, finest: f64) -> Solution {
        let Solution { mut policy, values } = near;
        // Where states are many, values are rough until nothing seems better by them.
        let (mut rough, finest) = match self.is_large() {
            true => (ROUGH, finest),
            false => (0.0, 0.0),
        };
        let mut values = self.evaluate_from(&policy, values, rough);
        for at in 0..IMPROVEMENTS {
            // Sweeps leave a part of the greatest value, elimination next to nothing.
            let better = match self.is_large() {
                true if rough > 0.0 => ROUGHLY_BETTER * largest(&values),
                true => BETTER * largest(&values).max(1.0),
                false => BETTER,
            };
            let improved = self.improve(&mut policy, &values, better);
            if !improved && rough == finest {
                break;
            }
            if !improved || at >= ROUGH_ONES {
                rough = finest;
            }
            values = self.evaluate_from(&policy, values, rough);
        }
        Solution { policy, values }
    }

    /// Takes the best choice wherever it is better by so much than the one that is taken; whether there was any.
    fn improve(&self, policy: &mut [Option<usize>], values: &[f64], better: f64) -> bool {
        let mut improved = false;
        for (choices, taken) in self.states.iter().zip(policy) {
            let Some(now) = taken else { continue };
            let worth = |at: usize| {
                let found = choices.get(at);
                found.map_or(f64::NEG_INFINITY, |(_, o)| self.worth(o, values))
            };
            let mut best = worth(*now) + better;
            for at in 0..choices.len() {
                if worth(at) > best {
                    (best, *now) = (worth(at) + better, at);
                    improved = true;
                }
            }
        }
        improved
    }

    /// The value of every state under a policy, v = r + P v: by elimination, or by sweeps where there are too many
    /// states for it or the equations have no single solution, as without a discount and without an end.
    pub fn evaluate(&self, policy: &[Option<usize>]) -> Vec<f64> {
        self.evaluate_from(policy, vec![self.unknown; self.states.len()], 0.0)
    }

    /// The same for a problem of counts: roughly, where there are many states.
    pub fn estimate(&self, policy: &[Option<usize>]) -> Vec<f64> {
        self.evaluate_from(policy, vec![self.unknown; self.states.len()], ROUGH)
    }

    /// The same, where sweeps are needed from values that may be near, until changes are below this part of the greatest value.
    fn evaluate_from(&self, policy: &[Option<usize>], values: Vec<f64>, settled: f64) -> Vec<f64> {
        let taken = |state| policy.get(state).copied().flatten();
        if self.is_large() {
            return self.settle(taken, values, settled);
        }
        self.eliminate(policy)
            .unwrap_or_else(|| self.sweep_all(taken, vec![self.unknown; self.states.len()]))
    }

    /// The outlook of a policy in a state.
    fn outlook(&self, state: usize, taken: Option<usize>) -> Option<&Outlook> {
        let (_, outlook) = self.states.get(state)?.get(taken?)?;
        Some(outlook)
    }

    /// (I − P) v = r, by elimination.
    fn eliminate(&self, policy: &[Option<usize>]) -> Option<Vec<f64>> {
        let count = self.states.len();
        let equation = |state: usize| {
            let mut equation = vec![0.0; count + 1];
            *equation.get_mut(state)? = 1.0;
            let taken = policy.get(state).copied().flatten();
            let Some(outlook) = self.outlook(state, taken) else {
                *equation.last_mut()? = self.unknown;
                return Some(equation);
            };
            for &(to, weight) in &outlook.next {
                *equation.get_mut(..count)?.get_mut(to)? -= weight;
            }
            *equation.last_mut()? = outlook.reward;
            Some(equation)
        };
        let equations = (0..count).map(equation);
        let values = solved(equations.collect::<Option<_>>()?)?;
        let finite = values.iter().all(|value| value.is_finite());
        finite.then_some(values)
    }

    /// How often each state is met under a policy that begins in these, discounted: u = d + Pᵀ u.
    pub fn occupancy(&self, policy: &[Option<usize>], from: &[f64]) -> Vec<f64> {
        let mut met = from.to_vec();
        let mut due = from.to_vec();
        for _ in 0..SWEEPS {
            let mut next = vec![0.0; due.len()];
            for (state, (weight, taken)) in due.iter().zip(policy).enumerate() {
                let outlook = self.outlook(state, *taken).filter(|_| *weight > 0.0);
                for (to, factor) in outlook.iter().flat_map(|outlook| &outlook.next) {
                    if let Some(next) = next.get_mut(*to) {
                        *next += weight * factor;
                    }
                }
            }
            met.iter_mut()
                .zip(&next)
                .for_each(|(met, next)| *met += next);
            due = next;
            if due.iter().sum::<f64>() < LEFT {
                break;
            }
        }
        met
    }

    /// The part of a policy's next state that is the state itself.
    pub fn stays(&self, state: usize, policy: &[Option<usize>]) -> f64 {
        let taken = policy.get(state).copied().flatten();
        self.outlook(state, taken)
            .map_or(0.0, |outlook| outlook.back(state))
    }
}

/// The greatest of these values, whatever its sign.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}

#[cfg(test)]
mod tests {
    use super::{LEFT, Outlook, Problem};
    use proptest::prelude::*;

    /// The most of a state's value that is left of what follows it.
    const KEPT: f64 = 0.9;

    /// Problems of up to six states with one choice or two, and a policy in each.
    fn problems() -> impl Strategy<Value = (Problem, Vec<Option<usize>>)> {
        let choice = (
            -1.0..1.0_f64,
            prop::collection::vec((0_usize..6, 0.01..1.0_f64), 0..4),
            0.0..KEPT,
        );
        let choices = prop::collection::vec(choice, 1..3);
        let states = prop::collection::vec((choices, 0_usize..2), 1..7);
        states.prop_map(|states| {
            let count = states.len();
            let (mut problem, mut policy) = (Problem::default(), Vec::new());
            for (choices, taken) in states {
                policy.push(Some(taken % choices.len()));
                let choices = choices.into_iter().map(|(reward, next, kept)| {
                    let all: f64 = next.iter().map(|(_, weight)| weight).sum();
                    let next = next
                        .iter()
                        .map(|(to, weight)| (to % count, weight / all * kept));
                    Outlook {
                        reward,
                        ticks: 1.0,
                        next: next.collect(),
                    }
                });
                problem.states.push(choices.enumerate().collect());
            }
            (problem, policy)
        })
    }

    proptest! {
        /// What is worth d · v is paid where the policy goes: u · r.
        #[test]
        fn what_is_worth_is_paid_on_the_way((problem, policy) in problems(), begin in 0_usize..6) {
            let mut from = vec![0.0; problem.states.len()];
            from[begin % problem.states.len()] = 1.0;
            let values = problem.evaluate(&policy);
            let worth: f64 = from.iter().zip(&values).map(|(part, value)| part * value).sum();
            let met = problem.occupancy(&policy, &from);
            let paid = met.iter().enumerate().map(|(state, met)| {
                met * problem.outlook(state, policy[state]).unwrap().reward
            });
            let paid: f64 = paid.sum();
            prop_assert!((worth - paid).abs() <= LEFT / (1.0 - KEPT), "{worth} {paid}");
        }

        /// Sweeps from the values of another policy come to those of elimination.
        #[test]
        fn sweeps_from_near_values_agree_with_elimination((problem, policy) in problems()) {
            let from = problem.evaluate(&problem.first());
            let values = problem.evaluate(&policy);
            for (near, exact) in problem.evaluate_near(&policy, from, 0.0).iter().zip(&values) {
                prop_assert!((near - exact).abs() < 1e-3, "{near} {exact}");
            }
        }
    }
}
