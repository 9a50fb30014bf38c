//! Learning a model: the transitions that were seen are counted, and the semi-Markov decision problem of their
//! frequencies is solved exactly (certainty equivalence: Kumar and Varaiya 1986).
//!
//! A minterm stands for many states of the world, so what follows it depends on the way there. Counts are therefore
//! collected under the policy of the round before, with exploration, and older ones fade: the model describes the process
//! as the policy meets it.

use super::average;
use super::method::{Decision, Method, Settings};
use super::process::Key;
use super::q_table::{Admission, QTable};
use super::solve::{Outlook, Problem, Solution};
use crate::checkpoint::{decode, encode};
use serde::{Deserialize, Serialize};

/// The transitions seen of one choice in one minterm; the counts are real because they fade.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Seen {
    count: f64,
    /// The sums of rewards, of ticks, and of the factors on what follows, by the row that was found.
    sums: Outlook,
}

impl Seen {
    fn fade(&mut self) {
        self.count *= FADE;
        self.sums = self.sums.over(1.0 / FADE);
    }
}

/// A model with its solution.
#[derive(Clone, Debug)]
pub struct Model {
    table: QTable,
    choices: usize,
    initial: f64,
    /// For each row and choice.
    seen: Vec<Seen>,
    /// The decision of the last solution in each row.
    policy: Vec<Option<usize>>,
    /// Whether the average reward is to be great, and not the discounted sum.
    average: bool,
    /// The rows in which episodes started, with their counts.
    starts: Vec<(usize, f64)>,
}

/// What remains of a count from one round to the next. Large delivery, explored by 100 % -> 20 %: with 1, policies
/// settle early on what the first rounds happened to meet; with 0.5, they no longer settle.
const FADE: f64 = 0.9;

impl Model {
    /// One that knows nothing yet.
    pub fn new(settings: &Settings) -> Self {
        Self {
            table: QTable::new(settings.choices, settings.initial),
            choices: settings.choices,
            initial: settings.initial,
            seen: Vec::new(),
            policy: Vec::new(),
            average: settings.average,
            starts: Vec::new(),
        }
    }

    /// The problem of the frequencies that were seen.
    fn problem(&self) -> Problem {
        let known = |row: &[Seen]| {
            let choices = row.iter().enumerate();
            choices
                .filter(|(_, seen)| seen.count > 0.0)
                .map(|(choice, seen)| (choice, seen.sums.over(seen.count)))
                .collect()
        };
        Problem {
            states: self.seen.chunks(self.choices.max(1)).map(known).collect(),
            unknown: self.initial,
        }
    }

    /// The solution of the round before, as one of this problem.
    fn before(&self, problem: &Problem) -> Solution {
        let mut solution = problem.unsolved();
        let rows = problem.states.iter().zip(&mut solution.policy).enumerate();
        for (row, (choices, taken)) in rows {
            let before = self.policy.get(row).copied().flatten();
            let place = choices
                .iter()
                .position(|(choice, _)| Some(*choice) == before);
            *taken = place.or(*taken);
        }
        let values = solution.values.iter_mut().enumerate();
        values.for_each(|(row, value)| *value = self.table.best_value(row));
        solution
    }
}

impl Method for Model {
    fn table(&self) -> &QTable {
        &self.table
    }

    fn row(&mut self, key: Key) -> usize {
        let row = self.table.row(key);
        let rows = self.seen.len().max((row + 1) * self.choices);
        self.seen.resize(rows, Seen::default());
        row
    }

    /// Greedy in the last solution. What was met since then is explored.
    fn greedy(&self, row: usize) -> Option<usize> {
        self.policy.get(row).copied().flatten()
    }

    fn begin(&mut self, row: usize) {
        match self.starts.iter_mut().find(|(known, _)| *known == row) {
            Some((_, count)) => *count += 1.0,
            None => self.starts.push((row, 1.0)),
        }
    }

    fn learn(&mut self, decision: &Decision) {
        let Decision {
            row, choice, step, ..
        } = *decision;
        let admission = self.table.admits(row, choice, decision.is_cut());
        if admission == Admission::Refused {
            return;
        }
        let cost = self.table.gain * step.ticks as f64;
        let follows = decision.factor * self.table.best_value(decision.next);
        let target = step.reward - cost + follows;
        if let Some(cell) = self.table.cell_mut(row, choice) {
            cell.visits += 1;
            cell.squares += target * target;
        }
        if let Some(seen) = self.seen.get_mut(row * self.choices + choice) {
            if admission == Admission::Anew {
                *seen = Seen::default();
            }
            seen.count += 1.0;
            seen.sums.reward += step.reward;
            seen.sums.ticks += step.ticks as f64;
            let next = &mut seen.sums.next;
            match next.iter_mut().find(|(to, _)| *to == decision.next) {
                Some((_, factors)) => *factors += decision.factor,
                None => next.push((decision.next, decision.factor)),
            }
        }
    }

    fn refit(&mut self) {
        let mut problem = self.problem();
        let before = self.before(&problem);
        let solution = if self.average {
            let (gain, solution) = average::solve(&problem, &self.starts, before);
            self.table.gain = gain;
            problem = problem.at_cost(gain);
            solution
        } else {
            problem.solve_near(before)
        };
        for (row, choices) in problem.states.iter().enumerate() {
            for (choice, outlook) in choices {
                if let Some(cell) = self.table.cell_mut(row, *choice) {
                    cell.q = problem.worth(outlook, &solution.values);
                }
            }
        }
        let rows = 0..problem.states.len();
        self.policy = rows.map(|row| self.table.greedy(row)).collect();
        self.seen.iter_mut().for_each(Seen::fade);
        for (_, count) in &mut self.starts {
            *count *= FADE;
        }
    }

    fn proposes(&self) -> bool {
        true
    }

    fn state(&self) -> Vec<u8> {
        encode(&(&self.table, &self.seen, &self.policy, &self.starts)).unwrap_or_default()
    }

    fn restore(&mut self, state: &[u8]) -> bool {
        let found =
            decode(state).map(|state| (self.table, self.seen, self.policy, self.starts) = state);
        found.is_some()
    }
}
