//! Trees compared on the same seeds.

use super::play;
use super::trace::{Paths, Recorded, Trace};
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::tree::{Atom, Node};
use crate::ir::{Id, Program};
use crate::learn::episode::{Episode, play as play_episode};
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Mean;
use crate::tree::Runner;
use crate::tree::prune::Decided;
use crate::world::{BuildError, End, Simulator, Start};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The world and the seeds on which trees are compared.
#[derive(Clone, Debug)]
pub struct Trials {
    simulator: Simulator,
    patience: Option<u64>,
    start: Start,
}

/// An episode with its trace.
#[derive(Debug)]
struct Played {
    episode: Episode,
    trace: Trace,
}

/// A tree with the episodes that it has played, from number 0.
#[derive(Clone, Debug)]
pub struct Contender {
    runner: Runner,
    played: Vec<Arc<Played>>,
}

impl Contender {
    /// The number of episodes played.
    pub fn episodes(&self) -> usize {
        self.played.len()
    }

    /// The paths of its episodes.
    pub fn paths(&self) -> Paths {
        Paths::of(self.played.iter().map(|played| &played.trace))
    }

    /// The behaviours that drove the robot, each with a valuation and the ticks that it drove there.
    pub fn decided(&self) -> Vec<Decided> {
        let mut ticks: BTreeMap<(Id<Behavior>, u128), u64> = BTreeMap::new();
        for (behavior, values, times) in self.played.iter().flat_map(|p| p.trace.decided()) {
            *ticks.entry((behavior, values)).or_default() += times;
        }
        let decided = ticks.into_iter();
        decided
            .map(|((behavior, values), times)| (behavior, values, times))
            .collect()
    }

    /// The figures of the episodes.
    pub fn results(&self) -> Vec<Episode> {
        let episodes = self.played.iter().map(|played| &played.episode);
        episodes.cloned().collect()
    }

    /// The mean return.
    pub fn returns(&self) -> Mean {
        let totals: Vec<f64> = self.played.iter().map(|p| p.episode.total).collect();
        Mean::of(&totals)
    }

    /// The standard deviation of a return.
    pub fn spread(&self) -> f64 {
        error(&self.returns()) * (self.episodes() as f64).sqrt()
    }

    /// Whether the tree does the same on every path.
    pub fn agrees(&mut self, paths: &Paths) -> bool {
        paths.replay(&mut self.runner)
    }

    /// The tree with the episodes of another that plays alike.
    pub fn standing_for(self, other: &Self) -> Self {
        Self {
            played: other.played.clone(),
            ..self
        }
    }

    /// What it loses against another tree, episode by episode, over those that both have played.
    pub fn loss(&self, against: &Self) -> Mean {
        let pairs = self.played.iter().zip(&against.played);
        let lost: Vec<f64> = pairs
            .map(|(own, other)| other.episode.total - own.episode.total)
            .collect();
        Mean::of(&lost)
    }

    /// Episodes that a line of `end on` ended to this tree's loss and the other's did not, less those the other way
    /// round.
    pub fn ended_more(&self, against: &Self) -> i64 {
        let pairs = self.played.iter().zip(&against.played);
        pairs
            .map(|(own, other)| {
                let (own, other) = (&own.episode, &other.episode);
                i64::from(ended_worse(own, other)) - i64::from(ended_worse(other, own))
            })
            .sum()
    }
}

/// The standard error of a mean.
pub fn error(mean: &Mean) -> f64 {
    (mean.ci95[1] - mean.mean) / 1.96
}

/// Whether a tree loses at most `limit` with 95 % confidence, and `end on` ends no more of its episodes to its loss.
pub fn within(tree: &Contender, other: &Contender, limit: f64) -> bool {
    tree.loss(other).ci95[1] <= limit && tree.ended_more(other) <= 0
}

fn ended_worse(own: &Episode, other: &Episode) -> bool {
    matches!(own.end, End::On(_)) && own.end != other.end && own.total < other.total
}

impl Trials {
    /// The world of a task, which knows the atoms that a tree asks.
    ///
    /// # Errors
    /// The world cannot be built.
    pub fn new(
        program: &Program,
        task: Id<Task>,
        root: &Node,
        (purpose, seed): (Purpose, u64),
    ) -> Result<Self, BuildError> {
        let simulator = play::world(program, task, root)?;
        let task = &program.tasks[task];
        Ok(Self {
            simulator,
            patience: task.patience,
            start: purpose.start(seed, task.end_after),
        })
    }

    /// The atoms of a valuation, bit by bit.
    pub fn atoms(&self) -> &[Atom] {
        self.simulator.atoms()
    }

    /// The same world with the seeds of another purpose.
    pub fn with(self, purpose: Purpose) -> Self {
        let start = purpose.start(self.start.seed, self.start.limit);
        Self { start, ..self }
    }

    /// A tree that has not played.
    ///
    /// # Errors
    /// An atom that the world does not know.
    pub fn contender(&self, root: &Node) -> Result<Contender, Atom> {
        Ok(Contender {
            runner: Runner::new(root, self.simulator.atoms())?,
            played: Vec::new(),
        })
    }

    /// Lets every contender play the episodes below `episodes` that it has not played yet, on all threads, and counts
    /// the ticks. Episodes in which a contender does what `known` did are not played again.
    pub fn play(
        &self,
        contenders: &mut [&mut Contender],
        episodes: usize,
        known: Option<&Contender>,
    ) -> u64 {
        let due: Vec<(usize, usize)> = contenders
            .iter()
            .enumerate()
            .flat_map(|(i, contender)| (contender.episodes()..episodes).map(move |n| (i, n)))
            .collect();
        let runners = contenders.iter().map(|contender| &contender.runner);
        let runners: Vec<&Runner> = runners.collect();
        let make = || self.simulator.simulation();
        let played: Vec<(Arc<Played>, u64)> = due
            .par_iter()
            .map_init(make, |simulation, &(i, n)| {
                let mut runner = runners.get(i).map(|r| (*r).clone())?;
                if let Some(same) = known.and_then(|known| known.played.get(n))
                    && same.trace.replays(&mut runner)
                {
                    return Some((same.clone(), 0));
                }
                let start = Start {
                    episode: n as u64,
                    ..self.start
                };
                let mut recorded = Recorded::new(runner);
                let episode = play_episode(simulation, &mut recorded, start, self.patience);
                let ticks = episode.ticks;
                let trace = recorded.into_trace();
                Some((Arc::new(Played { episode, trace }), ticks))
            })
            .flatten()
            .collect();
        let mut ticks = 0;
        for ((i, _), (played, took)) in due.into_iter().zip(played) {
            ticks += took;
            if let Some(contender) = contenders.get_mut(i) {
                contender.played.push(played);
            }
        }
        ticks
    }
}
