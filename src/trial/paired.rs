//! Trees compared on the same seeds.

use super::decisions::{Taken, Watch, Watched};
use super::trace::{Paths, Recorded, Trace};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use crate::learn::episode::{Episode, play as play_episode};
use crate::learn::process::World;
use crate::learn::statistics::Mean;
use crate::tree::Runner;
use crate::world::Start;
use rayon::prelude::*;
use std::sync::Arc;

/// The world and the seeds on which trees are compared.
#[derive(Debug)]
pub struct Trials<'w, W> {
    world: &'w W,
    patience: Option<u64>,
    watch: Option<Watch<'w>>,
    start: Start,
}

/// An episode that was played.
#[derive(Debug)]
struct Played {
    episode: Episode,
    trace: Trace,
}

/// What was simulated.
#[derive(Debug, Default)]
pub struct Simulated {
    /// Its ticks.
    pub ticks: u64,
    /// The decisions of its episodes, in their order, if they are watched.
    pub taken: Vec<Taken>,
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

    /// The figures of the episodes.
    pub fn results(&self) -> Vec<Episode> {
        let episodes = self.played.iter().map(|played| &played.episode);
        episodes.cloned().collect()
    }

    /// A figure of each episode.
    pub fn each<T>(&self, figure: impl Fn(&Episode) -> T) -> Vec<T> {
        let episodes = self.played.iter().map(|played| &played.episode);
        episodes.map(figure).collect()
    }

    /// The mean length of an episode in ticks; 0 if none was played.
    pub fn length(&self) -> u64 {
        let ticks: u64 = self.each(|episode| episode.ticks).into_iter().sum();
        ticks.checked_div(self.episodes() as u64).unwrap_or(0)
    }

    /// The part of its ticks in which a behaviour was ticked and did not fail.
    pub fn driven(&self, behavior: Id<Behavior>) -> f64 {
        let driven = self.played.iter().map(|p| p.trace.driven(behavior));
        let ticks: u64 = self.each(|episode| episode.ticks).into_iter().sum();
        driven.sum::<u64>() as f64 / ticks.max(1) as f64
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

    /// What it loses against another tree, episode by episode, over those that both have played.
    pub fn loss(&self, against: &Self) -> Mean {
        let pairs = self.played.iter().zip(&against.played);
        let lost: Vec<f64> = pairs
            .map(|(own, other)| other.episode.total - own.episode.total)
            .collect();
        Mean::of(&lost)
    }
}

/// The standard error of a mean.
pub fn error(mean: &Mean) -> f64 {
    (mean.ci95[1] - mean.mean) / 1.96
}

impl<'w, W: World> Trials<'w, W> {
    /// Episodes in a world, from the one that starts like this.
    pub fn new(world: &'w W, patience: Option<u64>, start: Start) -> Self {
        Self {
            world,
            patience,
            watch: None,
            start,
        }
    }

    /// The same, with the decisions of the episodes noted.
    pub fn watched(self, watch: Watch<'w>) -> Self {
        Self {
            watch: Some(watch),
            ..self
        }
    }

    /// The atoms of a valuation, bit by bit.
    pub fn atoms(&self) -> &[Atom] {
        self.world.atoms()
    }

    /// A tree that has not played.
    ///
    /// # Errors
    /// An atom that the world does not know.
    pub fn contender(&self, root: &Node) -> Result<Contender, Atom> {
        Ok(Contender {
            runner: Runner::new(root, self.world.atoms())?,
            played: Vec::new(),
        })
    }

    /// Lets every contender play the episodes below `episodes` that it has not played yet, on all threads, and gives
    /// what was simulated. Episodes in which a contender does what `known` did are not played again.
    pub fn play(
        &self,
        contenders: &mut [&mut Contender],
        episodes: usize,
        known: Option<&Contender>,
    ) -> Simulated {
        let due: Vec<(usize, usize)> = contenders
            .iter()
            .enumerate()
            .flat_map(|(i, contender)| (contender.episodes()..episodes).map(move |n| (i, n)))
            .collect();
        let runners = contenders.iter().map(|contender| &contender.runner);
        let runners: Vec<&Runner> = runners.collect();
        let (played, simulated) = self.simulate(&runners, &due, known);
        for ((i, _), played) in due.into_iter().zip(played) {
            if let Some(contender) = contenders.get_mut(i) {
                contender.played.push(played);
            }
        }
        simulated
    }

    /// The figures of these episodes under each contender, in their order, and what was simulated for them. Nothing is noted in the
    /// contenders.
    pub fn sample(
        &self,
        contenders: &[&Contender],
        episodes: &[usize],
        known: &Contender,
    ) -> (Vec<Vec<Episode>>, Simulated) {
        let numbers = 0..contenders.len();
        let due = numbers.flat_map(|i| episodes.iter().map(move |n| (i, *n)));
        let due: Vec<(usize, usize)> = due.collect();
        let runners = contenders.iter().map(|contender| &contender.runner);
        let runners: Vec<&Runner> = runners.collect();
        let (played, simulated) = self.simulate(&runners, &due, Some(known));
        let mut figures = vec![Vec::new(); contenders.len()];
        for ((i, _), played) in due.into_iter().zip(played) {
            if let Some(figures) = figures.get_mut(i) {
                figures.push(played.episode.clone());
            }
        }
        (figures, simulated)
    }

    /// Plays episodes, each under one of these trees, on all threads, unless it does what `known` did in it.
    fn simulate(
        &self,
        runners: &[&Runner],
        due: &[(usize, usize)],
        known: Option<&Contender>,
    ) -> (Vec<Arc<Played>>, Simulated) {
        let make = || self.world.process();
        let all: Vec<(Arc<Played>, Simulated)> = due
            .par_iter()
            .map_init(make, |process, &(i, n)| {
                let mut runner = runners.get(i).map(|r| (*r).clone())?;
                if let Some(same) = known.and_then(|known| known.played.get(n))
                    && same.trace.replays(&mut runner)
                {
                    return Some((same.clone(), Simulated::default()));
                }
                let start = Start {
                    episode: self.start.episode + n as u64,
                    ..self.start
                };
                let mut recorded = Recorded::new(runner);
                let (episode, taken) = match self.watch {
                    None => (
                        play_episode(process, &mut recorded, start, self.patience),
                        Vec::new(),
                    ),
                    Some(watch) => {
                        let mut watched = Watched::new(process, watch);
                        let episode =
                            play_episode(&mut watched, &mut recorded, start, self.patience);
                        (episode, watched.into_taken())
                    }
                };
                let ticks = episode.ticks;
                let trace = recorded.into_trace();
                let played = Arc::new(Played { episode, trace });
                Some((played, Simulated { ticks, taken }))
            })
            .flatten()
            .collect();
        let mut simulated = Simulated::default();
        let mut episodes = Vec::with_capacity(all.len());
        for (played, new) in all {
            simulated.ticks += new.ticks;
            simulated.taken.extend(new.taken);
            episodes.push(played);
        }
        (episodes, simulated)
    }
}
