//! A learner with the world that it learns in: what trains policies and measures them.

use super::average;
use super::curve::{self, Point};
use super::discount::Discounting;
use super::extract::{self, Decided, Decisions};
use super::greedy;
use super::method::{self, Settings};
use super::process::World;
use super::q_table::QTable;
use super::record::Record;
use super::rollout::{Frozen, RollOut, roll_out};
use super::schedule::Schedule;
use super::simulated::Purpose;
use super::statistics::{Mean, Summary};
use super::train::{Counts, Course, train};
use crate::ir::program::Event;
use crate::ir::task::{ClaimKind, Learner, Objective, Task, TreeRef};
use crate::ir::{Id, Program};
use crate::world::{BuildError, End, Simulator, Start};
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};

/// One run of learning.
#[derive(Clone, Debug)]
pub struct Run {
    /// Its seed.
    pub seed: u64,
    /// The action values, with their evidence.
    pub table: QTable,
    /// The policy.
    pub decisions: Decisions,
    /// How much was simulated.
    pub counts: Counts,
    /// What was met in training.
    pub record: Record,
    /// The learning curve.
    pub points: Vec<Point>,
}

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
const EXPLORING: usize = 0;

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

    fn frozen<'p>(&'p self, decisions: &'p Decisions) -> Frozen<'p> {
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
    /// Learns with `count` seeds from `seed` on, on all threads. `episode` is called after each episode of any run.
    pub fn learn_all(&self, seed: u64, count: u64, episode: impl Fn() + Sync) -> Vec<Run> {
        let seeds = seed..seed.saturating_add(count);
        seeds
            .into_par_iter()
            .map(|seed| self.learn(seed, &episode))
            .collect()
    }

    /// Learns with one seed. Of a method that proposes a policy in each round, the best by validation is taken.
    pub fn learn(&self, seed: u64, episode: impl FnMut()) -> Run {
        let pool = &self.program.pool;
        let learner = self.learner;
        let choices = self.task.choose.len();
        let mut method = method::of(
            learner.method,
            &Settings {
                choices,
                initial: learner.initial,
                rate: Schedule::new(pool, learner.rate),
                average: matches!(learner.objective, Objective::Average(_)),
                seed,
            },
        );
        let course = Course {
            choices: &self.task.choose,
            patience: self.task.patience,
            start: Start {
                lines: EXPLORING,
                ..Purpose::Learn.start(seed, learner.episode_ticks)
            },
            episodes: self.episodes,
            explore: Schedule::new(pool, learner.explore),
            discounting: self.discounting(),
            dwell: learner.dwell,
            seed,
        };
        let mut process = self.world.process();
        let proposes = method.proposes();
        // Rounds are measured on other threads while learning goes on.
        let measured: Mutex<Vec<(Point, Option<QTable>)>> = Mutex::default();
        let (counts, record) = rayon::in_place_scope(|scope| {
            let measured = &measured;
            let round = |table: &QTable, counts: &Counts| {
                let (table, counts) = (table.clone(), *counts);
                scope.spawn(move |_| {
                    let point = self.point(&table, &counts, seed);
                    let mut measured = measured.lock().unwrap_or_else(PoisonError::into_inner);
                    measured.push((point, proposes.then_some(table)));
                });
            };
            train(&mut process, method.as_mut(), &course, round, episode)
        });
        let mut measured = measured
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        measured.sort_by_key(|(point, _)| point.episodes);
        let proposed = |(point, table): &mut (Point, Option<QTable>)| {
            table.take().map(|table| (point.total.mean, table))
        };
        let proposals = measured.iter_mut().filter_map(proposed).collect();
        let points = measured.into_iter().map(|(point, _)| point).collect();
        let elected = self.elect_proposal(proposals, seed);
        let (decisions, table) = elected.unwrap_or_else(|| {
            let table = method.table();
            (extract::greedy(table, self.evidence), table.clone())
        });
        Run {
            seed,
            decisions,
            table,
            counts,
            record,
            points,
        }
    }

    /// A point of the curve, measured on episodes of its own.
    fn point(&self, table: &QTable, counts: &Counts, seed: u64) -> Point {
        let decisions = extract::greedy(table, self.evidence);
        let start = self.measured(Purpose::Curve, seed);
        let policy = self.frozen(&decisions);
        let met = roll_out(curve::EPISODES, &policy, start, || self.world.process());
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
