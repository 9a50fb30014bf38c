//! The frozen greedy policy at work: where its episodes start, and what its decisions lead to.

use super::process::{End, Key, Process};
use crate::ir::tree::Status;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A decision with its outcome: minterm, choice, how the behaviour stood, the minterm found if the episode went on.
pub type Taken = (Key, usize, Status, Option<Key>);

/// What the greedy policy met, with how often.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct RollOut {
    /// The minterms in which episodes started.
    pub starts: BTreeMap<Key, u64>,
    /// The decisions. One that the tick limit cut short is not among them: nothing is known of its outcome.
    pub taken: BTreeMap<Taken, u64>,
}

impl RollOut {
    fn merge(mut self, other: Self) -> Self {
        for (key, count) in other.starts {
            *self.starts.entry(key).or_default() += count;
        }
        for (taken, count) in other.taken {
            *self.taken.entry(taken).or_default() += count;
        }
        self
    }
}

/// Episodes that one thread plays in a row; a fixed number, so that the work is cut alike on any number of threads.
const CHUNK: u64 = 50;

/// Plays episodes under `choice`, on all threads.
pub fn roll_out<P: Process>(
    episodes: u64,
    choice: &(impl Fn(Key) -> usize + Sync),
    make: impl Fn() -> P + Sync,
) -> RollOut {
    let chunks = episodes.div_ceil(CHUNK);
    let parts: Vec<RollOut> = (0..chunks)
        .into_par_iter()
        .map(|chunk| {
            let mut process = make();
            let mut part = RollOut::default();
            for episode in chunk * CHUNK..((chunk + 1) * CHUNK).min(episodes) {
                process.start(episode);
                let mut key = process.key();
                *part.starts.entry(key).or_default() += 1;
                loop {
                    let chosen = choice(key);
                    let step = process.decide(chosen, 0);
                    let to = match step.end {
                        End::Not => Some(step.to),
                        End::Terminal => None,
                        End::Cut => break,
                    };
                    *part.taken.entry((key, chosen, step.status, to)).or_default() += 1;
                    match to {
                        Some(next) => key = next,
                        None => break,
                    }
                }
            }
            part
        })
        .collect();
    parts.into_iter().fold(RollOut::default(), RollOut::merge)
}
