//! What decisions led to, counted: a model of the process as the trees that grow meet it.

use super::ground::Ground;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Node, Status};
use crate::learn::discount::Discounting;
use crate::learn::process::{Earned, End, Key, Process, World};
use crate::learn::solve::{Outlook, Problem};
use crate::random::Random;
use crate::tree::Runner;
use crate::world::{self, Start};
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// A decision with its outcome.
#[derive(Clone, Copy, Debug)]
struct Taken {
    from: Key,
    choice: usize,
    to: Key,
    reward: f64,
    ticks: u64,
    status: Status,
    end: End,
}

/// The behaviour that drove for a while, and the minterm.
type Visit = (Key, usize);

/// What one episode gave.
#[derive(Debug, Default)]
struct Gathered {
    taken: Vec<Taken>,
    visits: Vec<Visit>,
    ticks: u64,
}

/// How the future counts: as the learner says, or far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// By the learner's discount.
    Learner,
    /// Over a good part of an episode.
    Far,
}

/// One choice in one minterm.
#[derive(Clone, Debug, Default)]
pub struct Cell {
    /// How many decisions are counted.
    pub count: f64,
    reward: f64,
    ticks: f64,
    /// Failures in the first tick.
    refused: f64,
    /// The rows that followed, with how often, and the sums of the factors on what follows in either sight.
    next: Vec<(usize, f64, [f64; 2])>,
}

impl Cell {
    /// The part of its decisions that failed in the first tick.
    pub fn refused(&self) -> f64 {
        self.refused / self.count.max(1.0)
    }

    /// The mean number of ticks of a decision.
    pub fn ticks(&self) -> f64 {
        self.ticks / self.count.max(1.0)
    }

    /// The rows that followed, with how often.
    pub fn next(&self) -> impl Iterator<Item = (usize, f64)> {
        self.next.iter().map(|(row, count, _)| (*row, *count))
    }
}

/// The most that a cell counts: beyond, older decisions make room. Where counts fade everywhere, what is seldom visited
/// is forgotten.
const MOST: f64 = 100.0;

/// The fewest decisions by which a choice is taken into account.
pub const KNOWN: f64 = 4.0;

/// The part of an episode over which rewards count in the far sight.
const FAR: f64 = 0.3;

/// Counted decisions.
#[derive(Clone, Debug)]
pub struct Evidence {
    choices: usize,
    discounts: [Discounting; 2],
    keys: Vec<Key>,
    rows: FxHashMap<Key, usize>,
    cells: Vec<Cell>,
    /// The reward of failing at once: its sum, and how often it was met.
    refused: (f64, f64),
}

/// How often a tree was in each minterm in an episode, on average, by key.
pub type Visits = FxHashMap<Key, f64>;

impl Evidence {
    /// None.
    pub fn new<W>(ground: &Ground<W>) -> Self {
        let far = Discounting {
            discount: crate::ir::task::Discount::PerTime(
                crate::math::exp(-1.0),
                FAR * ground.start.limit as f64,
            ),
            tick: 1.0,
        };
        Self {
            choices: ground.choices.len(),
            discounts: [ground.discounting, far],
            keys: Vec::new(),
            rows: FxHashMap::default(),
            cells: Vec::new(),
            refused: (0.0, 0.0),
        }
    }

    /// The minterms that were met, by row.
    pub fn keys(&self) -> &[Key] {
        &self.keys
    }

    /// The row of a minterm.
    pub fn row(&self, key: Key) -> Option<usize> {
        self.rows.get(&key).copied()
    }

    /// What is known of the choices in a row.
    pub fn cells(&self, row: usize) -> &[Cell] {
        let from = row * self.choices;
        self.cells.get(from..from + self.choices).unwrap_or(&[])
    }

    /// The mean reward of failing at once.
    pub fn refusal(&self) -> f64 {
        self.refused.0 / self.refused.1.max(1.0)
    }

    fn find(&mut self, key: Key) -> usize {
        let next = self.keys.len();
        let row = *self.rows.entry(key).or_insert(next);
        if row == next {
            self.keys.push(key);
            self.cells
                .resize((next + 1) * self.choices, Cell::default());
        }
        row
    }

    /// Plays about `ticks` ticks under a tree, counts what its decisions lead to, and gives the visits. Of the decisions,
    /// a part `explore` is random. `round` keeps the episodes of two calls apart.
    pub fn collect<W: World>(
        &mut self,
        ground: &Ground<W>,
        root: &Node,
        (explore, start): (f64, Start),
        ticks: u64,
    ) -> (Visits, u64) {
        let Ok(runner) = Runner::new(root, ground.world.atoms()) else {
            return (Visits::default(), 0);
        };
        let mut visits = Visits::default();
        let (mut used, mut episodes) = (0, 0);
        while used < ticks {
            // As many as are left at the length of those before.
            let length = used.checked_div(episodes).unwrap_or(start.limit);
            let due = ((ticks - used) / length.max(1)).clamp(1, 200);
            let gathered: Vec<Gathered> = (episodes..episodes + due)
                .into_par_iter()
                .map(|n| {
                    let start = Start {
                        episode: start.episode + n,
                        ..start
                    };
                    let mut process = ground.world.process();
                    Gathered::of(ground, &mut process, &mut runner.clone(), explore, start)
                })
                .collect();
            for gathered in gathered {
                used += gathered.ticks;
                for taken in &gathered.taken {
                    self.count(taken);
                }
                for (key, _) in gathered.visits {
                    *visits.entry(key).or_default() += 1.0;
                }
            }
            episodes += due;
        }
        for count in visits.values_mut() {
            *count /= episodes as f64;
        }
        (visits, used)
    }

    fn count(&mut self, taken: &Taken) {
        // What the limit cut has no outcome.
        if taken.end == End::Cut {
            return;
        }
        let row = self.find(taken.from);
        let next = (taken.end == End::Not).then(|| self.find(taken.to));
        let factors = self.discounts.map(|discount| discount.factor(taken.ticks));
        let refused = taken.status == Status::Failure && taken.ticks == 1;
        if refused {
            self.refused.0 += taken.reward;
            self.refused.1 += 1.0;
        }
        let Some(cell) = self.cells.get_mut(row * self.choices + taken.choice) else {
            return;
        };
        if cell.count >= MOST {
            let keep = (MOST - 1.0) / cell.count;
            cell.count *= keep;
            cell.reward *= keep;
            cell.ticks *= keep;
            cell.refused *= keep;
            for (_, count, factors) in &mut cell.next {
                *count *= keep;
                factors.iter_mut().for_each(|factor| *factor *= keep);
            }
        }
        cell.count += 1.0;
        cell.reward += taken.reward;
        cell.ticks += taken.ticks as f64;
        cell.refused += f64::from(u8::from(refused));
        let Some(next) = next else { return };
        match cell.next.iter_mut().find(|(to, ..)| *to == next) {
            Some((_, count, sums)) => {
                *count += 1.0;
                for (sum, factor) in sums.iter_mut().zip(factors) {
                    *sum += factor;
                }
            }
            None => cell.next.push((next, 1.0, factors)),
        }
    }

    /// The decision problem of the counts.
    pub fn problem(&self, sight: Sight) -> Problem {
        let at = usize::from(sight == Sight::Far);
        let outlook = |cell: &Cell| Outlook {
            reward: cell.reward / cell.count,
            ticks: cell.ticks / cell.count,
            next: cell
                .next
                .iter()
                .map(|(row, _, sums)| (*row, sums.get(at).copied().unwrap_or(0.0) / cell.count))
                .collect(),
        };
        let known = |row: &[Cell]| {
            let choices = row.iter().enumerate();
            let known = choices.filter(|(_, cell)| cell.count >= KNOWN);
            known
                .map(|(choice, cell)| (choice, outlook(cell)))
                .collect()
        };
        Problem {
            states: self.cells.chunks(self.choices.max(1)).map(known).collect(),
            unknown: 0.0,
        }
    }
}

/// The stream of the random choices, apart from those of the world.
const EXPLORATION: u64 = 1 << 40;

impl Gathered {
    fn of<W: World>(
        ground: &Ground<W>,
        process: &mut impl Process,
        runner: &mut Runner,
        explore: f64,
        start: Start,
    ) -> Self {
        let mut random = Random::new(start.seed, EXPLORATION + start.stream, start.episode);
        let mut gathered = Self::default();
        process.start(start);
        runner.reset();
        loop {
            let end = if random.unit() < explore {
                runner.reset();
                let choice = random.below(ground.choices.len() as u64) as usize;
                let Some(behavior) = ground.choices.get(choice) else {
                    return gathered;
                };
                let from = process.key();
                let step = process.decide(*behavior, ground.patience, 0);
                gathered.taken.push(Taken {
                    from,
                    choice,
                    to: step.to,
                    reward: step.reward,
                    ticks: step.ticks,
                    status: step.status,
                    end: step.end,
                });
                step.end
            } else {
                gathered.follow(ground, process, runner)
            };
            if end != End::Not {
                gathered.ticks = process.ticks();
                return gathered;
            }
        }
    }

    /// Ticks the tree until a decision is due. It is counted where one behaviour alone was ticked all along.
    fn follow<W: World>(
        &mut self,
        ground: &Ground<W>,
        process: &mut impl Process,
        runner: &mut Runner,
    ) -> End {
        let from = process.key();
        let patience = ground.patience.unwrap_or(u64::MAX);
        let mut ticks = 0;
        let mut driver: Option<(Id<Behavior>, Status)> = None;
        let mut alone = true;
        let mut earned = Earned::default();
        loop {
            process.begin_tick();
            let mut calls = 0;
            let before = driver;
            runner.tick_key(process.atoms(), |behavior| {
                let status = process.act(behavior);
                calls += 1;
                driver = Some((behavior, status));
                status
            });
            let tick = process.end_tick();
            ticks += 1;
            let same =
                before.is_none_or(|(behavior, _)| driver.is_some_and(|(b, _)| b == behavior));
            alone = alone && calls == 1 && same;
            let due = tick.terminated
                || tick.closed
                || tick.end.is_some()
                || process.key() != from
                || ticks >= patience;
            let Some(reward) = earned.after(&tick, due) else {
                continue;
            };
            let end = match tick.end {
                None => End::Not,
                Some(world::End::On(line)) => End::Terminal(line),
                Some(world::End::Cut) => End::Cut,
            };
            let choice = driver.and_then(|(behavior, _)| {
                ground.choices.iter().position(|choice| *choice == behavior)
            });
            if let (Some(choice), Some((_, status))) = (choice, driver) {
                if self.visits.last() != Some(&(from, choice)) || status == Status::Success {
                    self.visits.push((from, choice));
                }
                if alone {
                    self.taken.push(Taken {
                        from,
                        choice,
                        to: process.key(),
                        reward,
                        ticks,
                        status,
                        end,
                    });
                }
            } else if self.visits.last() != Some(&(from, usize::MAX)) {
                self.visits.push((from, usize::MAX));
            }
            return end;
        }
    }
}
