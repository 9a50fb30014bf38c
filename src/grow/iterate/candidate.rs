//! Policies with the episodes that they have played.

use super::Choices;
use crate::grow::ground::Ground;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::learn::episode::{Controller, Episode, play as play_episode};
use crate::learn::greedy::Greedy;
use crate::learn::process::{Key, Process, World};
use crate::learn::statistics::Mean;
use crate::trial::decisions::{Taken, Watched};
use crate::world::Start;
use rayon::prelude::*;
use rustc_hash::FxHashSet;
use std::sync::Arc;

/// A policy with its episodes, from number 0.
pub(super) struct Candidate {
    pub(super) choices: Choices,
    pub(super) played: Vec<Arc<Played>>,
}

/// An episode, and the minterms in which it was decided.
pub(super) struct Played {
    episode: Episode,
    met: FxHashSet<Key>,
}

/// An episode, the ticks that it took, and its decisions.
type Simulated = (Arc<Played>, u64, Vec<Taken>);

impl Candidate {
    /// One that has not played.
    pub(super) fn new(choices: Choices) -> Self {
        Self {
            choices,
            played: Vec::new(),
        }
    }

    /// Its episodes.
    pub(super) fn episodes(&self) -> impl Iterator<Item = &Episode> {
        self.played.iter().map(|played| &played.episode)
    }

    /// Their returns.
    pub(super) fn totals(&self) -> Vec<f64> {
        self.episodes().map(|episode| episode.total).collect()
    }

    /// The episode of another, if this one would decide the same in it.
    fn same(&self, other: &Self, episode: usize) -> Option<Arc<Played>> {
        let played = other.played.get(episode)?;
        let mut met = played.met.iter();
        let same = met.all(|key| self.choices.get(key) == other.choices.get(key));
        same.then(|| played.clone())
    }
}

/// How much more a policy returns than another, episode by episode.
pub(super) fn gain(candidate: &Candidate, base: &Candidate) -> Mean {
    let pairs = candidate.episodes().zip(base.episodes());
    let gains: Vec<f64> = pairs.map(|(own, other)| own.total - other.total).collect();
    Mean::of(&gains)
}

/// Lets policies play up to a number of episodes, on all threads, and gives their decisions with the ticks. An episode in which
/// one decides as `known` does is not played again.
pub(super) fn play<W: World>(
    ground: &Ground<W>,
    (candidates, controllers): (&mut [Candidate], &[Greedy]),
    (start, episodes): (Start, usize),
    known: Option<&Candidate>,
) -> (Vec<Taken>, u64) {
    let standing: &[Candidate] = candidates;
    let due = standing.iter().enumerate();
    let due: Vec<(usize, usize)> = due
        .flat_map(|(i, candidate)| (candidate.played.len()..episodes).map(move |n| (i, n)))
        .collect();
    let played: Vec<Option<Simulated>> = due
        .par_iter()
        .map_init(
            || ground.world.process(),
            |process, (i, n)| {
                let same = known.and_then(|it| standing.get(*i)?.same(it, *n));
                if let Some(same) = same {
                    return Some((same, 0, Vec::new()));
                }
                let mut noting = Noting {
                    greedy: controllers.get(*i)?.clone(),
                    last: None,
                    met: FxHashSet::default(),
                };
                let start = Start {
                    episode: start.episode + *n as u64,
                    ..start
                };
                let mut watched = Watched::new(process, ground.watch());
                let episode = play_episode(&mut watched, &mut noting, start, ground.patience);
                let ticks = episode.ticks;
                let met = noting.met;
                let played = Arc::new(Played { episode, met });
                Some((played, ticks, watched.into_taken()))
            },
        )
        .collect();
    let (mut all, mut ticks) = (Vec::new(), 0);
    for ((i, _), played) in due.into_iter().zip(played) {
        if let (Some((played, used, taken)), Some(candidate)) = (played, candidates.get_mut(i)) {
            all.extend(taken);
            ticks += used;
            candidate.played.push(played);
        }
    }
    (all, ticks)
}

/// A policy whose minterms are noted.
struct Noting {
    greedy: Greedy,
    last: Option<Key>,
    met: FxHashSet<Key>,
}

impl Noting {
    fn note(&mut self, key: Key) {
        if self.last != Some(key) {
            self.last = Some(key);
            self.met.insert(key);
        }
    }
}

impl Controller for Noting {
    fn reset(&mut self) {
        self.greedy.reset();
        self.last = None;
        self.met.clear();
    }

    fn tick(&mut self, process: &mut impl Process) {
        self.note(process.key());
        self.greedy.tick(process);
    }

    fn steady(&mut self, process: &impl Process) -> Option<Id<Behavior>> {
        self.note(process.key());
        self.greedy.steady(process)
    }

    fn passed(&mut self, ticks: u64) {
        self.greedy.passed(ticks);
    }

    fn answered(&mut self, process: &mut impl Process, behavior: Id<Behavior>, status: Status) {
        self.greedy.answered(process, behavior, status);
    }

    fn outside(&self) -> u64 {
        self.greedy.outside()
    }
}

#[cfg(test)]
mod tests {
    use super::{Candidate, Played};
    use crate::learn::episode::Episode;
    use crate::world::End;
    use std::sync::Arc;

    /// An episode through minterms 1 and 2, under choices in 1 and 3.
    #[test]
    fn an_episode_is_the_same_where_its_minterms_are_decided_alike() {
        let mut base = Candidate::new([(1, 0), (3, 0)].into_iter().collect());
        let episode = Episode {
            ticks: 5,
            total: 1.0,
            last: 0.0,
            events: Vec::new(),
            end: End::Cut,
            lost: false,
            outside: 0,
        };
        let met = [1, 2].into_iter().collect();
        base.played.push(Arc::new(Played { episode, met }));
        let same = |choices: &[(u128, usize)], episode| {
            let other = Candidate::new(choices.iter().copied().collect());
            other.same(&base, episode).is_some()
        };
        assert!(same(&[(1, 0), (3, 1)], 0));
        assert!(!same(&[(1, 1), (3, 0)], 0));
        assert!(!same(&[(1, 0), (2, 0), (3, 0)], 0));
        assert!(!same(&[(1, 0), (3, 0)], 1));
    }
}
