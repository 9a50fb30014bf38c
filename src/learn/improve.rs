//! A policy improved by simulation: coordinate ascent over its decisions on common seeds.
//!
//! Values stand for all states of a minterm and for what exploration met there, so the greedy policy is not the best of
//! its neighbours. In each minterm that is reached, the other choices that were tried get a few episodes that go through
//! it, then more where they look better, and are taken where the gain is sure.

use super::episode::{Controller, Episode, play};
use super::extract::Decisions;
use super::greedy::Greedy;
use super::process::{Key, Process, World};
use super::q_table::QTable;
use super::statistics::Mean;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::world::Start;
use rayon::prelude::*;
use rustc_hash::{FxHashMap, FxHashSet};
use serde::{Deserialize, Serialize};

/// Episodes that show where the policy goes.
const SHOWN: u64 = 60;
/// Episodes of another choice: at first, and where it looks better.
const STAGES: [usize; 2] = [5, 20];
/// The gain that is asked of each stage, in standard errors.
const SURE: [f64; 2] = [1.0, 2.0];
/// The part of a return, or of its standard deviation, that a change must gain: a policy is not made another for less.
const WORTH: f64 = 0.01;
/// The fewest episodes that go through a minterm.
const FEWEST: usize = 5;
/// The most other choices in a minterm.
const OTHERS: usize = 4;
/// The most times that all minterms are gone through.
const PASSES: usize = 2;

/// What policies are improved by.
#[derive(Debug)]
pub struct Improver<'w, W, H> {
    /// The world.
    pub world: &'w W,
    /// The behaviours that choices count.
    pub choices: &'w [Id<Behavior>],
    /// What is done in a minterm that was not learned.
    pub unseen: Id<Behavior>,
    /// A decision is due after this many ticks without another reason.
    pub patience: Option<u64>,
    /// The start of episode 0.
    pub start: Start,
    /// About how many ticks may be simulated.
    pub effort: u64,
    /// What went wrong in an episode.
    pub harm: H,
}

/// What came of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Improved {
    /// The decisions that were changed.
    pub changed: usize,
    /// The ticks that were simulated.
    pub ticks: u64,
}

/// An episode with the minterms that it went through.
struct Shown {
    episode: Episode,
    met: FxHashSet<Key>,
}

/// A policy that notes where it goes.
struct Noted {
    greedy: Greedy,
    met: FxHashSet<Key>,
}

impl Controller for Noted {
    fn reset(&mut self) {
        self.greedy.reset();
        self.met.clear();
    }

    fn tick(&mut self, process: &mut impl Process) {
        self.met.insert(process.key());
        self.greedy.tick(process);
    }

    fn steady(&mut self, process: &impl Process) -> Option<Id<Behavior>> {
        self.met.insert(process.key());
        self.greedy.steady(process)
    }
}

impl<W: World, H: Fn(&Episode) -> u64 + Sync> Improver<'_, W, H> {
    /// Improves a policy.
    pub fn improve(&self, decisions: &mut Decisions, table: &QTable) -> Improved {
        let mut improved = Improved::default();
        let mut from = 0;
        for _ in 0..PASSES {
            let before = improved.changed;
            let mut shown = self.show(decisions, (0..SHOWN).map(|n| from + n).collect());
            improved.ticks += ticks(&shown);
            for key in by_visits(&shown) {
                if improved.ticks >= self.effort {
                    return improved;
                }
                let through = |shown: &&(u64, Shown)| shown.1.met.contains(&key);
                let base: Vec<&(u64, Shown)> = shown.iter().filter(through).collect();
                if base.len() < FEWEST {
                    continue;
                }
                let Some((choice, used)) = self.better(decisions, table, key, &base) else {
                    continue;
                };
                improved.ticks += used;
                if let (Some(choice), Some(decided)) = (choice, decisions.get_mut(&key)) {
                    decided.choice = choice;
                    improved.changed += 1;
                    // Fresh episodes: the gain on the old ones is in part their luck.
                    from += SHOWN;
                    shown = self.show(decisions, (0..SHOWN).map(|n| from + n).collect());
                    improved.ticks += ticks(&shown);
                }
            }
            from += SHOWN;
            if improved.changed == before {
                break;
            }
        }
        improved
    }

    /// The first other choice in a minterm that is surely better, and the ticks that it took to find out.
    fn better(
        &self,
        decisions: &Decisions,
        table: &QTable,
        key: Key,
        base: &[&(u64, Shown)],
    ) -> Option<(Option<usize>, u64)> {
        let row = table.find(key)?;
        let now = decisions.get(&key)?.choice;
        let cells = table.cells(row).iter().enumerate();
        let mut others: Vec<(usize, f64)> = cells
            .filter(|(choice, cell)| *choice != now && cell.visits > 0)
            .map(|(choice, cell)| (choice, cell.q))
            .collect();
        others.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut used = 0;
        for (choice, _) in others.into_iter().take(OTHERS) {
            let mut changed = decisions.clone();
            if let Some(decided) = changed.get_mut(&key) {
                decided.choice = choice;
            }
            let mut played: Vec<(u64, Shown)> = Vec::new();
            let mut sure = true;
            for (episodes, least) in STAGES.into_iter().zip(SURE) {
                let due = base.iter().take(episodes).skip(played.len());
                let due: Vec<u64> = due.map(|(n, _)| *n).collect();
                let more = self.show(&changed, due);
                used += ticks(&more);
                played.extend(more);
                sure = sure && self.gains(&played, base, least);
                if !sure {
                    break;
                }
            }
            if sure {
                return Some((Some(choice), used));
            }
        }
        Some((None, used))
    }

    /// Whether these episodes gain what a change must, by so many standard errors more, without more harm.
    fn gains(&self, played: &[(u64, Shown)], base: &[&(u64, Shown)], least: f64) -> bool {
        let harms = |shown: &Shown| (self.harm)(&shown.episode) as i64;
        let pairs = || played.iter().zip(base);
        let more: i64 = pairs()
            .map(|((_, own), (_, other))| harms(own) - harms(other))
            .sum();
        let own: Vec<f64> = played.iter().map(|(_, own)| own.episode.total).collect();
        let other: Vec<f64> = base.iter().map(|(_, other)| other.episode.total).collect();
        more <= 0 && is_worth_it(&own, &other, least)
    }

    /// Plays episodes of these numbers.
    fn show(&self, decisions: &Decisions, episodes: Vec<u64>) -> Vec<(u64, Shown)> {
        let choices = decisions
            .iter()
            .filter_map(|(key, decided)| Some((*key, *self.choices.get(decided.choice)?)));
        let greedy = Greedy::of(choices.collect(), self.unseen);
        let make = || self.world.process();
        episodes
            .into_par_iter()
            .map_init(make, |process, n| {
                let start = Start {
                    episode: self.start.episode + n,
                    ..self.start
                };
                let mut noted = Noted {
                    greedy: greedy.clone(),
                    met: FxHashSet::default(),
                };
                let episode = play(process, &mut noted, start, self.patience);
                let met = noted.met;
                (n, Shown { episode, met })
            })
            .collect()
    }
}

/// Whether returns gain over others of the same episodes what a change must, by so many standard errors more. There may be
/// more of the others; they tell what is usual.
pub fn is_worth_it(own: &[f64], other: &[f64], least: f64) -> bool {
    let error = |mean: &Mean| (mean.ci95[1] - mean.mean) / 1.96;
    let gains: Vec<f64> = own
        .iter()
        .zip(other)
        .map(|(own, other)| own - other)
        .collect();
    let (gain, usual) = (Mean::of(&gains), Mean::of(other));
    let spread = error(&usual) * (other.len() as f64).sqrt();
    let worth = WORTH * usual.mean.abs().max(spread);
    gain.mean - least * error(&gain) > worth
}

fn ticks(shown: &[(u64, Shown)]) -> u64 {
    shown.iter().map(|(_, shown)| shown.episode.ticks).sum()
}

/// The minterms by the number of episodes that went through them, the most frequent first.
fn by_visits(shown: &[(u64, Shown)]) -> Vec<Key> {
    let mut counts: FxHashMap<Key, u64> = FxHashMap::default();
    for key in shown.iter().flat_map(|(_, shown)| &shown.met) {
        *counts.entry(*key).or_default() += 1;
    }
    let mut keys: Vec<(Key, u64)> = counts.into_iter().collect();
    keys.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
    keys.into_iter().map(|(key, _)| key).collect()
}
