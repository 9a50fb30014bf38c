//! The learning curve: the greedy policy evaluated while it is learned.

use super::bootstrap::{interquartile_mean, interval95};
use super::statistics::Mean;
use serde::{Deserialize, Serialize};

/// One point of the curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Episodes learned from so far.
    pub episodes: u64,
    /// Decisions completed so far.
    pub decisions: u64,
    /// Ticks simulated so far.
    pub ticks: u64,
    /// Minterms in which a decision was completed so far.
    pub minterms: usize,
    /// The return of greedy episodes on seeds that only curves use.
    pub total: Mean,
    /// The number of these that an event ended.
    pub ended: u64,
}

/// The most points of a curve.
pub const POINTS: u64 = 20;

/// The greedy episodes that measure a point.
pub const EPISODES: u64 = 20;

/// Whether a point is due after episode number `episode` of `episodes`.
pub fn due(episode: u64, episodes: u64) -> bool {
    let points = POINTS.min(episodes.max(1));
    let passed = |n: u64| u128::from(n) * u128::from(points) / u128::from(episodes.max(1));
    passed(episode + 1) > passed(episode)
}

/// A point of the curves of several seeds.
#[derive(Clone, Debug, PartialEq)]
pub struct Pooled {
    /// Episodes learned from so far, by each seed.
    pub episodes: u64,
    /// Ticks simulated so far, by the slowest seed.
    pub ticks: u64,
    /// Minterms in which a decision was completed so far, by the seed that has the most.
    pub minterms: usize,
    /// The return of each seed.
    pub totals: Vec<f64>,
    /// Their interquartile mean, with its bootstrap interval over the seeds.
    pub total: Mean,
}

/// Several curves as one, up to the end of the shortest.
pub fn pooled(curves: &[(u64, Vec<Point>)]) -> Vec<Pooled> {
    let shortest = curves.iter().map(|(_, points)| points.len()).min();
    (0..shortest.unwrap_or(0))
        .map(|at| {
            let of = || curves.iter().filter_map(|(_, points)| points.get(at));
            let totals: Vec<f64> = of().map(|point| point.total.mean).collect();
            Pooled {
                episodes: of().map(|point| point.episodes).next().unwrap_or(0),
                ticks: of().map(|point| point.ticks).max().unwrap_or(0),
                minterms: of().map(|point| point.minterms).max().unwrap_or(0),
                total: Mean {
                    mean: interquartile_mean(&totals),
                    ci95: interval95(&totals),
                },
                totals,
            }
        })
        .collect()
}
