//! Suggested predicates in words and as JSON.

use super::json;
use super::tuned::compared;
use super::words::{counted, line, numbered};
use crate::ir::task::Task;
use crate::ir::{Id, Name, Program};
use crate::trial::duel::Duel;
use serde::Serialize;

/// The least gain that is worth a predicate more, as a part of the return.
const WORTH: f64 = 0.01;

/// A condition that was learned with.
#[derive(Clone, Debug)]
pub struct Tried {
    /// Its predicate as an item of the language; `None` if the program has it.
    pub item: Option<String>,
    /// What its predicate is called.
    pub name: String,
    /// The condition; `None` if the program has the predicate.
    pub condition: Option<String>,
    /// What counts promised.
    pub promised: f64,
    /// Whether the tree that was learned with it asks it.
    pub asked: bool,
    /// The nodes of the tree without it, and of the tree with it.
    pub nodes: [usize; 2],
    /// The trees without it and with it on fresh seeds.
    pub duel: Duel,
}

impl Tried {
    /// Whether it is worth a predicate more: the tree asks it, and returns clearly more.
    pub fn holds(&self) -> bool {
        let before = self.duel.before.total.mean.abs();
        self.asked && self.duel.is_won() && self.duel.gain.mean >= WORTH * before
    }
}

/// What was suggested, to be reported.
#[derive(Clone, Debug)]
pub struct Report<'a> {
    /// The program.
    pub program: &'a Program,
    /// The task.
    pub task: Id<Task>,
    /// The seed.
    pub seed: u64,
    /// How much can be read in the world.
    pub readings: usize,
    /// How many conditions were looked at.
    pub conditions: usize,
    /// How many of them were played with.
    pub played: usize,
    /// Those that were learned with.
    pub tried: Vec<Tried>,
}

impl Report<'_> {
    /// What holds, the greatest gain first; before it one that the program declares, if its gain may be as great.
    fn held(&self) -> Vec<&Tried> {
        let mut held: Vec<&Tried> = self.tried.iter().filter(|tried| tried.holds()).collect();
        held.sort_by(|a, b| b.duel.gain.mean.total_cmp(&a.duel.gain.mean));
        let bounds = |tried: &Tried| tried.duel.gain.ci95;
        if let Some([least, _]) = held.first().map(|best| bounds(best)) {
            let declared = |tried: &&Tried| {
                let [_, most] = bounds(tried);
                tried.item.is_none() && most >= least
            };
            if let Some(at) = held.iter().position(declared) {
                held.get_mut(..=at).unwrap_or_default().rotate_right(1);
            }
        }
        held
    }

    /// The report for a person.
    pub fn human(&self) -> String {
        let mut text = format!(
            "{}, {}: {} tried, {} learned with to the end\n\n",
            counted(self.readings, "reading"),
            counted(self.conditions, "condition"),
            self.played,
            self.tried.len()
        );
        for tried in &self.tried {
            let verdict = match tried.holds() {
                true => "better",
                false => "not better",
            };
            let condition = tried.condition.as_ref().unwrap_or(&tried.name);
            let mut said = format!("{condition}: {}", compared(&tried.duel));
            if !tried.asked {
                said.push_str("; the tree does not ask it");
            }
            let [without, with] = tried.nodes;
            let without = numbered(without as u64, "node");
            said.push_str(&format!("; {without} without it, {with} with it"));
            text.push_str(&line(verdict, &said));
            text.push('\n');
            let (worse, better) = tried.duel.ended;
            if worse + better > 0 {
                let ended = format!(
                    "{worse} episodes are ended to its loss by `end on`, {better} no longer"
                );
                text.push_str(&line("", &ended));
                text.push('\n');
            }
        }
        let held = self.held();
        let Some(best) = held.first() else {
            text.push_str("nothing is suggested: no condition that was tried helps this learner\n");
            return text;
        };
        let task = &self.program.tasks[self.task].name;
        match &best.item {
            Some(item) => text.push_str(&format!(
                "\nadd to the program:\n\n{item}\nand to `observe` of task `{task}`: `{}`\n",
                best.name
            )),
            None => text.push_str(&format!(
                "\nadd to `observe` of task `{task}`: `{}`\n",
                best.name
            )),
        }
        if best
            .condition
            .as_ref()
            .is_some_and(|text| text.contains("<="))
        {
            text.push_str(
                "Write `tune(…)` around the number, and `btc tune` looks for a better one.\n",
            );
        }
        if held.len() > 1 {
            text.push_str(
                "The others that are better were tried without this one: ask again when it is in the program.\n",
            );
        }
        text
    }

    /// The report as a JSON document.
    pub fn json(&self) -> String {
        let task = &self.program.tasks[self.task].name;
        let suggested = self.held().first().map(|tried| Suggested {
            item: tried.item.as_deref().map(str::trim_end),
            observe: &tried.name,
        });
        let tried = self.tried.iter().map(|tried| Entry {
            predicate: &tried.name,
            condition: tried.condition.as_deref(),
            better: tried.holds(),
            asked: tried.asked,
            promised: tried.promised,
            gain: tried.duel.gain.mean,
            ci95: tried.duel.gain.ci95,
            return_without: tried.duel.before.total.mean,
            return_with: tried.duel.after.total.mean,
            nodes_without: tried.nodes[0],
            nodes_with: tried.nodes[1],
            ended_to_its_loss: tried.duel.ended.0,
            ended_no_longer: tried.duel.ended.1,
            episodes: tried.duel.after.episodes,
        });
        json::document(&Document {
            version: env!("CARGO_PKG_VERSION"),
            task,
            seed: self.seed,
            readings: self.readings,
            conditions: self.conditions,
            played: self.played,
            suggested,
            tried: tried.collect(),
        })
    }
}

#[derive(Serialize)]
struct Document<'a> {
    version: &'static str,
    task: &'a Name,
    seed: u64,
    readings: usize,
    conditions: usize,
    played: usize,
    suggested: Option<Suggested<'a>>,
    tried: Vec<Entry<'a>>,
}

#[derive(Serialize)]
struct Suggested<'a> {
    /// The item to add; none if the program has the predicate.
    item: Option<&'a str>,
    observe: &'a str,
}

#[derive(Serialize)]
struct Entry<'a> {
    predicate: &'a str,
    condition: Option<&'a str>,
    better: bool,
    asked: bool,
    promised: f64,
    gain: f64,
    ci95: [f64; 2],
    return_without: f64,
    return_with: f64,
    nodes_without: usize,
    nodes_with: usize,
    ended_to_its_loss: usize,
    ended_no_longer: usize,
    episodes: u64,
}
