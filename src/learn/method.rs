//! What every method of learning has in common.

use super::double_q::DoubleQ;
use super::model::Model;
use super::process::{End, Step};
use super::q_learning::QLearning;
use super::q_table::QTable;
use crate::ir::task;

/// A method of learning: it gets every decision, and keeps a table of action values.
///
/// Rows are those of [`Method::table`]: a method that keeps more tables than one numbers their rows alike.
pub trait Method {
    /// The action values so far, with their evidence.
    fn table(&self) -> &QTable;

    /// The row of a minterm, a new one if there is none.
    fn row(&mut self, key: super::process::Key) -> usize;

    /// The choice in a row while learning, exploration aside; `None` where nothing is known yet.
    fn greedy(&self, row: usize) -> Option<usize> {
        self.table().greedy(row)
    }

    /// An episode starts in a row.
    fn begin(&mut self, _row: usize) {}

    /// Learns from one decision.
    fn learn(&mut self, decision: &Decision);

    /// Ends a round of episodes: a method that only collects while it plays learns now.
    fn refit(&mut self) {}

    /// Whether the policy of each round is a proposal, of which the best by validation is taken. Otherwise the last
    /// policy is the result.
    fn proposes(&self) -> bool {
        false
    }

    /// All that was learned, for [`Method::restore`].
    fn state(&self) -> Vec<u8>;

    /// Takes over what another of its kind has learned; whether that could be read.
    fn restore(&mut self, state: &[u8]) -> bool;
}

/// A decision with its outcome.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decision {
    /// The row in which it was taken.
    pub row: usize,
    /// The choice.
    pub choice: usize,
    /// Its outcome.
    pub step: Step,
    /// The row of the minterm found after it.
    pub next: usize,
    /// The factor on what follows. Zero if nothing does: the episode was ended by an event, not cut by the limit.
    pub factor: f64,
    /// The share of the episodes that are over.
    pub progress: f64,
}

impl Decision {
    /// Whether the tick limit cut it before it was complete.
    pub fn is_cut(&self) -> bool {
        self.step.end == End::Cut
    }

    /// The factor on what follows a step: a cut episode would have gone on (truncation), one that an event ended
    /// would not (termination).
    pub fn factor(step: &Step, discounting: &super::discount::Discounting) -> f64 {
        match step.end {
            End::Terminal(_) => 0.0,
            End::Not | End::Limit | End::Cut => discounting.factor(step.ticks),
        }
    }
}

/// The settings of the methods; each reads those that it uses.
#[derive(Clone, Copy, Debug)]
pub struct Settings<'a> {
    /// The number of behaviours to choose from.
    pub choices: usize,
    /// The value of a pair that was never tried.
    pub initial: f64,
    /// The step size; `model` has none.
    pub rate: super::schedule::Schedule<'a>,
    /// Whether the average reward a tick is to be great, and not the discounted sum: [`task::Method::Model`] alone can do
    /// that.
    pub average: bool,
    /// The seed of a method's own random numbers.
    pub seed: u64,
}

/// The method of that kind.
pub fn of<'a>(kind: task::Method, settings: &Settings<'a>) -> Box<dyn Method + 'a> {
    match kind {
        task::Method::QLearning => Box::new(QLearning::new(settings)),
        task::Method::DoubleQ => Box::new(DoubleQ::new(settings)),
        task::Method::Model => Box::new(Model::new(settings)),
    }
}
