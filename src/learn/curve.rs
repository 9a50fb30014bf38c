//! The learning curve: the greedy policy evaluated while it is learned.

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

/// The curve as CSV.
pub fn csv(points: &[Point]) -> String {
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
