//! Training: episodes under the method's own greedy choices, with exploration.

use super::curve;
use super::discount::Discounting;
use super::method::{Decision, Method};
use super::process::{End, Process};
use super::q_table::QTable;
use super::record::Record;
use super::schedule::Schedule;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::random::Random;
use crate::world::Start;
use serde::{Deserialize, Serialize};

/// The settings of training that hold for every method.
#[derive(Clone, Copy, Debug)]
pub struct Course<'a> {
    /// The behaviours to choose from.
    pub choices: &'a [Id<Behavior>],
    /// A decision is due after this many ticks without another reason.
    pub patience: Option<u64>,
    /// The start of episode 0.
    pub start: Start,
    /// The number of episodes.
    pub episodes: u64,
    /// The probability of a random choice, by a minterm's visits and the progress.
    pub explore: Schedule<'a>,
    /// The discount of future reward.
    pub discounting: Discounting,
    /// The least ticks for which a choice is kept.
    pub dwell: u64,
}

/// How much was simulated so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counts {
    /// Episodes begun.
    pub episodes: u64,
    /// Decisions completed.
    pub decisions: u64,
    /// Decisions that the limit of an episode cut.
    pub cut: u64,
    /// Ticks simulated.
    pub ticks: u64,
}

/// The stream of the exploration's random numbers, apart from those of the world.
const EXPLORATION: u64 = u64::MAX;

/// How far training has come, beside what the method has learned.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Trained {
    /// How much was simulated.
    pub counts: Counts,
    /// What was met.
    pub record: Record,
    /// The random numbers of the exploration.
    random: Random,
}

impl Trained {
    /// Not begun.
    pub fn new(seed: u64) -> Self {
        Self {
            counts: Counts::default(),
            record: Record::default(),
            random: Random::new(seed, EXPLORATION, 0),
        }
    }
}

/// Learns, from where training stands. [`curve::due`] cuts the episodes into rounds; after each the method refits, and
/// `round` gets its table. `after` is called after every episode.
pub fn train(
    process: &mut impl Process,
    method: &mut dyn Method,
    course: &Course,
    trained: &mut Trained,
    mut round: impl FnMut(&QTable, &Counts),
    mut after: impl FnMut(&dyn Method, &Trained),
) {
    for episode in trained.counts.episodes..course.episodes {
        let share = episode as f64 / course.episodes as f64;
        process.start(Start {
            episode,
            ..course.start
        });
        trained.counts.episodes += 1;
        play(process, method, course, share, trained);
        trained.record.episode(process.events());
        if curve::due(episode, course.episodes) {
            method.refit();
            round(method.table(), &trained.counts);
        }
        after(method, trained);
    }
}

/// Plays the episode that has started.
fn play(
    process: &mut impl Process,
    method: &mut dyn Method,
    course: &Course,
    progress: f64,
    trained: &mut Trained,
) {
    let Trained {
        counts,
        record,
        random,
    } = trained;
    let mut row = method.row(process.key());
    method.begin(row);
    loop {
        let visits = method.table().visits(row);
        let epsilon = course.explore.at(visits as f64, progress);
        let choice = match method.greedy(row) {
            Some(best) if random.unit() >= epsilon => best,
            _ => random.below(course.choices.len() as u64) as usize,
        };
        let Some(behavior) = course.choices.get(choice) else {
            // The checker lets no task through that has nothing to choose from.
            return;
        };
        let step = process.decide(*behavior, course.patience, course.dwell);
        match step.end {
            End::Cut => counts.cut += 1,
            _ => counts.decisions += 1,
        }
        counts.ticks += step.ticks;
        record.decision(choice, &step);
        let next = method.row(step.to);
        method.learn(&Decision {
            row,
            choice,
            step,
            next,
            factor: Decision::factor(&step, &course.discounting),
            progress,
        });
        if step.end != End::Not {
            return;
        }
        row = next;
    }
}
