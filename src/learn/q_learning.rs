//! Tabular Q-learning (Watkins 1989; paper, section II-B) over options.

use super::process::{End, Process};
use super::schedule::Schedule;
use super::table::Table;
use crate::ir::task::Discount;
use crate::random::Random;

/// How it learns.
#[derive(Clone, Copy, Debug)]
pub struct Settings<'a> {
    /// How many behaviours there are to choose from.
    pub choices: usize,
    /// How many episodes.
    pub episodes: u64,
    /// The step size.
    pub rate: Schedule<'a>,
    /// The probability of a random choice.
    pub explore: Schedule<'a>,
    /// How future reward counts.
    pub discount: Discount,
    /// The length of a tick in seconds.
    pub tick: f64,
    /// The value of a pair that was never tried.
    pub initial: f64,
    /// Ticks for which a choice is kept.
    pub dwell: u64,
    /// The seed of the exploration.
    pub seed: u64,
}

/// What a learner has counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Episodes begun.
    pub episodes: u64,
    /// Decisions completed.
    pub decisions: u64,
    /// Ticks simulated.
    pub ticks: u64,
}

/// Learns a table. `after` sees it after every episode, with the number of the episode, and stops the learning by
/// returning false.
pub fn learn(
    process: &mut impl Process,
    settings: &Settings,
    mut after: impl FnMut(u64, &Table, &Counts) -> bool,
) -> (Table, Counts) {
    let mut table = Table::new(settings.choices, settings.initial);
    let mut counts = Counts::default();
    let mut random = Random::new(settings.seed, EXPLORATION, 0);
    for episode in 0..settings.episodes {
        let progress = episode as f64 / settings.episodes as f64;
        counts.episodes += 1;
        process.start(episode);
        let mut row = table.row(process.key());
        loop {
            let visits: u64 = table.cells(row).iter().map(|cell| cell.visits).sum();
            let epsilon = settings.explore.at(visits as f64, progress);
            let choice = match table.greedy(row) {
                Some(best) if random.unit() >= epsilon => best,
                _ => random.below(settings.choices as u64) as usize,
            };
            let step = process.decide(choice, settings.dwell);
            counts.decisions += 1;
            counts.ticks += step.ticks;
            let next = table.row(step.to);
            let future = if matches!(step.end, End::Terminal(_)) {
                0.0
            } else {
                discount(settings, step.ticks) * table.best_value(next)
            };
            let target = step.reward + future;
            if let Some(cell) = table.cell_mut(row, choice) {
                cell.visits += 1;
                let rate = settings.rate.at(cell.visits as f64, progress);
                cell.q += rate * (target - cell.q);
                cell.squares += target * target;
            }
            if step.end != End::Not {
                break;
            }
            row = next;
        }
        if !after(episode, &table, &counts) {
            break;
        }
    }
    (table, counts)
}

/// The stream of the exploration's random numbers, apart from those of the world.
const EXPLORATION: u64 = u64::MAX;

fn discount(settings: &Settings, ticks: u64) -> f64 {
    match settings.discount {
        Discount::PerDecision(factor) => factor,
        Discount::PerTime(factor, span) => {
            crate::math::pow(factor, ticks as f64 * settings.tick / span)
        }
    }
}
