//! One run of learning, with one seed.

use super::curve::{self, Point};
use super::experiment::{EXPLORING, Experiment};
use super::extract::{self, Decisions};
use super::method::{self, Method, Settings};
use super::process::World;
use super::q_table::QTable;
use super::record::Record;
use super::rollout::roll_out;
use super::schedule::Schedule;
use super::simulated::Purpose;
use super::statistics::Mean;
use super::train::{Counts, Course, Trained, train};
use crate::checkpoint::{Keeper, Part};
use crate::ir::task::Objective;
use crate::world::{End, Start};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// One run of learning.
#[derive(Clone, Debug, Serialize, Deserialize)]
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

/// A run as it is kept: its end, or the way there.
#[derive(Serialize, Deserialize)]
enum Kept {
    Half(Trained, Vec<Round>, Vec<u8>),
    Whole(Run),
}

/// The end of a round: the policy there, and its place on the curve once that is measured.
#[derive(Clone, Serialize, Deserialize)]
struct Round {
    counts: Counts,
    /// Dropped when nothing is asked of it any more.
    table: Option<QTable>,
    point: Option<Point>,
}

/// The rounds of a run so far.
struct Rounds(Mutex<Vec<Round>>);

impl Rounds {
    fn lock(&self) -> MutexGuard<'_, Vec<Round>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<W: World> Experiment<'_, W> {
    /// Learns with `count` seeds from `seed` on, on all threads. `episode` is called after each episode of any run.
    pub fn learn_all(
        &self,
        (seed, count): (u64, u64),
        keeper: &dyn Keeper,
        episode: impl Fn() + Sync,
    ) -> Vec<Run> {
        (0..count)
            .into_par_iter()
            .map(|n| self.learn(seed.wrapping_add(n), keeper, &episode))
            .collect()
    }

    /// Learns with one seed. Of a method that proposes a policy in each round, the best by validation is taken.
    pub fn learn(&self, seed: u64, keeper: &dyn Keeper, mut episode: impl FnMut()) -> Run {
        let part = Part::new(keeper, format!("seed-{seed}"));
        let (mut trained, mut rounds, state) = match part.resume() {
            Some(Kept::Whole(run)) => {
                (0..run.counts.episodes).for_each(|_| episode());
                return run;
            }
            Some(Kept::Half(trained, rounds, state)) => (trained, rounds, Some(state)),
            None => (Trained::new(seed), Vec::new(), None),
        };
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
        };
        if !state.is_none_or(|state| method.restore(&state)) {
            (trained, rounds) = (Trained::new(seed), Vec::new());
        }
        (0..trained.counts.episodes).for_each(|_| episode());
        let mut process = self.world.process();
        let proposes = method.proposes();
        // Rounds are measured on other threads while learning goes on.
        let rounds = Rounds(Mutex::new(rounds));
        rayon::in_place_scope(|scope| {
            let rounds = &rounds;
            let measure = |at: usize, table: QTable, counts: Counts| {
                scope.spawn(move |_| {
                    let point = self.point(&table, &counts, seed);
                    if let Some(round) = rounds.lock().get_mut(at) {
                        round.point = Some(point);
                        round.table = round.table.take().filter(|_| proposes);
                    }
                });
            };
            let unmeasured: Vec<(usize, Round)> =
                rounds.lock().iter().cloned().enumerate().collect();
            for (at, round) in unmeasured {
                if let (None, Some(table)) = (round.point, round.table) {
                    measure(at, table, round.counts);
                }
            }
            let round = |table: &QTable, counts: &Counts| {
                let mut rounds = rounds.lock();
                rounds.push(Round {
                    counts: *counts,
                    table: Some(table.clone()),
                    point: None,
                });
                measure(rounds.len() - 1, table.clone(), *counts);
            };
            let after = |method: &dyn Method, trained: &Trained| {
                episode();
                part.keep(|| Kept::Half(trained.clone(), rounds.lock().clone(), method.state()));
            };
            train(
                &mut process,
                method.as_mut(),
                &course,
                &mut trained,
                round,
                after,
            );
        });
        let mut rounds = rounds
            .0
            .into_inner()
            .unwrap_or_else(PoisonError::into_inner);
        let proposed = |round: &mut Round| Some((round.point?.total.mean, round.table.take()?));
        let proposals = rounds.iter_mut().filter_map(proposed).collect();
        let points = rounds.into_iter().filter_map(|round| round.point).collect();
        let elected = self.elect_proposal(proposals, seed);
        let (decisions, table) = elected.unwrap_or_else(|| {
            let table = method.table();
            (extract::greedy(table, self.evidence), table.clone())
        });
        let run = Run {
            seed,
            decisions,
            table,
            counts: trained.counts,
            record: trained.record,
            points,
        };
        part.save(|| Kept::Whole(run.clone()));
        run
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
}
