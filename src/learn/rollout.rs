//! The frozen greedy policy at work: where its episodes start, and what its decisions lead to.

use super::episode::Episode;
use super::process::{End, Key, Process};
use crate::ir::tree::Status;
use crate::world;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A decision with its outcome: minterm, choice, how the behaviour stood, the minterm found if the episode went on.
pub type Taken = (Key, usize, Status, Option<Key>);

/// What the greedy policy met, with how often.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RollOut {
    /// The minterms in which episodes started.
    pub starts: BTreeMap<Key, u64>,
    /// The decisions. One that the tick limit cut short is not among them: nothing is known of its outcome.
    pub taken: BTreeMap<Taken, u64>,
    /// What the episodes came to, in their order.
    pub episodes: Vec<Episode>,
}

impl RollOut {
    fn merge(mut self, other: Self) -> Self {
        for (key, count) in other.starts {
            *self.starts.entry(key).or_default() += count;
        }
        for (taken, count) in other.taken {
            *self.taken.entry(taken).or_default() += count;
        }
        self.episodes.extend(other.episodes);
        self
    }
}

/// Episodes that one thread plays in a row; a fixed number, so that the work is cut alike on any number of threads.
const CHUNK: u64 = 50;

/// Plays episodes on all threads. `choice` says what is done in a minterm, and whether it was seen in learning.
pub fn roll_out<P: Process>(
    episodes: u64,
    choice: &(impl Fn(Key) -> (usize, bool) + Sync),
    make: impl Fn() -> P + Sync,
) -> RollOut {
    let chunks: Vec<RollOut> = (0..episodes.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut process = make();
            let mut met = RollOut::default();
            for episode in chunk * CHUNK..((chunk + 1) * CHUNK).min(episodes) {
                process.start(episode);
                let played = play(&mut process, choice, &mut met);
                met.episodes.push(played);
            }
            met
        })
        .collect();
    chunks.into_iter().fold(RollOut::default(), RollOut::merge)
}

/// Plays the episode that was started, and notes what it meets.
fn play(
    process: &mut impl Process,
    choice: &impl Fn(Key) -> (usize, bool),
    met: &mut RollOut,
) -> Episode {
    let mut key = process.key();
    *met.starts.entry(key).or_default() += 1;
    let (mut ticks, mut total, mut outside) = (0, 0.0, 0);
    loop {
        let (chosen, seen) = choice(key);
        let step = process.decide(chosen, 0);
        ticks += step.ticks;
        total += step.reward;
        if !seen {
            outside += step.ticks;
        }
        let (to, end) = match step.end {
            End::Not => (Some(step.to), None),
            End::Terminal(line) => (None, Some(world::End::On(line))),
            End::Cut => (None, Some(world::End::Cut)),
        };
        if step.end != End::Cut {
            *met.taken.entry((key, chosen, step.status, to)).or_default() += 1;
        }
        if let Some(end) = end {
            return Episode {
                ticks,
                total,
                events: process.events().to_vec(),
                end,
                outside,
            };
        }
        key = step.to;
    }
}
