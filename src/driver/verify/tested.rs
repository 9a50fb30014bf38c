//! Claims on events, tested in simulation.

use super::Proved;
use crate::diagnostic::Diagnostic;
use crate::driver::load::Loaded;
use crate::driver::run;
use crate::ir::Id;
use crate::ir::task::{Occurrence, Task};
use crate::ir::tree::Node;
use crate::learn::binomial::{lower95, upper95};
use crate::learn::episode::Episode;
use crate::learn::simulated::Purpose;
use crate::world::Start;

/// How many episodes a claim on an event is tested in.
const EPISODES: u64 = 1000;

/// The episodes that trees have played for their claims: those that a tree has played serve all its claims.
pub(super) struct Tests<'a> {
    loaded: &'a Loaded,
    played: Vec<(Played<'a>, Vec<Episode>)>,
}

/// A tree for a task, and the ticks of its episodes.
#[derive(Clone, Copy, PartialEq)]
struct Played<'a> {
    task: Id<Task>,
    root: &'a Node,
    limit: u64,
}

impl<'a> Tests<'a> {
    pub(super) fn new(loaded: &'a Loaded) -> Self {
        Self {
            loaded,
            played: Vec::new(),
        }
    }

    /// Tests a claim on an event. It is refuted where the 95 % interval of the rate at which it fails lies above what
    /// it allows; it is never proved.
    pub(super) fn event(
        &mut self,
        (task, root): (Id<Task>, &'a Node),
        text: &str,
        occurrence: &Occurrence,
        reaches: bool,
    ) -> Result<Proved, Diagnostic> {
        let whole = self.loaded.program.tasks[task].end_after;
        let limit = occurrence.within.unwrap_or(whole).min(whole);
        let episodes = self.episodes(Played { task, root, limit })?;
        let fails = |episode: &&Episode| {
            let count = episode.events.get(occurrence.event.index()).copied();
            (count.unwrap_or(0) > 0) != reaches
        };
        let failed = episodes.iter().filter(fails).count() as u64;
        let allowed = 1.0 - occurrence.probability;
        let refuted = if allowed > 0.0 {
            lower95(failed, EPISODES) > allowed
        } else {
            failed > 0
        };
        let (verdict, bound) = if refuted {
            (
                "refuted",
                format!("above {:.2} %", 100.0 * lower95(failed, EPISODES)),
            )
        } else {
            (
                "not refuted",
                format!("below {:.2} %", 100.0 * upper95(failed, EPISODES)),
            )
        };
        Ok(Proved {
            holds: !refuted,
            text: format!(
                "{text}: {verdict} in {EPISODES} episodes; it fails in {failed} of them, a rate {bound} at 95 %"
            ),
        })
    }

    fn episodes(&mut self, asked: Played<'a>) -> Result<&[Episode], Diagnostic> {
        let known = self.played.iter().position(|(played, _)| *played == asked);
        let at = match known {
            Some(at) => at,
            None => {
                let start = Start {
                    seed: 1,
                    stream: Purpose::Claim as u64,
                    limit: asked.limit,
                    ..Start::default()
                };
                let episodes =
                    run::play_tree(self.loaded, asked.task, asked.root, EPISODES, start)?;
                self.played.push((asked, episodes));
                self.played.len() - 1
            }
        };
        Ok(self.played.get(at).map_or(&[], |(_, episodes)| episodes))
    }
}
