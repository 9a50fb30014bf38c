//! Figures of a sample.

use super::episode::Episode;
use crate::world::End;
use serde::Serialize;

/// The 97.5 % point of the standard normal distribution.
const Z: f64 = 1.959_963_984_540_054;

/// A mean with its 95 % interval (normal approximation: mean ± 1.96 s/√n).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
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
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// The number of episodes.
    pub episodes: u64,
    /// The sum of their ticks.
    pub ticks: u64,
    /// The return of an episode.
    pub total: Mean,
    /// For each event, how often it fired, and its rate in 1000 ticks of an episode.
    pub events: Vec<(u64, Mean)>,
    /// The number of episodes that each line of `end on` ended.
    pub ended: Vec<u64>,
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
        Self {
            episodes: episodes.len() as u64,
            ticks: episodes.iter().map(|episode| episode.ticks).sum(),
            total: Mean::of(&totals),
            events: (0..events)
                .map(|event| {
                    let rates: Vec<f64> = episodes
                        .iter()
                        .map(|e| 1000.0 * count(event, e) as f64 / e.ticks.max(1) as f64)
                        .collect();
                    let all = episodes.iter().map(|e| count(event, e)).sum();
                    (all, Mean::of(&rates))
                })
                .collect(),
            ended: (0..ends)
                .map(|line| {
                    let hit = |e: &&Episode| e.end == End::On(line);
                    episodes.iter().filter(hit).count() as u64
                })
                .collect(),
            cut: episodes.iter().filter(|e| e.end == End::Cut).count() as u64,
            outside: episodes.iter().map(|episode| episode.outside).sum(),
        }
    }
}
