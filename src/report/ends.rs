//! How often each line of `end on` ended episodes, with a bound on its true share.

use super::words::end_names;
use crate::ir::Program;
use crate::ir::task::Task;
use crate::learn::binomial::{lower95, upper95};
use crate::learn::statistics::Summary;
use serde::Serialize;

/// The share of episodes that one end may take before a headline says so.
const OFTEN: f64 = 0.01;

/// A line of `end on`.
#[derive(Clone, Debug, PartialEq)]
pub struct EndLine {
    /// Its name.
    pub name: String,
    /// What the reward says that it is worth.
    pub worth: Option<f64>,
}

impl EndLine {
    /// Those of a task.
    pub fn all(program: &Program, task: &Task) -> Vec<Self> {
        let names = end_names(program, task).into_iter();
        let lines = names.zip(task.worths(program));
        lines.map(|(name, worth)| Self { name, worth }).collect()
    }
}

/// The episodes that one line of `end on` ended.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Ended {
    /// The name of the line.
    #[serde(skip)]
    pub name: String,
    /// Whether the line is a goal: the reward says so, or else the transitions that it ended were rewarded on average. Of the share of
    /// episodes that reach a goal the lower bound is of interest, of any other end the upper one.
    #[serde(skip)]
    pub is_goal: bool,
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
    /// Those of each line.
    pub fn all(lines: &[EndLine], summary: &Summary) -> Vec<Self> {
        let figures = lines.iter().zip(summary.ended.iter().zip(&summary.paid));
        let of = |(line, (&count, &reward)): (&EndLine, (&u64, &f64))| Self {
            name: line.name.clone(),
            is_goal: line.worth.unwrap_or(reward) > 0.0,
            count,
            episodes: summary.episodes,
            reward,
            lower95: lower95(count, summary.episodes),
            upper95: upper95(count, summary.episodes),
        };
        figures.map(of).collect()
    }

    /// What a headline says of ends that are no goals and are not seldom; `whose` names the episodes.
    pub fn often(ends: &[Self], whose: &str) -> impl Iterator<Item = String> {
        let bad = ends.iter().filter(|end| !end.is_goal);
        bad.filter_map(move |end| {
            let share = end.count as f64 / end.episodes.max(1) as f64;
            let said = || format!("{:.1} % of {whose} ended by {}", 100.0 * share, end.name);
            (share > OFTEN).then(said)
        })
    }

    /// The bound that is of interest, in words.
    pub fn bound(&self) -> String {
        match self.is_goal {
            true => format!("at least {:.2} % (95 %)", 100.0 * self.lower95),
            false => format!("at most {:.2} % (95 %)", 100.0 * self.upper95),
        }
    }
}
