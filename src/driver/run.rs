//! `btc run`: a tree or a policy in its world.

use super::load::Loaded;
use super::refused::Refused;
use super::text::Text;
use super::{nodes, table, target, world};
use crate::ir::Id;
use crate::ir::task::Task;
use crate::ir::tree::Tree;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Summary;
use crate::policy::Policy;
use crate::report::episodes::Episodes;
use crate::source::Span;
use crate::trial::{play, reached};

/// What to run.
#[derive(Clone, Debug)]
pub enum Subject {
    /// A tree of the program.
    Tree(Id<Tree>),
    /// A policy for a task.
    Policy(Policy, Id<Task>),
}

impl Subject {
    /// The tree of that name.
    ///
    /// # Errors
    /// There is none.
    pub fn tree(loaded: &Loaded, name: &str) -> Result<Self, Refused> {
        target::tree(loaded, name).map(Self::Tree)
    }

    /// The only tree of the program.
    ///
    /// # Errors
    /// There is none, or there are several.
    pub fn only_tree(loaded: &Loaded) -> Result<Self, Refused> {
        target::only_tree(loaded).map(Self::Tree)
    }

    /// The policy in a table, for the only task of the program.
    ///
    /// # Errors
    /// The program has several tasks or none, or something is wrong with the table.
    pub fn policy(loaded: &Loaded, text: Text) -> Result<Self, Refused> {
        let task = target::task_of(loaded, None)?;
        let policy = table::policy(&loaded.program, text, task)?;
        Ok(Self::Policy(policy, task))
    }

    /// Its task.
    pub(super) fn task(&self, loaded: &Loaded) -> Result<Id<Task>, Refused> {
        match self {
            Self::Tree(tree) => target::task_of(loaded, Some(*tree)),
            Self::Policy(_, task) => Ok(*task),
        }
    }
}

/// Runs episodes 0 … n − 1 of a seed, on all threads.
///
/// # Errors
/// The world cannot be built, or something that is used is declared only.
pub fn run(
    loaded: &Loaded,
    subject: &Subject,
    episodes: u64,
    seed: u64,
) -> Result<Episodes, Refused> {
    played(loaded, subject, (episodes, seed), false)
}

/// Runs these episodes as [`run`] does, and counts what the nodes of a tree answer in them.
///
/// # Errors
/// As [`run`].
pub fn counted(
    loaded: &Loaded,
    subject: &Subject,
    episodes: u64,
    seed: u64,
) -> Result<Episodes, Refused> {
    played(loaded, subject, (episodes, seed), true)
}

fn played(
    loaded: &Loaded,
    subject: &Subject,
    (episodes, seed): (u64, u64),
    nodes: bool,
) -> Result<Episodes, Refused> {
    let program = &loaded.program;
    let id = subject.task(loaded)?;
    let task = &program.tasks[id];
    let start = Purpose::Run.start(seed, task.end_after);
    let mut coverage = None;
    let played = match subject {
        Subject::Tree(tree) if nodes => {
            let tree = &program.trees[*tree];
            let counted = reached::tree(program, id, &tree.root, episodes, start);
            counted.map(|(played, answers)| {
                let name = &tree.name.family;
                let found = nodes::of(loaded, name, Span::default(), &tree.root);
                coverage = Some(found.covered(loaded, (name, &tree.root), &answers));
                played
            })
        }
        Subject::Tree(tree) => {
            let root = &program.trees[*tree].root;
            play::tree(program, id, root, episodes, start)
        }
        Subject::Policy(policy, _) => {
            play::policy(program, id, policy, episodes, start).map_err(play::Unplayable::World)
        }
    };
    let played = played.map_err(|why| world::unplayable(loaded, why))?;
    let summary = Summary::of(&played, task.end_on.len());
    let episodes = Episodes::new(program, task, summary);
    Ok(Episodes {
        coverage,
        ..episodes
    })
}
