//! Figures of a sample.

use super::apart::Worst;
use super::episode::Episode;
use super::rate::Rate;
use crate::world::End;
use serde::{Deserialize, Serialize};

/// The 97.5 % point of the standard normal distribution.
pub(super) const Z: f64 = 1.959_963_984_540_054;

/// What rounding may make of two returns whose rewards are the same and are added up in another order, in parts of a return.
pub const ROUNDING: f64 = 1e-12;

/// A mean with its 95 % interval (normal approximation: mean ± 1.96 s/√n).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mean {
    /// The mean.
    pub mean: f64,
    /// The interval.
    pub ci95: [f64; 2],
}

impl Mean {
    /// The mean of a sample; zero for an empty one.
    pub fn of(sample: &[f64]) -> Self {
        let n = sample.len() as f64;
        if sample.is_empty() {
            return Self::default();
        }
        let mean = sample.iter().sum::<f64>() / n;
        let squares: f64 = sample.iter().map(|x| (x - mean) * (x - mean)).sum();
        let half = if sample.len() > 1 {
            Z * (squares / (n - 1.0) / n).sqrt()
        } else {
            0.0
        };
        Self {
            mean,
            ci95: [mean - half, mean + half],
        }
    }
}

/// The figures of several episodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// The number of episodes.
    pub episodes: u64,
    /// The sum of their ticks.
    pub ticks: u64,
    /// The return of an episode.
    pub total: Mean,
    /// The lowest one; `None` if nothing was played.
    pub worst: Option<Worst>,
    /// How often each event happened.
    pub events: Vec<Rate>,
    /// The number of episodes that each line of `end on` ended.
    pub ended: Vec<u64>,
    /// The mean reward of the transitions that these ended with; zero for a line that ended none.
    pub paid: Vec<f64>,
    /// The number that the tick limit cut.
    pub cut: u64,
    /// Ticks outside the care set.
    pub outside: u64,
}

impl Summary {
    /// The figures of episodes of a task with `ends` lines of `end on`.
    pub fn of(episodes: &[Episode], ends: usize) -> Self {
        let totals: Vec<f64> = episodes.iter().map(|episode| episode.total).collect();
        let events = episodes.first().map_or(0, |episode| episode.events.len());
        let count =
            |event: usize, episode: &Episode| episode.events.get(event).copied().unwrap_or(0);
        let ended = |line| episodes.iter().filter(move |e| e.end == End::On(line));
        Self {
            episodes: episodes.len() as u64,
            ticks: episodes.iter().map(|episode| episode.ticks).sum(),
            total: Mean::of(&totals),
            worst: Worst::of(&totals),
            events: (0..events)
                .map(|event| Rate::of(episodes.iter().map(|e| (count(event, e), e.ticks))))
                .collect(),
            ended: (0..ends).map(|line| ended(line).count() as u64).collect(),
            paid: (0..ends)
                .map(|line| {
                    let paid: Vec<f64> = ended(line).map(|e| e.last).collect();
                    Mean::of(&paid).mean
                })
                .collect(),
            cut: episodes.iter().filter(|e| e.end == End::Cut).count() as u64,
            outside: episodes.iter().map(|episode| episode.outside).sum(),
        }
    }
}
