//! Double Q-learning (van Hasselt 2010): of two tables, one says which choice is best and the other what it is worth,
//! so that noise is not taken for value.

use super::method::{Decision, Method, Settings};
use super::process::Key;
use super::q_table::{Admission, QTable};
use super::schedule::Schedule;
use crate::checkpoint::{decode, encode};
use crate::random::Random;

/// Q_A(s, a) ← Q_A(s, a) + α [r + γ Q_B(s′, argmax Q_A(s′, ·)) − Q_A(s, a)], or with A and B exchanged, by the toss of a
/// coin. Choices are greedy in the mean of both.
#[derive(Clone, Debug)]
pub struct DoubleQ<'a> {
    tables: [QTable; 2],
    mean: QTable,
    rate: Schedule<'a>,
    coin: Random,
}

/// The stream of the coin, apart from those of the world and of the exploration.
const COIN: u64 = u64::MAX - 1;

impl<'a> DoubleQ<'a> {
    /// One that knows nothing yet.
    pub fn new(settings: &Settings<'a>) -> Self {
        let table = QTable::new(settings.choices, settings.initial);
        Self {
            tables: [table.clone(), table.clone()],
            mean: table,
            rate: settings.rate,
            coin: Random::new(settings.seed, COIN, 0),
        }
    }
}

impl Method for DoubleQ<'_> {
    fn table(&self) -> &QTable {
        &self.mean
    }

    fn row(&mut self, key: Key) -> usize {
        for table in &mut self.tables {
            table.row(key);
        }
        self.mean.row(key)
    }

    fn learn(&mut self, decision: &Decision) {
        let Decision { row, choice, .. } = *decision;
        let [a, b] = &mut self.tables;
        match self.mean.admits(row, choice, decision.is_cut()) {
            Admission::Refused => return,
            Admission::Granted => {}
            Admission::Anew => {
                a.forget(row, choice);
                b.forget(row, choice);
            }
        }
        let (learns, judges) = if self.coin.chance(0.5) {
            (a, b)
        } else {
            (b, a)
        };
        let best = learns.best(decision.next);
        let value = judges.cells(decision.next).get(best).map_or(0.0, |c| c.q);
        let target = decision.step.reward + decision.factor * value;
        let Some(cell) = learns.cell_mut(row, choice) else {
            return;
        };
        cell.visits += 1;
        cell.q += self.rate.at(cell.visits as f64, decision.progress) * (target - cell.q);
        let other = judges.cells(row).get(choice).filter(|c| c.visits > 0);
        let q = other.map_or(cell.q, |other| (cell.q + other.q) / 2.0);
        if let Some(mean) = self.mean.cell_mut(row, choice) {
            mean.visits += 1;
            mean.q = q;
            mean.squares += target * target;
        }
    }

    fn state(&self) -> Vec<u8> {
        encode(&(&self.tables, &self.mean, &self.coin)).unwrap_or_default()
    }

    fn restore(&mut self, state: &[u8]) -> bool {
        let found = decode(state).map(|state| (self.tables, self.mean, self.coin) = state);
        found.is_some()
    }
}
