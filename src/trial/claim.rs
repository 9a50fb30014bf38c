//! Claims on events, tested in simulation: on as many episodes as it takes to decide.

use super::anytime::Anytime;
use super::play::{self, Unplayable};
use crate::ir::task::{Occurrence, Task};
use crate::ir::tree::Node;
use crate::ir::{Id, Program};
use crate::learn::episode::Episode;
use crate::learn::simulated::Purpose;
use crate::world::Start;

/// The most episodes that test a claim on a probability.
const MOST: u64 = 10_000;

/// The most episodes of a claim that is meant without exception: one failure decides it, and nothing else can.
const WITHOUT_EXCEPTION: u64 = 1000;

/// How many episodes are played before the claim is looked at for the first time; from then on as many again.
const FIRST: u64 = 128;

/// The seed of these episodes, which are those of `btc run`.
pub const SEED: u64 = 1;

/// What the episodes say of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finding {
    /// It fails more often than it allows.
    Refuted,
    /// It fails as rarely as it allows, or never did where it allows no failure to be told from none.
    Kept,
    /// It fails about as often as it allows, so that more episodes than there are would have to tell.
    Open,
}

/// A claim on an event, as the episodes of its tree show it. A test refutes a claim, it never proves one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tested {
    /// The episodes up to the one that decided, with those in which the claim failed.
    pub trials: Anytime,
    /// What they say.
    pub finding: Finding,
    /// The number and the ticks of the shortest of these episodes in which the claim failed.
    pub shortest: Option<(u64, u64)>,
}

impl Tested {
    /// Whether the rate of failure lies above what the claim allows.
    pub fn refuted(&self) -> bool {
        self.finding == Finding::Refuted
    }
}

/// The tests of the claims of a program. The episodes of a tree serve all the claims on it.
#[derive(Debug)]
pub struct Tests<'a> {
    program: &'a Program,
    /// The most episodes that test a claim, if there are to be fewer than it takes.
    most: u64,
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
            most: u64::MAX,
            played: Vec::new(),
        }
    }

    /// No test so far, and none on more episodes than these.
    pub fn at_most(program: &'a Program, most: u64) -> Self {
        Self {
            most,
            ..Self::new(program)
        }
    }

    /// Ticks simulated so far.
    pub fn ticks(&self) -> u64 {
        let episodes = self.played.iter().flat_map(|(_, episodes)| episodes);
        episodes.map(|episode| episode.ticks).sum()
    }

    /// Tests a claim: that the event is reached, or that it never happens. The episodes are looked at in their order, up to
    /// the first after which the interval of the rate of failure is on one side of what the claim allows.
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
        let wanted = Played { task, root, limit };
        let allowed = 1.0 - occurrence.probability;
        let most = match allowed > 0.0 {
            true => MOST,
            false => WITHOUT_EXCEPTION,
        }
        .min(self.most);
        let fails = |episode: &Episode| {
            let count = episode.events.get(occurrence.event.index()).copied();
            (count.unwrap_or(0) > 0) != reaches
        };
        let (mut trials, mut shortest) = (Anytime::default(), None::<(u64, u64)>);
        let mut upto = FIRST.min(most);
        loop {
            let episodes = self.episodes(wanted, upto)?;
            let fresh = episodes.iter().enumerate().take(most as usize);
            for (number, episode) in fresh.skip(trials.trials() as usize) {
                let failed = fails(episode);
                trials.add(failed);
                if failed && shortest.is_none_or(|(_, ticks)| episode.ticks < ticks) {
                    shortest = Some((number as u64, episode.ticks));
                }
                let finding = if trials.is_above(allowed) {
                    Finding::Refuted
                } else if trials.is_below(allowed) {
                    Finding::Kept
                } else {
                    continue;
                };
                return Ok(Tested {
                    trials,
                    finding,
                    shortest,
                });
            }
            if trials.trials() >= most {
                break;
            }
            upto = (2 * upto).min(most);
        }
        let finding = match trials.hits() {
            0 => Finding::Kept,
            _ => Finding::Open,
        };
        Ok(Tested {
            trials,
            finding,
            shortest,
        })
    }

    /// The first episodes of a tree, at least so many.
    fn episodes(&mut self, wanted: Played<'a>, upto: u64) -> Result<&[Episode], Unplayable> {
        let known = self.played.iter().position(|(played, _)| *played == wanted);
        let at = known.unwrap_or(self.played.len());
        if known.is_none() {
            self.played.push((wanted, Vec::new()));
        }
        let Some((_, episodes)) = self.played.get_mut(at) else {
            return Ok(&[]);
        };
        let from = episodes.len() as u64;
        if from < upto {
            let start = Start {
                episode: from,
                ..Purpose::Run.start(SEED, wanted.limit)
            };
            let Played { task, root, .. } = wanted;
            episodes.extend(play::tree(self.program, task, root, upto - from, start)?);
        }
        Ok(episodes)
    }
}
