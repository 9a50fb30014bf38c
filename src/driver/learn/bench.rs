//! A learner in its world: what learns, rolls out, validates and tests.

use super::super::run::{self, Ticked};
use crate::ir::law::Behavior;
use crate::ir::program::Event;
use crate::ir::task::{Learner, Task};
use crate::ir::tree::{Atom, Node};
use crate::ir::{Id, Program};
use crate::learn::curve::{self, Point};
use crate::learn::discount::Discounting;
use crate::learn::episode::{Controller, play_all};
use crate::learn::extract::{self, Decided, Decisions};
use crate::learn::method::{self, Settings};
use crate::learn::process::Key;
use crate::learn::rollout::{Frozen, RollOut, roll_out};
use crate::learn::schedule::Schedule;
use crate::learn::simulated::{Purpose, Simulated};
use crate::learn::statistics::{Mean, Summary};
use crate::learn::table::Table;
use crate::learn::train::{Counts, Course, train};
use crate::tree::Runner;
use crate::world::{End, Simulation, Simulator, Start};
use rustc_hash::FxHashSet;
use std::sync::{Mutex, PoisonError};

/// One run of learning.
#[derive(Clone, Debug)]
pub(super) struct Run {
    /// Its seed.
    pub seed: u64,
    /// The values, with their evidence.
    pub table: Table,
    /// The policy.
    pub decisions: Decisions,
    /// What was gone through.
    pub counts: Counts,
    /// The learning curve.
    pub points: Vec<Point>,
}

/// A learner in its world.
pub(super) struct Bench<'a> {
    pub program: &'a Program,
    pub learner: &'a Learner,
    pub task: &'a Task,
    pub simulator: &'a Simulator,
    pub episodes: u64,
    /// The fewest decisions by which a minterm counts as learned.
    pub evidence: u64,
    /// What the program claims that the learned tree never does.
    pub never: Vec<Id<Event>>,
}

/// The learner's start lines, in the simulator's lists.
const EXPLORING: usize = 0;

/// The task's start lines.
const OWN: usize = 1;

impl Bench<'_> {
    /// The start of episodes of the task as it is evaluated.
    fn evaluated(&self, purpose: Purpose, seed: u64) -> Start {
        Start {
            seed,
            stream: purpose as u64,
            episode: 0,
            lines: OWN,
            limit: self.task.end_after,
        }
    }

    fn process(&self, start: Start) -> Simulated<'_> {
        Simulated::new(self.simulator.simulation(), self.task, start)
    }

    fn discounting(&self) -> Discounting {
        Discounting {
            discount: self.learner.discount,
            tick: self.program.world.as_ref().map_or(0.1, |world| world.tick),
        }
    }

    /// The number of a behaviour among those of the task.
    pub fn number(&self, behavior: Id<Behavior>) -> Option<usize> {
        self.task
            .choose
            .iter()
            .position(|&choice| choice == behavior)
    }

    fn frozen<'p>(&self, decisions: &'p Decisions) -> Frozen<'p> {
        let unseen = run::unseen(self.program, self.learner.task);
        Frozen {
            decisions,
            unseen: Decided {
                choice: self.number(unseen).unwrap_or(0),
                value: self.learner.initial,
            },
            discounting: self.discounting(),
        }
    }

    /// Learns with one seed. Of a method that proposes a policy a round, the best by validation is taken.
    pub fn learn(&self, seed: u64, progress: impl FnMut()) -> Run {
        let pool = &self.program.pool;
        let learner = self.learner;
        let choices = self.task.choose.len();
        let mut method = method::of(
            learner.method,
            &Settings {
                choices,
                initial: learner.initial,
                rate: Schedule::new(pool, learner.rate),
                seed,
            },
        );
        let course = Course {
            choices,
            episodes: self.episodes,
            explore: Schedule::new(pool, learner.explore),
            discounting: self.discounting(),
            dwell: learner.dwell,
            seed,
        };
        let mut process = self.process(Start {
            seed,
            stream: Purpose::Learn as u64,
            episode: 0,
            lines: EXPLORING,
            limit: learner.episode_ticks,
        });
        let proposes = method.proposes();
        // Rounds are measured on other threads while learning goes on.
        let measured: Mutex<Vec<(Point, Option<Table>)>> = Mutex::default();
        let counts = rayon::in_place_scope(|scope| {
            let measured = &measured;
            let round = |table: &Table, counts: &Counts| {
                let (table, counts) = (table.clone(), *counts);
                scope.spawn(move |_| {
                    let point = self.point(&table, &counts, seed);
                    let mut measured = measured.lock().unwrap_or_else(PoisonError::into_inner);
                    measured.push((point, proposes.then_some(table)));
                });
            };
            train(&mut process, method.as_mut(), &course, round, progress)
        });
        let mut measured = measured
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        measured.sort_by_key(|(point, _)| point.episodes);
        let proposed = |(point, table): &mut (Point, Option<Table>)| {
            table.take().map(|table| (point.total.mean, table))
        };
        let proposals = measured.iter_mut().filter_map(proposed).collect();
        let points = measured.into_iter().map(|(point, _)| point).collect();
        let elected = self.elect(proposals, seed);
        let (decisions, table) = elected.unwrap_or_else(|| {
            let table = method.table();
            (extract::greedy(table, self.evidence), table.clone())
        });
        Run {
            seed,
            decisions,
            table,
            counts,
            points,
        }
    }

    /// A point of the curve, measured on episodes of its own.
    fn point(&self, table: &Table, counts: &Counts, seed: u64) -> Point {
        let decisions = extract::greedy(table, self.evidence);
        let start = self.evaluated(Purpose::Curve, seed);
        let policy = self.frozen(&decisions);
        let met = roll_out(curve::EPISODES, &policy, || self.process(start));
        let ended = met.episodes.iter().filter(|e| e.end != End::Cut);
        let totals: Vec<f64> = met.episodes.iter().map(|e| e.total).collect();
        Point {
            episodes: counts.episodes,
            decisions: counts.decisions,
            ticks: counts.ticks,
            minterms: decisions.len(),
            total: Mean::of(&totals),
            ended: ended.count() as u64,
        }
    }

    /// A policy from the task's own starts: its transitions, and what it is worth.
    pub fn roll_out(
        &self,
        decisions: &Decisions,
        episodes: u64,
        (purpose, seed): (Purpose, u64),
    ) -> (RollOut, Summary) {
        let start = self.evaluated(purpose, seed);
        let policy = self.frozen(decisions);
        let met = roll_out(episodes, &policy, || self.process(start));
        let summary = Summary::of(&met.episodes, self.task.end_on.len());
        (met, summary)
    }

    /// A tree on episodes that nothing was chosen by. Ticks outside of the care set are counted.
    ///
    /// # Errors
    /// An atom that the world does not know.
    pub fn test(
        &self,
        root: &Node,
        care: &FxHashSet<Key>,
        episodes: u64,
        seed: u64,
    ) -> Result<Summary, Atom> {
        let runner = Runner::new(root, self.simulator.atoms())?;
        let start = self.evaluated(Purpose::Test, seed);
        let played = play_all(episodes, start, self.task.patience, || {
            let watched = Watched {
                tree: Ticked(runner.clone()),
                care,
                outside: 0,
            };
            (self.simulator.simulation(), watched)
        });
        Ok(Summary::of(&played, self.task.end_on.len()))
    }
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

    fn tick(&mut self, simulation: &mut Simulation) {
        if !self.care.contains(&simulation.key()) {
            self.outside += 1;
        }
        self.tree.tick(simulation);
    }

    fn outside(&self) -> u64 {
        self.outside
    }
}
