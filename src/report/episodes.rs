//! The figures of episodes.

use super::json::{self, Named};
use super::words::end_names;
use crate::ir::Program;
use crate::ir::task::Task;
use crate::learn::binomial::upper95;
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
    pub ends: Vec<String>,
}

#[derive(Serialize)]
struct Document<'a> {
    episodes: u64,
    ticks: u64,
    r#return: &'a Mean,
    events: Named<Rate>,
    ended: Named<Ended>,
}

#[derive(Serialize)]
struct Rate {
    count: u64,
    per_1000_ticks: f64,
    ci95: [f64; 2],
}

#[derive(Serialize)]
struct Ended {
    count: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    upper95: Option<f64>,
}

impl Episodes {
    /// The figures of episodes of a task.
    pub fn new(program: &Program, task: &Task, summary: Summary) -> Self {
        let events = program.events.values();
        Self {
            summary,
            events: events.map(|event| event.name.to_string()).collect(),
            ends: end_names(program, task),
        }
    }

    fn document(&self) -> Document<'_> {
        let summary = &self.summary;
        let rate = |(name, (count, rate)): (&String, &(u64, Mean))| {
            let rate = Rate {
                count: *count,
                per_1000_ticks: rate.mean,
                ci95: rate.ci95,
            };
            (name.clone(), rate)
        };
        let ended = |(name, count): (&String, &u64)| {
            let ended = Ended {
                count: *count,
                upper95: Some(upper95(*count, summary.episodes)),
            };
            (name.clone(), ended)
        };
        let limit = Ended {
            count: summary.cut,
            upper95: None,
        };
        let ends = self.ends.iter().zip(&summary.ended).map(ended);
        Document {
            episodes: summary.episodes,
            ticks: summary.ticks,
            r#return: &summary.total,
            events: self.events.iter().zip(&summary.events).map(rate).collect(),
            ended: ends.chain([("limit".to_owned(), limit)]).collect(),
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
        let mut text = format!(
            "{} episodes, {} ticks\n\n  {:<16} {:>9.3}   95 % [{:.3}, {:.3}]\n",
            summary.episodes, summary.ticks, "return", summary.total.mean, low, high
        );
        for (name, (count, rate)) in self.events.iter().zip(&summary.events) {
            let [low, high] = rate.ci95;
            text.push_str(&format!(
                "  {name:<16} {:>9.3}   95 % [{low:.3}, {high:.3}] in 1000 ticks, {count} in all\n",
                rate.mean
            ));
        }
        text.push('\n');
        for (name, count) in self.ends.iter().zip(&summary.ended) {
            let upper = 100.0 * upper95(*count, summary.episodes);
            text.push_str(&format!(
                "  {name:<16} {count:>9}   of {} episodes, at most {upper:.2} % (95 %)\n",
                summary.episodes
            ));
        }
        text.push_str(&format!("  {:<16} {:>9}\n", "limit", summary.cut));
        text
    }
}

impl Serialize for Episodes {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.document().serialize(serializer)
    }
}
