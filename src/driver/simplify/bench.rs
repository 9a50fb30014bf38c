//! Trees against each other on the same seeds.

use super::trace::{Paths, Recorded, Trace};
use crate::diagnostic::Diagnostic;
use crate::driver::load::Loaded;
use crate::driver::run;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::tree::{Atom, Node};
use crate::learn::episode::{Episode, play};
use crate::learn::statistics::Mean;
use crate::tree::Runner;
use crate::tree::prune::Decided;
use crate::world::{End, Simulator, Start};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// The world in which trees are held against each other.
pub(super) struct Bench {
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
pub(super) struct Player {
    runner: Runner,
    played: Vec<Arc<Played>>,
}

impl Player {
    /// How many episodes were played.
    pub(super) fn episodes(&self) -> usize {
        self.played.len()
    }

    /// All that its episodes came through.
    pub(super) fn paths(&self) -> Paths {
        Paths::of(self.played.iter().map(|played| &played.trace))
    }

    /// What drove, in which valuation, for how many ticks.
    pub(super) fn decided(&self) -> Vec<Decided> {
        let mut ticks: BTreeMap<(Id<Behavior>, u128), u64> = BTreeMap::new();
        for (behavior, values, times) in self.played.iter().flat_map(|p| p.trace.decided()) {
            *ticks.entry((behavior, values)).or_default() += times;
        }
        let decided = ticks.into_iter();
        decided
            .map(|((behavior, values), times)| (behavior, values, times))
            .collect()
    }

    /// What the episodes came to.
    pub(super) fn results(&self) -> Vec<Episode> {
        let episodes = self.played.iter().map(|played| &played.episode);
        episodes.cloned().collect()
    }

    /// The mean return.
    pub(super) fn returns(&self) -> Mean {
        let totals: Vec<f64> = self.played.iter().map(|p| p.episode.total).collect();
        Mean::of(&totals)
    }

    /// The standard deviation of a return.
    pub(super) fn spread(&self) -> f64 {
        error(&self.returns()) * (self.episodes() as f64).sqrt()
    }

    /// Whether the tree plays every path alike.
    pub(super) fn agrees(&mut self, paths: &Paths) -> bool {
        paths.replay(&mut self.runner)
    }

    /// The tree in the place of another that plays alike.
    pub(super) fn standing_for(self, other: &Self) -> Self {
        Self {
            played: other.played.clone(),
            ..self
        }
    }

    /// What it loses against another tree, episode by episode, over those that both have played.
    pub(super) fn loss(&self, against: &Self) -> Mean {
        let pairs = self.played.iter().zip(&against.played);
        let lost: Vec<f64> = pairs
            .map(|(own, other)| other.episode.total - own.episode.total)
            .collect();
        Mean::of(&lost)
    }

    /// Episodes that a line of `end on` ended to this tree's loss and the other's did not, less those the other way
    /// round.
    pub(super) fn ended_more(&self, against: &Self) -> i64 {
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
pub(super) fn error(mean: &Mean) -> f64 {
    (mean.ci95[1] - mean.mean) / 1.96
}

/// Whether a tree loses at most so much with 95 % confidence, and has no more episodes ended to its loss.
pub(super) fn within(player: &Player, other: &Player, limit: f64) -> bool {
    player.loss(other).ci95[1] <= limit && player.ended_more(other) <= 0
}

fn ended_worse(own: &Episode, other: &Episode) -> bool {
    matches!(own.end, End::On(_)) && own.end != other.end && own.total < other.total
}

impl Bench {
    /// The world of a task, for a tree and what may be made of it.
    pub(super) fn new(
        loaded: &Loaded,
        task: Id<Task>,
        root: &Node,
        start: Start,
    ) -> Result<Self, Diagnostic> {
        let mut asked = BTreeSet::new();
        root.visit_atoms(&mut |atom| {
            asked.insert(atom);
        });
        let asked: Vec<Atom> = asked.into_iter().collect();
        Ok(Self {
            simulator: run::simulator(loaded, task, &asked)?,
            patience: loaded.program.tasks[task].patience,
            start,
        })
    }

    /// What the bits of a valuation mean.
    pub(super) fn atoms(&self) -> &[Atom] {
        self.simulator.atoms()
    }

    /// The same world with the seeds of another stream.
    pub(super) fn on(self, stream: u64) -> Self {
        let start = Start {
            stream,
            ..self.start
        };
        Self { start, ..self }
    }

    /// A tree that has not played; `None` if it asks what the world does not say.
    pub(super) fn player(&self, root: &Node) -> Option<Player> {
        let runner = Runner::new(root, self.simulator.atoms()).ok()?;
        Some(Player {
            runner,
            played: Vec::new(),
        })
    }

    /// Has every player play the episodes up to number `episodes`, on all threads; says how many ticks it took.
    ///
    /// Episodes in which a player does what `known` did are not played again.
    pub(super) fn play(
        &self,
        players: &mut [&mut Player],
        episodes: usize,
        known: Option<&Player>,
    ) -> u64 {
        let due: Vec<(usize, usize)> = players
            .iter()
            .enumerate()
            .flat_map(|(i, player)| (player.episodes()..episodes).map(move |n| (i, n)))
            .collect();
        let runners: Vec<&Runner> = players.iter().map(|player| &player.runner).collect();
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
                let episode = play(simulation, &mut recorded, start, self.patience);
                let ticks = episode.ticks;
                let trace = recorded.into_trace();
                Some((Arc::new(Played { episode, trace }), ticks))
            })
            .flatten()
            .collect();
        let mut ticks = 0;
        for ((i, _), (played, took)) in due.into_iter().zip(played) {
            ticks += took;
            if let Some(player) = players.get_mut(i) {
                player.played.push(played);
            }
        }
        ticks
    }
}
