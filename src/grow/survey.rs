//! Finding out what each choice does wherever a way is known to: what nobody tried is worth a try, and so is the way there.
//!
//! Where a reward needs many behaviours in a row, each of which fails where it is not its turn, neither random decisions nor
//! excursions get to it. So the counts are read as a problem in which what is little known pays as well (Brafman and
//! Tennenholtz 2002), the more the less anybody was there. Its policy is followed: it goes to the edge of what is known, and once a
//! reward is found, along the ways to that, so that they are known well.

use super::cell::Cell;
use super::evidence::{Evidence, Sight};
use super::ground::Ground;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::learn::episode::Controller;
use crate::learn::process::{Key, Process, World};
use crate::learn::simulated::Purpose;
use crate::learn::solve::{Outlook, Problem};
use crate::world::Start;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// The part of the effort that it may take.
const PART: f64 = 0.15;
/// The plans that it is divided into.
const PLANS: u64 = 24;
/// How often an episode tries what is little known in one minterm, and what is known.
const TRIES: [u32; 2] = [2, 24];
/// So many tries of what is known one counts for that fails.
const FAILS: u32 = 6;
/// The decisions by which a choice is known well enough, and those by which a minterm has been met often.
const ENOUGH: f64 = 4.0;
const OFTEN: f64 = 20.0;
/// The number of the first collection of a survey.
const FIRST: u64 = 1 << 17;
/// What promises so little is worth no further plan, in parts of what an unknown choice is worth.
const LITTLE: f64 = 0.01;

/// Counts what little known choices do, where nothing good has been met so far; gives the ticks. What is counted so shifts what a
/// minterm stands for, away from where a policy goes: one that gets somewhere is improved better without.
pub(super) fn survey<W: World>(ground: &Ground<W>, evidence: &mut Evidence, effort: u64) -> u64 {
    let mut cells = (0..evidence.keys().len()).flat_map(|row| evidence.cells(row));
    if cells.any(Cell::is_good) {
        return 0;
    }
    let most = (effort as f64 * PART) as u64;
    let mut ticks = 0;
    for number in 0..PLANS {
        let plan = Plan::new(evidence);
        ticks += plan.work;
        if ticks >= most || plan.promised(evidence) < LITTLE {
            break;
        }
        let surveyor = Surveyor {
            choices: ground.choices.to_vec(),
            plan: Arc::new(plan),
            tried: FxHashMap::default(),
            now: None,
        };
        let from = match number % 3 {
            2 => ground.exploring,
            _ => ground.start,
        };
        let start = Start {
            seed: ground.seed,
            stream: Purpose::Count as u64,
            episode: (1 << 40) + ((FIRST + number) << 20),
            ..from
        };
        ticks += evidence
            .collect(ground, &surveyor, (0.0, start), most / PLANS)
            .1;
    }
    ticks
}

/// What is to be tried in each minterm, in this order.
struct Plan {
    /// The choices by minterm, what promises most first, each with whether it is known.
    orders: FxHashMap<Key, Vec<(usize, bool)>>,
    values: Vec<f64>,
    work: u64,
}

/// What the choices of a minterm are worth that are little known: 1 for one that nobody tried where hardly anybody was.
fn novelties(cells: &[Cell]) -> impl Iterator<Item = f64> {
    let met: f64 = cells.iter().map(|cell| cell.count).sum();
    let rare = 1.0 / (1.0 + met / OFTEN).sqrt();
    (cells.iter()).map(move |cell| rare * (1.0 - cell.count / ENOUGH).max(0.0))
}

impl Plan {
    fn new(evidence: &Evidence) -> Self {
        let rows = 0..evidence.keys().len();
        let rewards = rows
            .clone()
            .flat_map(|row| evidence.cells(row))
            .map(Cell::reward);
        let [least, greatest] = rewards.fold([0.0, 0.0], |[least, greatest]: [f64; 2], reward| {
            [least.min(reward), greatest.max(reward)]
        });
        // What pays most pays as much as what nobody knows.
        let scale = if greatest > 0.0 { greatest } else { -least };
        let states = rows.map(|row| {
            let cells = evidence.cells(row);
            let known = cells.iter().enumerate();
            let known = known.filter(|(_, cell)| cell.count >= 1.0 && !cell.refuses());
            let known = known.map(|(choice, cell)| {
                let reward = cell.reward() / scale.max(f64::MIN_POSITIVE);
                let leads = Outlook {
                    reward: reward.clamp(-1.0, 1.0),
                    ..cell.leads(Sight::Far)
                };
                (choice, leads)
            });
            let tries = Outlook {
                reward: novelties(cells).fold(0.0, f64::max),
                ticks: 1.0,
                next: Vec::new(),
            };
            known.chain([(cells.len(), tries)]).collect()
        });
        let problem = Problem {
            states: states.collect(),
            unknown: 1.0,
        };
        let values = problem.estimate_from(problem.unsolved()).values;
        let rows = evidence.keys().iter().zip(&problem.states).enumerate();
        let orders = rows.map(|(row, (key, state))| {
            let cells = evidence.cells(row);
            let fresh = novelties(cells).enumerate();
            let fresh = fresh.filter(|(_, novelty)| *novelty > 0.0);
            let fresh = fresh.map(|(choice, novelty)| (novelty, choice, false));
            let known = state.iter().filter(|(choice, _)| *choice < cells.len());
            let known =
                known.map(|(choice, outlook)| (problem.worth(outlook, &values), *choice, true));
            let mut all: Vec<(f64, usize, bool)> = fresh.chain(known).collect();
            all.sort_by(|(a, ..), (b, ..)| b.total_cmp(a));
            let order = all.into_iter().map(|(_, choice, known)| (choice, known));
            (*key, order.collect())
        });
        Self {
            orders: orders.collect(),
            work: problem.work(),
            values,
        }
    }

    /// What an episode promises, where it begins.
    fn promised(&self, evidence: &Evidence) -> f64 {
        let begun = |key: &Key| evidence.begun(*key);
        let all: f64 = evidence.keys().iter().map(begun).sum();
        let rows = evidence.keys().iter().zip(&self.values);
        rows.map(|(key, value)| begun(key) * value).sum::<f64>() / all.max(1.0)
    }
}

/// Follows a plan.
#[derive(Clone)]
struct Surveyor {
    choices: Vec<Id<Behavior>>,
    plan: Arc<Plan>,
    /// How often each choice was tried in each minterm of the episode.
    tried: FxHashMap<(Key, usize), u32>,
    /// What runs.
    now: Option<(Key, usize)>,
}

impl Surveyor {
    fn decide(&mut self, key: Key) -> usize {
        let all = self.choices.len();
        let plan = self.plan.clone();
        let order = match plan.orders.get(&key) {
            Some(order) => order.clone(),
            None => (0..all).map(|choice| (choice, false)).collect(),
        };
        let tries = |choice: usize| self.tried.get(&(key, choice)).copied().unwrap_or(0);
        let due = order.iter().find(|(choice, is_known)| {
            let [unknown, known] = TRIES;
            tries(*choice) < if *is_known { known } else { unknown }
        });
        let choice = due.map(|(choice, _)| *choice);
        // Where all has been tried, what was tried least.
        let choice = choice.or_else(|| (0..all).min_by_key(|choice| tries(*choice)));
        let choice = choice.unwrap_or(0);
        *self.tried.entry((key, choice)).or_default() += 1;
        choice
    }
}

impl Controller for Surveyor {
    fn reset(&mut self) {
        self.tried.clear();
        self.now = None;
    }

    fn tick(&mut self, process: &mut impl Process) {
        let key = process.key();
        let choice = match self.now {
            Some((at, choice)) if at == key => choice,
            _ => self.decide(key),
        };
        let Some(behavior) = self.choices.get(choice) else {
            return;
        };
        let status = process.act(*behavior);
        if status == Status::Failure {
            *self.tried.entry((key, choice)).or_default() += FAILS;
        }
        self.now = (status == Status::Running).then_some((key, choice));
    }
}
