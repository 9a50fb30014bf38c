//! The decision process over the simulator.

use super::process::{self, Key, Process, Step};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::world::{End, Simulation, Start};

/// What an episode's random numbers are for; the seeds of one purpose never meet those of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Learning.
    Learn = 0,
    /// The greedy episodes that show the transitions of a policy.
    RollOut = 1,
    /// The points of a learning curve.
    Curve = 2,
    /// `btc run`.
    Run = 3,
    /// Testing what is claimed of events.
    Claim = 4,
    /// Which of several runs of learning is the best.
    Validate = 5,
    /// What the tree that was taken is worth, on episodes that nothing was chosen by.
    Test = 6,
    /// Which of a run's proposals is the best.
    Propose = 7,
}

/// A simulation that is decided over.
#[derive(Clone, Debug)]
pub struct Simulated<'a> {
    simulation: Simulation<'a>,
    choices: &'a [Id<Behavior>],
    patience: Option<u64>,
    start: Start,
}

impl<'a> Simulated<'a> {
    /// The process of a task from these starts.
    pub fn new(simulation: Simulation<'a>, task: &'a Task, start: Start) -> Self {
        Self {
            simulation,
            choices: &task.choose,
            patience: task.patience,
            start,
        }
    }
}

impl Process for Simulated<'_> {
    fn start(&mut self, episode: u64) {
        self.simulation.start(Start {
            episode,
            ..self.start
        });
    }

    fn key(&self) -> Key {
        self.simulation.key()
    }

    fn decide(&mut self, choice: usize, dwell: u64) -> Step {
        let behavior = self.choices.get(choice).or(self.choices.first());
        let Some(&behavior) = behavior else {
            // The checker lets no task through that has nothing to choose from.
            return Step {
                to: self.key(),
                status: crate::ir::tree::Status::Failure,
                reward: 0.0,
                ticks: 1,
                end: process::End::Cut,
            };
        };
        let transition = self.simulation.run_option(behavior, self.patience, dwell);
        Step {
            to: transition.key,
            status: transition.status,
            reward: transition.reward,
            ticks: transition.ticks,
            end: match transition.end {
                None => process::End::Not,
                Some(End::On(line)) => process::End::Terminal(line),
                Some(End::Cut) => process::End::Cut,
            },
        }
    }

    fn events(&self) -> &[u64] {
        self.simulation.counts()
    }
}
