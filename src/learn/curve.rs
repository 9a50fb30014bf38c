//! The learning curve: the greedy policy evaluated while it is learned.

use super::bootstrap::{interquartile_mean, interval95};
use super::statistics::Mean;

/// One point of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Episodes learned from so far.
    pub episodes: u64,
    /// Decisions completed so far.
    pub decisions: u64,
    /// Ticks simulated so far.
    pub ticks: u64,
    /// Minterms in which a decision was completed so far.
    pub minterms: usize,
    /// The return of greedy episodes on seeds of their own.
    pub total: Mean,
    /// How many of these an event ended.
    pub ended: u64,
}

/// How many points a curve has at most.
pub const POINTS: u64 = 20;

/// How many greedy episodes a point is measured by.
pub const EPISODES: u64 = 20;

/// Whether a point is due after this episode of so many.
pub fn due(episode: u64, episodes: u64) -> bool {
    let points = POINTS.min(episodes.max(1));
    let passed = |n: u64| u128::from(n) * u128::from(points) / u128::from(episodes.max(1));
    passed(episode + 1) > passed(episode)
}

/// The curves of several seeds as CSV: point by point where there is one, else the interquartile mean over the seeds with
/// its bootstrap interval, and the return of each.
pub fn csv(curves: &[(u64, Vec<Point>)]) -> String {
    match curves {
        [(_, points)] => single(points),
        _ => several(curves),
    }
}

fn single(points: &[Point]) -> String {
    let mut text =
        String::from("episodes,decisions,ticks,minterms,return,return_low,return_high,ended\n");
    for point in points {
        let [low, high] = point.total.ci95;
        text.push_str(&format!(
            "{},{},{},{},{},{},{},{}\n",
            point.episodes,
            point.decisions,
            point.ticks,
            point.minterms,
            point.total.mean,
            low,
            high,
            point.ended,
        ));
    }
    text
}

fn several(curves: &[(u64, Vec<Point>)]) -> String {
    let mut text = String::from("episodes,return,return_low,return_high");
    for (seed, _) in curves {
        text.push_str(&format!(",seed_{seed}"));
    }
    text.push('\n');
    let points = curves.iter().map(|(_, points)| points.len()).min();
    for at in 0..points.unwrap_or(0) {
        let of: Vec<&Point> = curves
            .iter()
            .filter_map(|(_, points)| points.get(at))
            .collect();
        let totals: Vec<f64> = of.iter().map(|point| point.total.mean).collect();
        let episodes = of.first().map_or(0, |point| point.episodes);
        let [low, high] = interval95(&totals);
        text.push_str(&format!(
            "{episodes},{},{low},{high}",
            interquartile_mean(&totals)
        ));
        for total in totals {
            text.push_str(&format!(",{total}"));
        }
        text.push('\n');
    }
    text
}
