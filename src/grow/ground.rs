//! Where trees grow: a world, what may be chosen in it, and what its episodes are judged by.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::Atom;
use crate::learn::apart::apart;
use crate::learn::discount::Discounting;
use crate::learn::episode::Episode;
use crate::learn::process::World;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Mean;
use crate::trial::decisions::Watch;
use crate::trial::paired::{Contender, Trials, error};
use crate::world::Start;

/// Where trees grow.
#[derive(Debug)]
pub struct Ground<'w, W> {
    /// The world.
    pub world: &'w W,
    /// The behaviours to choose from.
    pub choices: &'w [Id<Behavior>],
    /// The number of atoms of a minterm; they are the first of the world's.
    pub observed: usize,
    /// A decision is due after this many ticks without another reason.
    pub patience: Option<u64>,
    /// The start of an episode that counts; seed, stream and number are set for each use.
    pub start: Start,
    /// The start of an episode that explores, likewise.
    pub exploring: Start,
    /// How future reward counts in the eyes of the learner.
    pub discounting: Discounting,
    /// The number of lines of `end on`.
    pub ends: usize,
    /// The events that are claimed never to happen.
    pub never: Vec<usize>,
    /// The window of the history that a minterm shows.
    pub history: History,
    /// The seed.
    pub seed: u64,
}

/// The episodes between two races: each race has seeds of its own.
const APART: u64 = 1 << 20;

impl<'w, W: World> Ground<'w, W> {
    /// The same with other seeds, where episodes have so many ticks at most.
    pub fn until(&self, limit: u64) -> Self {
        let until = |start: Start| Start {
            limit: start.limit.min(limit),
            ..start
        };
        Self {
            start: until(self.start),
            exploring: until(self.exploring),
            seed: !self.seed,
            never: self.never.clone(),
            ..*self
        }
    }

    /// Episodes that nothing was chosen by so far: those of a purpose, from race number `race` on. Where trees grow, their
    /// decisions are noted.
    pub fn trials(&self, purpose: Purpose, race: u64) -> Trials<'_, W> {
        let trials = Trials::new(self.world, self.patience, self.episodes(purpose, race));
        match purpose {
            Purpose::Grow => trials.watched(self.watch()),
            _ => trials,
        }
    }

    /// The start of these episodes.
    pub fn episodes(&self, purpose: Purpose, race: u64) -> Start {
        Start {
            seed: self.seed,
            stream: purpose as u64,
            episode: race * APART,
            ..self.start
        }
    }

    /// The atoms of a minterm.
    pub fn atoms(&self) -> &'w [Atom] {
        self.world.atoms().get(..self.observed).unwrap_or(&[])
    }

    /// What went wrong in an episode: an end that costs, and each event that is claimed never to happen.
    pub fn harm(&self, episode: &Episode) -> u64 {
        self.watch()
            .broken(&episode.events)
            .max(u64::from(episode.lost))
    }

    /// What went wrong in the first episodes of a tree; one that returns far less than nearly all others counts as well.
    pub fn harms(&self, played: &Contender, episodes: usize) -> u64 {
        let figures = played.each(|episode| (self.harm(episode), episode.total));
        let (mut harms, mut unharmed) = (0, Vec::new());
        for (harm, total) in figures.into_iter().take(episodes) {
            match harm {
                0 => unharmed.push(total),
                _ => harms += harm,
            }
        }
        harms + apart(&unharmed)
    }

    /// What counts as a decision, and what as harm.
    pub fn watch(&self) -> Watch<'_> {
        Watch {
            choices: self.choices,
            patience: self.patience,
            never: &self.never,
        }
    }
}

/// Whether so many harms are more than so many others by more than so many standard errors of a count.
pub fn does_more_harm([own, other]: [u64; 2], errors: f64) -> bool {
    let more = own.saturating_sub(other) as f64;
    more > errors * ((own + other) as f64).sqrt()
}

/// What the price of harm is a part of: the return of an episode, or its standard deviation if that is more.
pub fn scale(returns: &Mean, episodes: usize) -> f64 {
    let spread = error(returns) * (episodes as f64).sqrt();
    returns.mean.abs().max(spread)
}
