//! Episodes under a tree or a policy.

use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::tree::{Atom, Node, Status};
use crate::ir::{Id, Program};
use crate::learn::episode::{Controller, Episode, play_all};
use crate::learn::greedy::Greedy;
use crate::learn::process::Process;
use crate::policy::Policy;
use crate::tree::Runner;
use crate::tree::atoms::atoms;
use crate::world::{BuildError, Simulator, Start};

/// Why a tree or a policy cannot be played.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unplayable {
    /// The world cannot be built.
    World(BuildError),
    /// The tree ticks a behaviour that is declared only.
    Declared(Id<Behavior>),
    /// The tree asks an atom that the world does not know.
    Unknown(Atom),
}

impl From<BuildError> for Unplayable {
    fn from(error: BuildError) -> Self {
        Self::World(error)
    }
}

/// A tree as a controller.
#[derive(Clone, Debug)]
pub struct Ticked(pub Runner);

impl Ticked {
    /// Ticks the tree; `note` gets every behaviour that it ticks, with its answer.
    pub fn tick_noting(
        &mut self,
        process: &mut impl Process,
        mut note: impl FnMut(Id<Behavior>, Status),
    ) {
        self.0.tick_key(process.atoms(), |behavior| {
            let status = process.act(behavior);
            note(behavior, status);
            status
        });
    }

    /// Goes on with a tick whose steady behaviour has answered; `note` gets every behaviour that is ticked after it.
    pub fn answered_noting(
        &mut self,
        process: &mut impl Process,
        status: Status,
        mut note: impl FnMut(Id<Behavior>, Status),
    ) {
        self.0.answered(process.atoms(), status, |behavior| {
            let status = process.act(behavior);
            note(behavior, status);
            status
        });
    }
}

impl Controller for Ticked {
    fn reset(&mut self) {
        self.0.reset();
    }

    fn tick(&mut self, process: &mut impl Process) {
        self.tick_noting(process, |_, _| {});
    }

    #[inline]
    fn steady(&mut self, process: &impl Process) -> Option<Id<Behavior>> {
        self.0.settled(process.atoms())
    }

    fn answered(&mut self, process: &mut impl Process, _: Id<Behavior>, status: Status) {
        self.answered_noting(process, status, |_, _| {});
    }
}

/// The world of a task from the task's own starts, which knows the atoms that a tree asks.
///
/// # Errors
/// The world cannot be built.
pub fn world(program: &Program, task: Id<Task>, root: &Node) -> Result<Simulator, BuildError> {
    let start: &[_] = &program.tasks[task].start;
    let asked: Vec<Atom> = atoms(root).into_iter().collect();
    Simulator::build(program, task, &[start], &asked)
}

/// A tree, ready to be ticked in its world.
///
/// # Errors
/// The world cannot be built, or the tree ticks a behaviour that is declared only.
pub fn ready(
    program: &Program,
    task: Id<Task>,
    root: &Node,
) -> Result<(Simulator, Ticked), Unplayable> {
    let simulator = world(program, task, root)?;
    let mut declared = None;
    root.visit_behaviors(&mut |id| {
        if program.behaviors[id].law.is_none() {
            declared = declared.or(Some(id));
        }
    });
    if let Some(behavior) = declared {
        return Err(Unplayable::Declared(behavior));
    }
    let runner = Runner::new(root, simulator.atoms()).map_err(Unplayable::Unknown)?;
    Ok((simulator, Ticked(runner)))
}

/// Plays n episodes under a tree from that of `start` on, on all threads.
///
/// # Errors
/// As [`ready`].
pub fn tree(
    program: &Program,
    task: Id<Task>,
    root: &Node,
    episodes: u64,
    start: Start,
) -> Result<Vec<Episode>, Unplayable> {
    let (simulator, tree) = ready(program, task, root)?;
    let patience = program.tasks[task].patience;
    Ok(play_all(episodes, start, patience, || {
        (simulator.simulation(), tree.clone())
    }))
}

/// Plays episodes 0 … n − 1 under a policy, on all threads.
///
/// # Errors
/// The world cannot be built.
pub fn policy(
    program: &Program,
    id: Id<Task>,
    policy: &Policy,
    episodes: u64,
    start: Start,
) -> Result<Vec<Episode>, BuildError> {
    let task = &program.tasks[id];
    let simulator = Simulator::build(program, id, &[&task.start], &[])?;
    let greedy = Greedy::new(policy, program, id);
    Ok(play_all(episodes, start, task.patience, || {
        (simulator.simulation(), greedy.clone())
    }))
}
