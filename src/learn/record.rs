//! What was met in training, beside what was learned from it.

use super::process::{End, Step};
use crate::ir::tree::Status;
use serde::{Deserialize, Serialize};

/// What was met in training.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// For each choice, the decisions for it.
    pub tried: Vec<Tried>,
    /// How often each event happened.
    pub events: Vec<u64>,
    /// How many episodes each line of `end on` ended.
    pub ended: Vec<u64>,
    /// Ticks simulated.
    pub ticks: u64,
    /// Whether any transition had a reward that is not zero.
    pub rewarded: bool,
}

/// The decisions for a choice.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tried {
    /// How many there were.
    pub count: u64,
    /// How many of them ended with a success.
    pub succeeded: u64,
    /// How many of them ended with a failure.
    pub failed: u64,
}

impl Record {
    /// Notes a decision.
    pub(super) fn decision(&mut self, choice: usize, step: &Step) {
        if let Some(tried) = at(&mut self.tried, choice) {
            tried.count += 1;
            tried.succeeded += u64::from(step.status == Status::Success);
            tried.failed += u64::from(step.status == Status::Failure);
        }
        self.ticks += step.ticks;
        self.rewarded |= step.reward != 0.0;
        if let End::Terminal(line) = step.end
            && let Some(count) = at(&mut self.ended, line)
        {
            *count += 1;
        }
    }

    /// Notes the events of an episode that is over.
    pub(super) fn episode(&mut self, events: &[u64]) {
        for (event, count) in events.iter().enumerate() {
            if let Some(all) = at(&mut self.events, event) {
                *all += count;
            }
        }
    }
}

/// The entry at a place, which is made if there is none.
fn at<T: Clone + Default>(list: &mut Vec<T>, place: usize) -> Option<&mut T> {
    if list.len() <= place {
        list.resize(place + 1, T::default());
    }
    list.get_mut(place)
}
