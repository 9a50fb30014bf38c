//! A simplified tree in words and figures.

use super::ends::Ended;
use super::episodes::Episodes;
use super::words::{end_names, line};
use crate::ir::Program;
use crate::ir::task::Task;
use crate::learn::statistics::Mean;
use crate::simplify::{Figures, Simplified};
use crate::tree::Size;
use crate::tree::prune::Change;
use serde::Serialize;
use std::collections::BTreeMap;

/// The second line of the tree's doc comment, after what was proved of the exact tree.
pub fn doc(simplified: &Simplified, program: &Program, task: &Task) -> String {
    let (before, after) = (&simplified.before, &simplified.after);
    if simplified.steps.is_empty() {
        return format!(
            "No smaller tree than this one, the exact one, was found within a loss of {}.",
            percent(simplified.allowed)
        );
    }
    let ended: Vec<String> = ended(program, task, after)
        .iter()
        .map(|end| format!("{} ended by {}, {}", end.count, end.name, end.bound()))
        .collect();
    let ended = match ended.is_empty() {
        true => String::new(),
        false => format!("; {}", ended.join(", ")),
    };
    format!(
        "That is the exact tree of {} nodes. This one, of {}, was made from it and is tested, not proved: a return \
             of {:.2} for {:.2} on {} fresh episodes, {}{ended}.",
        before.size.nodes,
        after.size.nodes,
        after.summary.total.mean,
        before.summary.total.mean,
        after.summary.episodes,
        verdict(simplified),
    )
}

/// `a loss of 0.42 % (95 %: 0.30 to 0.54 %)`, or a gain.
fn verdict(simplified: &Simplified) -> String {
    let scale = 100.0
        / simplified
            .before
            .summary
            .total
            .mean
            .abs()
            .max(f64::MIN_POSITIVE);
    let loss = simplified.loss;
    if loss.mean == 0.0 && loss.ci95 == [0.0, 0.0] {
        return "no difference in any of them".to_owned();
    }
    let (word, sign) = if loss.mean < 0.0 {
        ("gain", -1.0)
    } else {
        ("loss", 1.0)
    };
    let mut ends = loss.ci95.map(|end| sign * scale * end);
    ends.sort_by(f64::total_cmp);
    let [low, high] = ends;
    let mean = sign * scale * loss.mean;
    format!("a {word} of {mean:.2} % (95 %: {low:.2} to {high:.2} %)")
}

/// Lines for a person.
pub fn lines(simplified: &Simplified, program: &Program, task: &Task) -> Vec<String> {
    let (before, after) = (&simplified.before, &simplified.after);
    let mut changes: BTreeMap<Change, usize> = BTreeMap::new();
    for step in &simplified.steps {
        *changes.entry(step.change).or_default() += 1;
    }
    let changes: Vec<String> = changes.iter().map(|(c, n)| format!("{n} {c}")).collect();
    let mut lines = vec![
        line(
            "simplified",
            &format!(
                "{} to {} nodes, {} to {} literals; tested, not proved",
                before.size.nodes, after.size.nodes, before.size.literals, after.size.literals
            ),
        ),
        line(
            "",
            &format!(
                "in {} steps ({}), {} ticks",
                simplified.steps.len(),
                changes.join(", "),
                simplified.ticks
            ),
        ),
        line(
            "return",
            &format!(
                "{:.3} to {:.3}, {}, {} allowed, in {} fresh episodes",
                before.summary.total.mean,
                after.summary.total.mean,
                verdict(simplified),
                percent(simplified.allowed),
                after.summary.episodes
            ),
        ),
    ];
    let rates = before.summary.events.iter().zip(&after.summary.events);
    for (event, (was, is)) in program.events.values().zip(rates) {
        let text = format!("{:.3} to {:.3} in 1000 ticks", was.per_1000, is.per_1000);
        lines.push(line(&event.name.to_string(), &text));
    }
    let (was, is) = (ended(program, task, before), ended(program, task, after));
    for (was, is) in was.iter().zip(is) {
        let text = format!(
            "{} to {} of {} by {}, {}",
            was.count,
            is.count,
            is.episodes,
            is.name,
            is.bound()
        );
        lines.push(line("ended", &text));
    }
    lines
}

/// A simplified tree in `metrics.json`.
#[derive(Serialize)]
pub(super) struct Document<'a> {
    allowed: f64,
    before: Measured,
    after: Measured,
    loss: &'a Mean,
    ticks: u64,
    steps: Vec<StepFigures>,
}

#[derive(Serialize)]
struct Measured {
    #[serde(flatten)]
    size: Size,
    ran: Episodes,
}

#[derive(Serialize)]
struct StepFigures {
    change: String,
    nodes: usize,
    loss: f64,
    ci95: [f64; 2],
}

impl<'a> Document<'a> {
    pub(super) fn new(simplified: &'a Simplified, program: &Program, task: &Task) -> Self {
        let measured = |figures: &Figures| Measured {
            size: figures.size,
            ran: Episodes::new(program, task, figures.summary.clone()),
        };
        let steps = simplified.steps.iter().map(|kept| StepFigures {
            change: kept.change.to_string(),
            nodes: kept.size.nodes,
            loss: kept.loss.mean,
            ci95: kept.loss.ci95,
        });
        Self {
            allowed: simplified.allowed,
            before: measured(&simplified.before),
            after: measured(&simplified.after),
            loss: &simplified.loss,
            ticks: simplified.ticks,
            steps: steps.collect(),
        }
    }
}

/// The episodes that each line of `end on` ended.
fn ended(program: &Program, task: &Task, figures: &Figures) -> Vec<Ended> {
    Ended::all(&end_names(program, task), &figures.summary)
}

fn percent(part: f64) -> String {
    format!("{} %", (1e6 * part).round() / 1e4)
}
