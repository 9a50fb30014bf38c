//! Tabular Q-learning (Watkins 1989; paper, section II-B) over options.

use super::method::{Decision, Method, Settings};
use super::process::Key;
use super::q_table::{Admission, QTable};
use super::schedule::Schedule;
use crate::checkpoint::{decode, encode};

/// Q(s, a) ← Q(s, a) + α [r + γ max Q(s′, ·) − Q(s, a)]
#[derive(Clone, Debug)]
pub struct QLearning<'a> {
    table: QTable,
    rate: Schedule<'a>,
}

impl<'a> QLearning<'a> {
    /// One that knows nothing yet.
    pub fn new(settings: &Settings<'a>) -> Self {
        Self {
            table: QTable::new(settings.choices, settings.initial),
            rate: settings.rate,
        }
    }
}

impl Method for QLearning<'_> {
    fn table(&self) -> &QTable {
        &self.table
    }

    fn row(&mut self, key: Key) -> usize {
        self.table.row(key)
    }

    fn learn(&mut self, decision: &Decision) {
        let Decision { row, choice, .. } = *decision;
        if self.table.admits(row, choice, decision.is_cut()) == Admission::Refused {
            return;
        }
        let target = decision.step.reward + decision.factor * self.table.best_value(decision.next);
        if let Some(cell) = self.table.cell_mut(row, choice) {
            cell.visits += 1;
            let rate = self.rate.at(cell.visits as f64, decision.progress);
            cell.q += rate * (target - cell.q);
            cell.squares += target * target;
        }
    }

    fn state(&self) -> Vec<u8> {
        encode(&self.table).unwrap_or_default()
    }

    fn restore(&mut self, state: &[u8]) -> bool {
        decode(state).map(|table| self.table = table).is_some()
    }
}
