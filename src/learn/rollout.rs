//! A frozen policy at work: where its episodes start, what its decisions lead to, and their value.

use super::discount::Discounting;
use super::episode::Episode;
use super::extract::{Decided, Decisions};
use super::process::{End, Key, Process};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::world::{self, Start};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A policy to roll out.
#[derive(Clone, Copy, Debug)]
pub struct Frozen<'p> {
    /// Its decisions.
    pub decisions: &'p Decisions,
    /// Its decision in all other minterms, with their value.
    pub unseen: Decided,
    /// How its future reward counts.
    pub discounting: Discounting,
    /// The behaviours that choices count.
    pub choices: &'p [Id<Behavior>],
    /// A decision is due after this many ticks without another reason.
    pub patience: Option<u64>,
}

/// A decision with its outcome: minterm, choice, how the behaviour stood, the minterm found if the episode went on.
pub type Taken = (Key, usize, Status, Option<Key>);

/// The value of an episode at its start.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Worth {
    /// The minterm there.
    pub start: Key,
    /// The value that the learner predicts for it.
    pub predicted: f64,
    /// The discounted sum of its rewards, as far as it went.
    pub simulated: f64,
    /// Where the tick limit cut the episode: the minterm that held, and the discount of what would follow.
    pub rest: Option<(Key, f64)>,
}

/// What decisions in one minterm led to that found the same minterm after them, or ended their episodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// How many there were.
    pub count: u64,
    /// The sum of their rewards.
    pub reward: f64,
    /// The sum of the discounts of what followed.
    pub factor: f64,
    /// The sum of their ticks.
    pub ticks: u64,
}

impl Outcome {
    fn add(&mut self, other: &Self) {
        self.count += other.count;
        self.reward += other.reward;
        self.factor += other.factor;
        self.ticks += other.ticks;
    }
}

/// What a policy met, with counts.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RollOut {
    /// The minterms in which episodes started.
    pub starts: BTreeMap<Key, u64>,
    /// The decisions. Those that the tick limit cut are left out: their outcome is unknown.
    pub taken: BTreeMap<Taken, u64>,
    /// What the complete decisions of each minterm led to, by the minterm found after them if the episode went on.
    pub outcomes: BTreeMap<(Key, Option<Key>), Outcome>,
    /// The figures of the episodes, in their order.
    pub episodes: Vec<Episode>,
    /// Their values, in the same order.
    pub worth: Vec<Worth>,
}

impl RollOut {
    fn merge(mut self, other: Self) -> Self {
        for (key, count) in other.starts {
            *self.starts.entry(key).or_default() += count;
        }
        for (taken, count) in other.taken {
            *self.taken.entry(taken).or_default() += count;
        }
        for (way, outcome) in other.outcomes {
            self.outcomes.entry(way).or_default().add(&outcome);
        }
        self.episodes.extend(other.episodes);
        self.worth.extend(other.worth);
        self
    }

    /// How many decisions were taken in each minterm.
    pub fn decisions(&self) -> BTreeMap<Key, u64> {
        let mut counts = BTreeMap::new();
        for (&(from, ..), count) in &self.taken {
            *counts.entry(from).or_default() += count;
        }
        counts
    }
}

/// Episodes that one thread plays in a row. The number is fixed, so that any number of threads splits the work alike.
const CHUNK: u64 = 10;

/// Plays episodes on all threads.
pub fn roll_out<P: Process>(
    episodes: u64,
    policy: &Frozen,
    start: Start,
    make: impl Fn() -> P + Sync,
) -> RollOut {
    let chunks: Vec<RollOut> = (0..episodes.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let mut process = make();
            let mut met = RollOut::default();
            for episode in chunk * CHUNK..((chunk + 1) * CHUNK).min(episodes) {
                process.start(Start { episode, ..start });
                play(&mut process, policy, &mut met);
            }
            met
        })
        .collect();
    chunks.into_iter().fold(RollOut::default(), RollOut::merge)
}

/// Plays the episode that has started, and notes what it meets.
fn play(process: &mut impl Process, policy: &Frozen, met: &mut RollOut) {
    let look = |key: &Key| match policy.decisions.get(key) {
        Some(decided) => (*decided, true),
        None => (policy.unseen, false),
    };
    let mut key = process.key();
    let start = key;
    *met.starts.entry(key).or_default() += 1;
    let predicted = look(&key).0.value;
    let (mut ticks, mut total, mut outside) = (0, 0.0, 0);
    let (mut simulated, mut weight) = (0.0, 1.0);
    let (end, last, lost) = loop {
        let (Decided { choice, .. }, seen) = look(&key);
        let Some(behavior) = policy.choices.get(choice) else {
            // The checker lets no task through that has nothing to choose from.
            break (world::End::Cut, 0.0, false);
        };
        let step = process.decide(*behavior, policy.patience, 0);
        ticks += step.ticks;
        total += step.reward;
        let factor = policy.discounting.factor(step.ticks);
        let whole = step.end != End::Cut;
        if whole {
            simulated += weight * step.reward;
            weight *= factor;
        } else {
            weight *= policy.discounting.within(step.ticks);
        }
        if !seen {
            outside += step.ticks;
        }
        let (to, end) = match step.end {
            End::Not => (Some(step.to), None),
            End::Terminal(line) => (None, Some(world::End::On(line))),
            End::Limit => (Some(step.to), Some(world::End::Cut)),
            End::Cut => (None, Some(world::End::Cut)),
        };
        if end != Some(world::End::Cut) {
            *met.taken.entry((key, choice, step.status, to)).or_default() += 1;
        }
        if whole {
            met.outcomes.entry((key, to)).or_default().add(&Outcome {
                count: 1,
                reward: step.reward,
                factor,
                ticks: step.ticks,
            });
        }
        key = step.to;
        if let Some(end) = end {
            break (end, step.reward, step.lost);
        }
    };
    met.worth.push(Worth {
        start,
        predicted,
        simulated,
        rest: (end == world::End::Cut).then_some((key, weight)),
    });
    met.episodes.push(Episode {
        ticks,
        total,
        last,
        events: process.events().to_vec(),
        end,
        lost,
        outside,
    });
}
