//! A policy at work, tick by tick.

use super::episode::Controller;
use super::process::{Key, Process};
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::{Id, Program};
use crate::policy::Policy;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// A policy as a controller: its decision in each minterm, and one for all others.
#[derive(Clone, Debug)]
pub struct Greedy {
    choices: Arc<FxHashMap<Key, Id<Behavior>>>,
    unseen: Id<Behavior>,
    last: Option<(Key, Id<Behavior>)>,
}

impl Greedy {
    /// A policy for a task.
    pub fn new(policy: &Policy, program: &Program, task: Id<Task>) -> Self {
        let rows = policy.rows.iter();
        let choices = rows.map(|row| (row.minterm.key(), row.behavior));
        Self::of(choices.collect(), unseen(program, task))
    }

    /// These decisions, and one for all other minterms.
    pub fn of(choices: FxHashMap<Key, Id<Behavior>>, unseen: Id<Behavior>) -> Self {
        Self {
            choices: Arc::new(choices),
            unseen,
            last: None,
        }
    }

    /// The decision in a minterm.
    pub fn choose(&mut self, key: Key) -> Id<Behavior> {
        let behavior = match self.last {
            Some((last, behavior)) if last == key => behavior,
            _ => self.choices.get(&key).copied().unwrap_or(self.unseen),
        };
        self.last = Some((key, behavior));
        behavior
    }
}

impl Controller for Greedy {
    fn reset(&mut self) {
        self.last = None;
    }

    fn tick(&mut self, process: &mut impl Process) {
        let behavior = self.choose(process.key());
        process.act(behavior);
    }

    fn steady(&mut self, process: &impl Process) -> Option<Id<Behavior>> {
        Some(self.choose(process.key()))
    }
}

/// What is done in a minterm that was never seen: what the first learner of the task says, else its first choice.
pub fn unseen(program: &Program, task: Id<Task>) -> Id<Behavior> {
    let mut learners = program.learners.values();
    let learner = learners.find(|learner| learner.task == task);
    learner
        .and_then(|learner| learner.unseen)
        .or(program.tasks[task].choose.first().copied())
        .unwrap_or(Id::new(0))
}
