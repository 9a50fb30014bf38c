//! What is counted of one choice in one minterm, and what is to be expected of it.

use crate::learn::solve::Outlook;
use crate::trial::decisions::Taken;
use serde::{Deserialize, Serialize};

/// The most that a cell counts: beyond, older decisions make room. Where counts fade everywhere, what is seldom visited
/// is forgotten.
pub(super) const MOST: f64 = 100.0;

/// The fewest decisions by which a choice is taken into account.
pub const KNOWN: f64 = 10.0;

/// The part of the decisions from which on a choice counts as failing at once.
const REFUSES: f64 = 0.8;

/// The ticks for which the hazard of all minterms counts in one.
const ANYWHERE: f64 = 100.0;

/// How the future counts: as the learner says, or far.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// By the learner's discount.
    Learner,
    /// Over a good part of an episode.
    Far,
}

impl Sight {
    /// The figure for this sight.
    fn of(self, [learner, far]: &[f64; 2]) -> f64 {
        match self {
            Self::Learner => *learner,
            Self::Far => *far,
        }
    }
}

/// One choice in one minterm.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Cell {
    /// How many decisions are counted.
    pub count: f64,
    reward: f64,
    /// The sum of the squares of the rewards.
    squares: f64,
    /// The sum of the rewards below zero.
    losses: f64,
    /// Decisions that did harm.
    harms: f64,
    /// Decisions that ended the episode.
    ends: f64,
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

    /// Whether it is known to fail at once, nearly always.
    pub fn refuses(&self) -> bool {
        self.count >= KNOWN && self.refused() >= REFUSES
    }

    /// The mean number of ticks of a decision.
    pub fn ticks(&self) -> f64 {
        self.ticks / self.count.max(1.0)
    }

    /// The rows that followed, with how often.
    pub fn next(&self) -> impl Iterator<Item = (usize, f64)> {
        self.next.iter().map(|(row, count, _)| (*row, *count))
    }

    /// Makes room for another decision where so many are counted.
    pub(super) fn fade(&mut self, most: f64) {
        if self.count < most {
            return;
        }
        let keep = (most - 1.0) / self.count;
        self.count *= keep;
        self.reward *= keep;
        self.squares *= keep;
        self.losses *= keep;
        self.harms *= keep;
        self.ends *= keep;
        self.ticks *= keep;
        self.refused *= keep;
        for (_, count, factors) in &mut self.next {
            *count *= keep;
            factors.iter_mut().for_each(|factor| *factor *= keep);
        }
    }

    /// Counts a decision, with the row that followed and the factors on what follows; `None` at an end.
    pub(super) fn add(&mut self, taken: &Taken, next: Option<(usize, [f64; 2])>) {
        self.count += 1.0;
        self.reward += taken.reward;
        self.losses += taken.reward.min(0.0);
        self.harms += f64::from(u8::from(taken.harmed));
        self.ends += f64::from(u8::from(next.is_none()));
        self.squares += taken.reward * taken.reward;
        self.ticks += taken.ticks as f64;
        self.refused += f64::from(u8::from(taken.is_refused()));
        let Some((next, factors)) = next else { return };
        match self.next.iter_mut().find(|(to, ..)| *to == next) {
            Some((_, count, sums)) => {
                *count += 1.0;
                for (sum, factor) in sums.iter_mut().zip(factors) {
                    *sum += factor;
                }
            }
            None => self.next.push((next, 1.0, factors)),
        }
    }

    /// What is to be expected, if so many decisions more went wrong as any may, and each harm costs what the hazard says.
    pub(super) fn outlook(&self, sight: Sight, doubt: f64, hazard: &Hazard) -> Outlook {
        let n = self.count;
        let ticks = self.ticks / n;
        let plain = (self.reward - self.losses) / n;
        let reward = self.reward - hazard.price * self.harms;
        let supposed = plain + ticks * hazard.losses / hazard.ticks;
        let stays = (1.0 - ticks * hazard.ends / hazard.ticks).clamp(0.0, 1.0);
        let met = n - self.ends;
        let scale = match met > 0.0 {
            true => (met + doubt * stays) / (n + doubt) / met,
            false => 0.0,
        };
        let next = self.next.iter();
        Outlook {
            reward: (reward + doubt * supposed) / (n + doubt),
            ticks,
            next: next
                .map(|(row, _, factors)| (*row, sight.of(factors) * scale))
                .collect(),
        }
    }

    /// Whether a decision was rewarded, or ended the episode without harm, which may have been its aim.
    pub(super) fn is_good(&self) -> bool {
        self.reward > self.losses || self.ends > self.harms
    }

    /// The mean reward.
    pub(super) fn reward(&self) -> f64 {
        self.reward / self.count.max(1.0)
    }

    /// What follows a decision, whatever it is worth.
    pub(super) fn leads(&self, sight: Sight) -> Outlook {
        let n = self.count.max(1.0);
        let next = self.next.iter();
        Outlook {
            reward: 0.0,
            ticks: self.ticks(),
            next: next
                .map(|(row, _, factors)| (*row, sight.of(factors) / n))
                .collect(),
        }
    }

    /// The variance of what one decision is worth.
    pub(super) fn variance(&self, sight: Sight, value: impl Fn(usize) -> f64) -> f64 {
        let n = self.count;
        let rewards = self.squares / n - (self.reward / n) * (self.reward / n);
        let (mut sum, mut squares) = (0.0, 0.0);
        for (row, count, factors) in &self.next {
            let worth = sight.of(factors) / count.max(f64::MIN_POSITIVE) * value(*row);
            sum += count * worth;
            squares += count * worth * worth;
        }
        let follows = squares / n - (sum / n) * (sum / n);
        rewards.max(0.0) + follows.max(0.0)
    }
}

/// What goes wrong in a tick, whatever is done.
pub(super) struct Hazard {
    /// What a harm costs besides what it loses.
    price: f64,
    losses: f64,
    ends: f64,
    ticks: f64,
}

impl Hazard {
    pub(super) fn of(cells: &[Cell], price: f64) -> Self {
        let sum = |figure: fn(&Cell) -> f64| -> f64 { cells.iter().map(figure).sum() };
        Self {
            price,
            losses: sum(|cell| cell.losses) - price * sum(|cell| cell.harms),
            ends: sum(|cell| cell.ends),
            ticks: sum(|cell| cell.ticks),
        }
    }

    /// The hazard here, with some of the hazard anywhere.
    pub(super) fn with(&self, anywhere: &Self) -> Self {
        let some = ANYWHERE / anywhere.ticks.max(1.0);
        Self {
            price: self.price,
            losses: self.losses + some * anywhere.losses,
            ends: self.ends + some * anywhere.ends,
            ticks: self.ticks + ANYWHERE,
        }
    }
}
