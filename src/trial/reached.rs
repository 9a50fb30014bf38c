//! How often the nodes of a tree are reached in its episodes, and what they answer.

use super::play::{Ticked, Unplayable, ready};
use super::test::{Answers, count};
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::tree::{Node, Status};
use crate::ir::{Id, Program};
use crate::learn::episode::{Controller, Episode, play_each};
use crate::learn::process::Process;
use crate::tree::Runner;
use crate::tree::tick::Surroundings;
use crate::world::Start;

/// A tree as a controller that counts, by the place of each node in pre-order, since its last reset.
#[derive(Clone, Debug)]
struct Counting {
    tree: Runner,
    counts: Vec<Answers>,
}

impl Controller for Counting {
    fn reset(&mut self) {
        self.tree.reset();
        self.counts.fill(Answers::default());
    }

    fn tick(&mut self, process: &mut impl Process) {
        self.tree.tick_in(&mut Counted {
            process,
            counts: &mut self.counts,
        });
    }
}

/// What a counted tick meets.
struct Counted<'a, P> {
    process: &'a mut P,
    counts: &'a mut [Answers],
}

impl<P: Process> Surroundings for Counted<'_, P> {
    fn matches(&mut self, word: usize, mask: u64, value: u64) -> bool {
        let atoms = self.process.atoms();
        let word = match word {
            0 => atoms as u64,
            1 => (atoms >> 64) as u64,
            _ => 0,
        };
        word & mask == value
    }

    fn behavior(&mut self, behavior: Id<Behavior>) -> Status {
        self.process.act(behavior)
    }

    fn answered(&mut self, node: usize, status: Status) {
        if let Some(answers) = self.counts.get_mut(node) {
            answers.count(status);
        }
    }
}

/// Plays n episodes under a tree from that of `start` on, on all threads, and counts for each of its nodes, in pre-order.
///
/// # Errors
/// As [`ready`].
pub fn tree(
    program: &Program,
    task: Id<Task>,
    root: &Node,
    episodes: u64,
    start: Start,
) -> Result<(Vec<Episode>, Vec<Answers>), Unplayable> {
    let (simulator, Ticked(tree)) = ready(program, task, root)?;
    let patience = program.tasks[task].patience;
    let counting = Counting {
        tree,
        counts: vec![Answers::default(); count(root)],
    };
    let make = || (simulator.simulation(), counting.clone());
    let played = play_each(episodes, start, patience, make, |it| it.counts.clone());
    let mut counts = counting.counts;
    let mut all = Vec::with_capacity(played.len());
    for (episode, own) in played {
        all.push(episode);
        for (count, own) in counts.iter_mut().zip(own) {
            count.add(&own);
        }
    }
    Ok((all, counts))
}
