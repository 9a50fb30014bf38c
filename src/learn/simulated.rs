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
    /// Testing claims on events.
    Claim = 4,
    /// Finding the best of several runs of learning.
    Validate = 5,
    /// Testing a learned tree, on episodes that nothing was chosen by.
    Test = 6,
    /// Finding the best of a run's proposals.
    Propose = 7,
    /// The search for a smaller tree.
    Simplify = 16,
    /// The second opinion on what that search found.
    Confirm = 17,
    /// The figures of a simplified tree.
    Measure = 18,
}

impl Purpose {
    /// The start of episode 0, from the first list of start lines, cut after `limit` ticks.
    pub fn start(self, seed: u64, limit: u64) -> Start {
        Start {
            seed,
            stream: self as u64,
            limit,
            ..Start::default()
        }
    }
}

/// A simulation to decide over.
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
