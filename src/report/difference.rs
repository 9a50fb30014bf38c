//! What a tree or a table decides otherwise than an older one, in the forms that people and tools read.

use super::verdict::{POSSIBLE, ends};
use super::words::{command_data, command_property, counted};
use crate::emit::bt;
use crate::ir::law::Behavior;
use crate::ir::tree::Guard;
use crate::ir::{Id, Program};
use crate::learn::statistics::Mean;
use crate::tree::change::Change;
use serde_json::{Value, json};

/// What two sides are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// Trees.
    Trees,
    /// Policy tables.
    Tables,
}

/// What became of a policy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The trees are the same, or the tables.
    Same(What),
    /// Another shape, which decides the same; how that was proved.
    Equal(String),
    /// Other decisions.
    Other(Vec<Change>),
    /// The same behaviour first in every tick, and others after it within the tick: under which conditions, or, where no
    /// condition over predicates and history describes it, the way to the first such tick.
    Onward(Vec<Change>, String),
    /// Other decisions that no condition over predicates and history describes: the way to the first one.
    Parts(String),
    /// There was too much to explore.
    Undecided(String),
}

/// What both did in simulated episodes with the same starts and dice.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// The number of episodes.
    pub episodes: usize,
    /// The mean return of the old one, and of the new one.
    pub returns: [f64; 2],
    /// What the new one returns more, episode by episode.
    pub gain: Mean,
    /// How many episodes ended badly.
    pub lost: [usize; 2],
}

/// An old and a new policy, and what parts them.
#[derive(Clone, Debug)]
pub struct Difference {
    /// What they are called.
    pub names: [String; 2],
    /// What became of it.
    pub outcome: Outcome,
    /// Whether that is so because of what the predicates compare: some of them exclude one another.
    pub by_predicates: bool,
    /// What both did in their world, if there is one.
    pub figures: Option<Figures>,
    /// The names of what they decide upon and between.
    pub program: Program,
}

impl Difference {
    /// Whether nothing has changed at all.
    pub fn is_same(&self) -> bool {
        matches!(self.outcome, Outcome::Same(_))
    }

    /// Whether the same is decided.
    pub fn is_equal(&self) -> bool {
        matches!(self.outcome, Outcome::Same(_) | Outcome::Equal(_))
    }

    fn behavior(&self, id: Option<Id<Behavior>>) -> String {
        id.map_or_else(
            || "nothing".to_owned(),
            |id| self.program.behaviors[id].name.to_string(),
        )
    }

    /// The condition, the old behaviour and the new one of each change.
    fn rows(&self) -> Vec<[String; 3]> {
        let row = |change: &Change| {
            let mut place = self.ended(change);
            // What holds in every tick needs no words where something is said of the tick.
            if place.is_empty() || change.when != Some(Guard::Const(true)) {
                place.insert(0, self.when(change));
            }
            let place = place.join(", ");
            [place, self.behavior(change.old), self.behavior(change.new)]
        };
        self.changes().iter().map(row).collect()
    }

    fn changes(&self) -> &[Change] {
        match &self.outcome {
            Outcome::Other(changes) | Outcome::Onward(changes, _) => changes,
            _ => &[],
        }
    }

    /// The condition of a change.
    fn when(&self, change: &Change) -> String {
        let when = change.when.as_ref();
        when.map_or_else(
            || "under a condition of more than 2000 literals".to_owned(),
            |when| bt::guard(&self.program, when),
        )
    }

    /// Which tick a change is about, by what was ticked in it before: nothing where that is any.
    fn ended(&self, change: &Change) -> Vec<String> {
        let ended = change.ended.iter().enumerate();
        let ended = ended.map(|(at, (behavior, answer))| {
            let before = match at {
                0 => "in a tick in which ",
                _ => "then ",
            };
            let name = self.behavior(Some(*behavior));
            format!("{before}{name} {}", ends(*answer))
        });
        ended.collect()
    }

    /// What is written below the changes.
    fn detail(&self) -> Option<&str> {
        let detail = match &self.outcome {
            Outcome::Equal(text)
            | Outcome::Onward(_, text)
            | Outcome::Parts(text)
            | Outcome::Undecided(text) => text,
            Outcome::Same(_) | Outcome::Other(_) => "",
        };
        Some(detail).filter(|text| !text.is_empty())
    }

    /// What is written below the headline, besides the changes.
    fn below(&self) -> Option<&str> {
        self.detail().filter(|_| !self.is_equal())
    }

    /// What is said in one line.
    pub fn headline(&self) -> String {
        let [old, new] = &self.names;
        let within = match self.by_predicates {
            true => format!(", consistent with {POSSIBLE}"),
            false => String::new(),
        };
        match &self.outcome {
            Outcome::Same(What::Trees) => format!("same: {new} is the tree of {old}"),
            Outcome::Same(What::Tables) => format!("same: {new} has the rows of {old}"),
            Outcome::Equal(how) => {
                format!(
                    "equal: {new} has another shape than {old} and decides the same, {how}{within}"
                )
            }
            Outcome::Other(changes) => format!(
                "different: {new} decides otherwise than {old} under {}{within}",
                counted(changes.len(), "condition")
            ),
            Outcome::Onward(changes, _) => {
                let under = match changes.len() {
                    0 => String::new(),
                    changes => format!(" under {}", counted(changes, "condition")),
                };
                format!(
                    "different: {new} chooses the same first as {old}, but goes on differently in the same tick{under}{within}"
                )
            }
            Outcome::Parts(_) => format!("different: {new} decides otherwise than {old}"),
            Outcome::Undecided(_) => {
                format!("undecided: there is too much to explore of {old} and {new}")
            }
        }
    }

    /// The figures in one line.
    fn measured(&self) -> Option<String> {
        let figures = self.figures.as_ref()?;
        let [before, after] = figures.returns;
        let gain = &figures.gain;
        let half = (gain.ci95[1] - gain.ci95[0]) / 2.0;
        let [old, new] = figures.lost;
        Some(format!(
            "return {before:.3} → {after:.3} ({:+.3} ± {half:.3}), ended badly {old} → {new} of {} episodes",
            gain.mean, figures.episodes
        ))
    }

    /// For a person at a terminal.
    pub fn human(&self) -> String {
        let mut lines = vec![self.headline()];
        let rows = self.rows();
        lines.extend(
            rows.iter()
                .map(|[when, old, new]| format!("  {when}: {old} → {new}")),
        );
        let below = self.below().unwrap_or_default();
        lines.extend(below.lines().map(|line| format!("  {line}")));
        lines.extend(self.measured().map(|line| format!("  {line}")));
        lines.join("\n") + "\n"
    }

    /// For a comment on a pull request.
    pub fn markdown(&self) -> String {
        let mut text = format!("**{}**\n", self.headline());
        let rows = self.rows();
        if !rows.is_empty() {
            text.push_str("\n| where | was | is now |\n| --- | --- | --- |\n");
            for row in &rows {
                let cells = row
                    .each_ref()
                    .map(|cell| format!("`{}`", cell.replace('|', "\\|")));
                text.push_str(&format!("| {} |\n", cells.join(" | ")));
            }
        }
        if let Some(trace) = self.below() {
            text.push_str(&format!("\n```\n{trace}\n```\n"));
        }
        if let Some(measured) = self.measured() {
            text.push_str(&format!("\n{measured}\n"));
        }
        text
    }

    /// A workflow command for GitHub at a file: an error where the decisions are others, else a notice.
    pub fn github(&self, file: &str) -> String {
        let level = if self.is_equal() { "notice" } else { "error" };
        let place = command_property(file);
        format!(
            "::{level} file={place}::{}\n",
            command_data(self.human().trim_end())
        )
    }

    /// A JSON document.
    pub fn json(&self) -> String {
        let outcome = match &self.outcome {
            Outcome::Same(_) => "same",
            Outcome::Equal(_) => "equal",
            Outcome::Onward(..) => "onward",
            Outcome::Other(_) | Outcome::Parts(_) => "different",
            Outcome::Undecided(_) => "undecided",
        };
        let change = |change: &Change| {
            let ended = change.ended.iter().map(|(behavior, answer)| {
                json!({ "behavior": self.behavior(Some(*behavior)), "status": answer.name() })
            });
            json!({
                "when": self.when(change),
                "ended": ended.collect::<Vec<Value>>(),
                "old": self.behavior(change.old),
                "new": self.behavior(change.new),
            })
        };
        let changes: Vec<Value> = self.changes().iter().map(change).collect();
        let figures = self.figures.as_ref().map(|figures| {
            let [old, new] = figures.returns;
            let [lost, loses] = figures.lost;
            json!({
                "episodes": figures.episodes,
                "return": { "old": old, "new": new },
                "gain": { "mean": figures.gain.mean, "ci95": figures.gain.ci95 },
                "ended_badly": { "old": lost, "new": loses },
            })
        });
        let [old, new] = &self.names;
        let document = json!({
            "old": old,
            "new": new,
            "outcome": outcome,
            "changes": changes,
            "detail": self.detail(),
            "figures": figures,
        });
        format!("{document:#}\n")
    }
}
