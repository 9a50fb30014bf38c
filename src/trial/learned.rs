//! A learned tree on episodes that nothing was chosen by.

use super::play::Ticked;
use crate::ir::tree::{Atom, Node};
use crate::learn::episode::{Controller, play_all};
use crate::learn::experiment::Experiment;
use crate::learn::extract::Decisions;
use crate::learn::process::{Key, Process, World};
use crate::learn::rollout::RollOut;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Summary;
use crate::tree::Runner;
use crate::tree::decanonicalise::Care;
use rustc_hash::FxHashSet;

/// The minterms in which the tree takes the decisions of the policy.
pub fn care_set(care: Care, decisions: &Decisions, met: &RollOut) -> FxHashSet<Key> {
    match care {
        Care::Seen => decisions.keys().copied().collect(),
        Care::Reachable => {
            let next = met.taken.keys().filter_map(|&(.., to)| to);
            let reached = met.starts.keys().copied().chain(next);
            reached.filter(|key| decisions.contains_key(key)).collect()
        }
    }
}

/// The figures of a learned tree on episodes that nothing was chosen by. Ticks outside of the care set are counted.
///
/// # Errors
/// An atom that the world does not know.
pub fn test<W: World>(
    experiment: &Experiment<W>,
    root: &Node,
    care: &FxHashSet<Key>,
    episodes: u64,
    seed: u64,
) -> Result<Summary, Atom> {
    let Experiment { world, task, .. } = experiment;
    let runner = Runner::new(root, world.atoms())?;
    let start = experiment.measured(Purpose::Test, seed);
    let played = play_all(episodes, start, task.patience, || {
        let watched = Watched {
            tree: Ticked(runner.clone()),
            care,
            outside: 0,
        };
        (world.process(), watched)
    });
    Ok(Summary::of(&played, task.end_on.len()))
}

/// A tree whose ticks outside of its care set are counted.
struct Watched<'c> {
    tree: Ticked,
    care: &'c FxHashSet<Key>,
    outside: u64,
}

impl Controller for Watched<'_> {
    fn reset(&mut self) {
        self.tree.reset();
        self.outside = 0;
    }

    fn tick(&mut self, process: &mut impl Process) {
        if !self.care.contains(&process.key()) {
            self.outside += 1;
        }
        self.tree.tick(process);
    }

    fn outside(&self) -> u64 {
        self.outside
    }
}
