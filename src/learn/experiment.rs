//! A learner with the world that it learns in: what trains policies and measures them.

use super::average;
use super::discount::Discounting;
use super::extract::{Decided, Decisions};
use super::greedy;
use super::process::World;
use super::rollout::{Frozen, RollOut, roll_out};
use super::simulated::Purpose;
use super::statistics::Summary;
use crate::ir::program::Event;
use crate::ir::task::{ClaimKind, Learner, Objective, Task, TreeRef};
use crate::ir::{Id, Program};
use crate::world::{BuildError, Simulator, Start};

/// A learner with the world that it learns in.
#[derive(Clone, Debug)]
pub struct Experiment<'a, W = Simulator> {
    /// The program.
    pub program: &'a Program,
    /// The learner.
    pub learner: &'a Learner,
    /// The task of the learner.
    pub task: &'a Task,
    /// The world.
    pub world: W,
    /// Episodes of a run.
    pub episodes: u64,
    /// The fewest decisions by which a minterm counts as learned.
    pub evidence: u64,
    /// The events that the program claims never to happen under the learned tree.
    pub(super) never: Vec<Id<Event>>,
}

/// The learner's start lines, in the simulator's lists.
pub(super) const EXPLORING: usize = 0;

/// The task's start lines.
const OWN: usize = 1;

impl<'a> Experiment<'a> {
    /// The experiment of a learner in the world of its program, with its own number of episodes if `episodes` is `None`.
    ///
    /// # Errors
    /// The world cannot be built.
    pub fn new(
        program: &'a Program,
        id: Id<Learner>,
        episodes: Option<u64>,
        evidence: u64,
    ) -> Result<Self, BuildError> {
        let learner = &program.learners[id];
        let task = &program.tasks[learner.task];
        let starts: [&[_]; 2] = [&learner.start, &task.start];
        let world = Simulator::build(program, learner.task, &starts, &[])?;
        Ok(Self::within(world, program, id, (episodes, evidence)))
    }
}

impl<'a, W> Experiment<'a, W> {
    /// The experiment of a learner in any world, whose atoms are those of the learner's task.
    pub fn within(
        world: W,
        program: &'a Program,
        id: Id<Learner>,
        (episodes, evidence): (Option<u64>, u64),
    ) -> Self {
        let learner = &program.learners[id];
        Self {
            program,
            learner,
            task: &program.tasks[learner.task],
            world,
            episodes: episodes.unwrap_or(learner.episodes),
            evidence,
            never: never(program, id),
        }
    }

    /// The name of one of the behaviours that there are to choose from.
    pub fn choice_name(&self, choice: usize) -> String {
        let behavior = self.task.choose.get(choice);
        behavior.map_or_else(String::new, |id| {
            self.program.behaviors[*id].name.to_string()
        })
    }

    /// The start of the episodes that measure a policy or a tree: those of the task.
    pub fn measured(&self, purpose: Purpose, seed: u64) -> Start {
        Start {
            lines: OWN,
            ..purpose.start(seed, self.task.end_after)
        }
    }

    /// The length of a tick in seconds; without a world in the program, time is in ticks.
    pub fn tick(&self) -> f64 {
        self.program.world.as_ref().map_or(1.0, |world| world.tick)
    }

    /// How future reward counts.
    pub fn discounting(&self) -> Discounting {
        let tick = self.tick();
        Discounting {
            discount: match self.learner.objective {
                Objective::Discounted(discount) => discount,
                Objective::Average(_) => average::discount(tick),
            },
            tick,
        }
    }

    pub(super) fn frozen<'p>(&'p self, decisions: &'p Decisions) -> Frozen<'p> {
        let unseen = greedy::unseen(self.program, self.learner.task);
        let choice = self.task.choose.iter().position(|&choice| choice == unseen);
        Frozen {
            decisions,
            unseen: Decided {
                choice: choice.unwrap_or(0),
                value: self.learner.initial,
            },
            discounting: self.discounting(),
            choices: &self.task.choose,
            patience: self.task.patience,
        }
    }

    /// The starts of exploring episodes: those of the learner.
    pub fn exploring(&self) -> Start {
        Start {
            lines: EXPLORING,
            limit: self.learner.episode_ticks,
            ..Start::default()
        }
    }

    /// The events that the program claims never to happen under the learned tree.
    pub fn never(&self) -> &[Id<Event>] {
        &self.never
    }
}

impl<W: World> Experiment<'_, W> {
    /// Plays a policy from the task's own starts: what it met, and the figures of its episodes.
    pub fn roll_out(
        &self,
        decisions: &Decisions,
        episodes: u64,
        (purpose, seed): (Purpose, u64),
    ) -> (RollOut, Summary) {
        let start = self.measured(purpose, seed);
        let policy = self.frozen(decisions);
        let met = roll_out(episodes, &policy, start, || self.world.process());
        let summary = Summary::of(&met.episodes, self.task.end_on.len());
        (met, summary)
    }
}

/// The events that the program claims never to happen under what a learner learns.
fn never(program: &Program, learner: Id<Learner>) -> Vec<Id<Event>> {
    let claims = program.claims.iter();
    claims
        .filter_map(|claim| match &claim.kind {
            ClaimKind::Never(occurrence) if claim.tree == TreeRef::Learned(learner) => {
                Some(occurrence.event)
            }
            _ => None,
        })
        .collect()
}
