//! The figures of episodes.

use super::coverage::Coverage;
use super::ends::{EndLine, Ended};
use super::json::{self, Named};
use super::words::{self, numbered};
use crate::ir::Program;
use crate::ir::task::Task;
use crate::learn::rate;
use crate::learn::statistics::{Mean, Summary};
use serde::{Serialize, Serializer};

/// The figures of episodes, with the names of the events and of what ends an episode.
#[derive(Clone, Debug, PartialEq)]
pub struct Episodes {
    /// The figures.
    pub summary: Summary,
    /// The names of the events, as in [`Summary::events`].
    pub events: Vec<String>,
    /// The names of what ends episodes, as in [`Summary::ended`].
    pub ends: Vec<EndLine>,
    /// What the nodes of the tree have answered, where that was asked.
    pub coverage: Option<Coverage>,
}

#[derive(Serialize)]
struct Document<'a> {
    episodes: u64,
    ticks: u64,
    r#return: &'a Mean,
    #[serde(skip_serializing_if = "Option::is_none")]
    worst: Option<Worst>,
    events: Named<Rate>,
    ended: Named<End>,
    #[serde(skip_serializing_if = "Option::is_none")]
    coverage: Option<serde_json::Value>,
}

/// The episode with the lowest return, and how many return far less than the others.
#[derive(Serialize)]
struct Worst {
    episode: u64,
    r#return: f64,
    apart: u64,
}

#[derive(Serialize)]
struct Rate {
    count: u64,
    per_1000_ticks: f64,
    ci95: [f64; 2],
}

/// A line of `end on`, or the limit.
#[derive(Serialize)]
#[serde(untagged)]
enum End {
    On(Ended),
    Limit { count: u64 },
}

impl Episodes {
    /// The figures of episodes of a task.
    pub fn new(program: &Program, task: &Task, summary: Summary) -> Self {
        let events = program.events.values();
        Self {
            summary,
            events: events.map(|event| event.name.to_string()).collect(),
            ends: EndLine::all(program, task),
            coverage: None,
        }
    }

    /// The figures of what ended episodes.
    pub fn ended(&self) -> Vec<Ended> {
        Ended::all(&self.ends, &self.summary)
    }

    fn document(&self) -> Document<'_> {
        let summary = &self.summary;
        let rate = |(name, rate): (&String, &rate::Rate)| {
            let rate = Rate {
                count: rate.count,
                per_1000_ticks: rate.per_1000,
                ci95: rate.ci95,
            };
            (name.clone(), rate)
        };
        let limit = End::Limit { count: summary.cut };
        let ends = self.ended().into_iter();
        let ends = ends.map(|ended| (ended.name.clone(), End::On(ended)));
        Document {
            episodes: summary.episodes,
            ticks: summary.ticks,
            r#return: &summary.total,
            worst: summary.worst.map(|worst| Worst {
                episode: worst.episode,
                r#return: worst.total,
                apart: worst.apart,
            }),
            events: self.events.iter().zip(&summary.events).map(rate).collect(),
            ended: ends.chain([("limit".to_owned(), limit)]).collect(),
            coverage: self.coverage.as_ref().map(Coverage::json),
        }
    }

    /// The figures as a JSON document.
    pub fn json(&self) -> String {
        json::document(self)
    }

    /// The figures for a person.
    pub fn human(&self) -> String {
        let summary = &self.summary;
        let [low, high] = summary.total.ci95;
        let ended = self.ended();
        let ends = ended.iter().map(|ended| &ended.name);
        let names = self.events.iter().chain(ends);
        // As wide as the names of most programs; wider only where a name is longer.
        let width = names.map(|name| name.len()).max().unwrap_or(0).max(16);
        let mut text = format!(
            "{}, {}\n\n  {:<width$} {:>9.3}   95 % [{:.3}, {:.3}]\n",
            numbered(summary.episodes, "episode"),
            numbered(summary.ticks, "tick"),
            "return",
            summary.total.mean,
            low,
            high
        );
        if let Some(worst) = summary.worst {
            text.push_str(&format!(
                "  {:<width$} {:>9.3}   in episode {}",
                "worst", worst.total, worst.episode
            ));
            if let Some(apart) = words::apart(summary) {
                text.push_str(&format!("; {apart}"));
            }
            text.push('\n');
        }
        for (name, rate) in self.events.iter().zip(&summary.events) {
            let [low, high] = rate.ci95;
            text.push_str(&format!(
                "  {name:<width$} {:>9.3}   95 % [{low:.3}, {high:.3}] in 1000 ticks, {} in all\n",
                rate.per_1000, rate.count
            ));
        }
        text.push('\n');
        for ended in ended {
            text.push_str(&format!(
                "  {:<width$} {:>9}   of {}, {}\n",
                ended.name,
                ended.count,
                numbered(ended.episodes, "episode"),
                ended.bound()
            ));
        }
        text.push_str(&format!("  {:<width$} {:>9}\n", "limit", summary.cut));
        if let Some(coverage) = &self.coverage {
            text.push_str(&format!("\n{}", coverage.table()));
        }
        text
    }
}

impl Serialize for Episodes {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.document().serialize(serializer)
    }
}
