//! How often each line of `end on` ended episodes, with a bound on its true share.

use crate::learn::binomial::{lower95, upper95};
use crate::learn::statistics::Summary;
use serde::Serialize;

/// The share of episodes that one end may take before a headline says so.
const OFTEN: f64 = 0.01;

/// The episodes that one line of `end on` ended.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ended {
    /// The name of the line.
    #[serde(skip)]
    pub name: String,
    /// How many there were.
    pub count: u64,
    /// Of how many episodes.
    #[serde(skip)]
    pub episodes: u64,
    /// The mean reward of the transitions that they ended with.
    pub reward: f64,
    /// The bound below the true share of episodes that end like this, with 95 % confidence.
    pub lower95: f64,
    /// The bound above it.
    pub upper95: f64,
}

impl Ended {
    /// Those of each line, by the lines' names.
    pub fn all(names: &[String], summary: &Summary) -> Vec<Self> {
        let figures = names.iter().zip(summary.ended.iter().zip(&summary.paid));
        let of = |(name, (&count, &reward)): (&String, (&u64, &f64))| Self {
            name: name.clone(),
            count,
            episodes: summary.episodes,
            reward,
            lower95: lower95(count, summary.episodes),
            upper95: upper95(count, summary.episodes),
        };
        figures.map(of).collect()
    }

    /// Whether the line is a goal: the transitions that it ended were rewarded on average. Of the share of episodes that
    /// reach a goal the lower bound is of interest, of any other end the upper one; of an end that was never seen there
    /// is only an upper one.
    pub fn is_goal(&self) -> bool {
        self.reward > 0.0
    }

    /// What a headline says of ends that are no goals and are not seldom; `whose` names the episodes.
    pub fn often(ends: &[Self], whose: &str) -> impl Iterator<Item = String> {
        let bad = ends.iter().filter(|end| !end.is_goal());
        bad.filter_map(move |end| {
            let share = end.count as f64 / end.episodes.max(1) as f64;
            let said = || format!("{:.1} % of {whose} ended by {}", 100.0 * share, end.name);
            (share > OFTEN).then(said)
        })
    }

    /// The bound that is of interest, in words.
    pub fn bound(&self) -> String {
        match self.is_goal() {
            true => format!("at least {:.2} % (95 %)", 100.0 * self.lower95),
            false => format!("at most {:.2} % (95 %)", 100.0 * self.upper95),
        }
    }
}
