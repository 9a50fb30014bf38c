//! Claims on events, tested in simulation.

use super::play::{self, Unplayable};
use crate::ir::task::{Occurrence, Task};
use crate::ir::tree::Node;
use crate::ir::{Id, Program};
use crate::learn::binomial::{lower95, upper95};
use crate::learn::episode::Episode;
use crate::learn::simulated::Purpose;

/// The episodes that test a claim on an event.
const EPISODES: u64 = 1000;

/// The seed of these episodes.
const SEED: u64 = 1;

/// A claim on an event, as the episodes of its tree show it. A test refutes a claim, it never proves one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tested {
    /// The episodes that tested the claim.
    pub episodes: u64,
    /// Those in which it failed.
    pub failed: u64,
    /// Whether the 95 % interval of the rate of failure lies above what the claim allows.
    pub refuted: bool,
}

impl Tested {
    /// The bound of the rate of failure at 95 %: the lower one of a refuted claim, else the upper one.
    pub fn bound(&self) -> f64 {
        match self.refuted {
            true => lower95(self.failed, self.episodes),
            false => upper95(self.failed, self.episodes),
        }
    }
}

/// The tests of the claims of a program. The episodes of a tree serve all the claims on it.
#[derive(Debug)]
pub struct Tests<'a> {
    program: &'a Program,
    played: Vec<(Played<'a>, Vec<Episode>)>,
}

/// A tree for a task, and the most ticks of its episodes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Played<'a> {
    task: Id<Task>,
    root: &'a Node,
    limit: u64,
}

impl<'a> Tests<'a> {
    /// No test so far.
    pub fn new(program: &'a Program) -> Self {
        Self {
            program,
            played: Vec::new(),
        }
    }

    /// Tests a claim: that the event is reached, or that it never happens.
    ///
    /// # Errors
    /// The tree cannot be played.
    pub fn event(
        &mut self,
        (task, root): (Id<Task>, &'a Node),
        occurrence: &Occurrence,
        reaches: bool,
    ) -> Result<Tested, Unplayable> {
        let whole = self.program.tasks[task].end_after;
        let limit = occurrence.within.unwrap_or(whole).min(whole);
        let episodes = self.episodes(Played { task, root, limit })?;
        let fails = |episode: &&Episode| {
            let count = episode.events.get(occurrence.event.index()).copied();
            (count.unwrap_or(0) > 0) != reaches
        };
        let failed = episodes.iter().filter(fails).count() as u64;
        let allowed = 1.0 - occurrence.probability;
        Ok(Tested {
            episodes: EPISODES,
            failed,
            refuted: if allowed > 0.0 {
                lower95(failed, EPISODES) > allowed
            } else {
                failed > 0
            },
        })
    }

    fn episodes(&mut self, wanted: Played<'a>) -> Result<&[Episode], Unplayable> {
        let known = self.played.iter().position(|(played, _)| *played == wanted);
        let at = match known {
            Some(at) => at,
            None => {
                let start = Purpose::Claim.start(SEED, wanted.limit);
                let Played { task, root, .. } = wanted;
                let episodes = play::tree(self.program, task, root, EPISODES, start)?;
                self.played.push((wanted, episodes));
                self.played.len() - 1
            }
        };
        Ok(self.played.get(at).map_or(&[], |(_, episodes)| episodes))
    }
}
