//! The values of a policy as it meets the world: those of the decisions of its own roll-outs.
//!
//! A learner's values are averages over all that it met, and it meets minterms otherwise than its policy does: it
//! starts elsewhere, and at times it does what the policy would not do. Both put the robot elsewhere within a minterm.

use super::average::gain;
use super::process::Key;
use super::rollout::RollOut;
use super::solve::{Outlook, Problem};
use rustc_hash::FxHashMap;

/// What a policy is worth by the frequencies of its roll-outs.
#[derive(Clone, Debug)]
pub struct OnPolicy {
    problem: Problem,
    states: FxHashMap<Key, usize>,
    starts: Vec<(usize, f64)>,
    values: Vec<f64>,
}

impl OnPolicy {
    /// The values by these roll-outs; `unknown` for a minterm in which no decision was completed.
    pub fn of(met: &RollOut, unknown: f64) -> Self {
        let mut states = FxHashMap::default();
        let mut state = |key: Key| {
            let next = states.len();
            *states.entry(key).or_insert(next)
        };
        let mut counts: Vec<f64> = Vec::new();
        let mut outlooks: Vec<Outlook> = Vec::new();
        for (&(from, to), outcome) in &met.outcomes {
            let (from, to) = (state(from), to.map(&mut state));
            let rows = 1 + from.max(to.unwrap_or(0));
            counts.resize(counts.len().max(rows), 0.0);
            outlooks.resize(outlooks.len().max(rows), Outlook::default());
            if let (Some(count), Some(outlook)) = (counts.get_mut(from), outlooks.get_mut(from)) {
                *count += outcome.count as f64;
                outlook.reward += outcome.reward;
                outlook.ticks += outcome.ticks as f64;
                outlook.next.extend(to.map(|to| (to, outcome.factor)));
            }
        }
        let starts = met.starts.iter();
        let starts = starts.map(|(key, n)| (state(*key), *n as f64)).collect();
        let known = |(outlook, count): (Outlook, &f64)| match *count > 0.0 {
            true => vec![(0, outlook.over(*count))],
            false => Vec::new(),
        };
        let mut problem = Problem {
            states: outlooks.into_iter().zip(&counts).map(known).collect(),
            unknown,
        };
        problem.states.resize(states.len(), Vec::new());
        let values = problem.evaluate(&problem.first());
        Self {
            problem,
            states,
            starts,
            values,
        }
    }

    /// The value of a minterm.
    pub fn value(&self, key: Key) -> f64 {
        let value = self.states.get(&key).and_then(|at| self.values.get(*at));
        value.copied().unwrap_or(self.problem.unknown)
    }

    /// The average reward a tick.
    pub fn gain(&self) -> f64 {
        gain(&self.problem, &self.problem.first(), &self.starts)
    }
}
