//! What is said of a simplified tree.

use super::{Figures, Simplified};
use crate::driver::run;
use crate::ir::task::Task;
use crate::ir::{Id, Program};
use crate::learn::binomial::upper95;
use crate::tree::prune::Change;
use serde_json::{Value, json};
use std::collections::BTreeMap;

impl Simplified {
    /// The second line of the tree's doc comment, after what was proved of the exact tree.
    pub fn doc(&self, program: &Program, task: Id<Task>) -> String {
        let (before, after) = (&self.before, &self.after);
        if self.steps.is_empty() {
            return format!(
                "No smaller tree than this one, the exact one, was found within a loss of {}.",
                percent(self.allowed)
            );
        }
        let ended: Vec<String> = ended(program, task, after)
            .map(|(name, count, upper)| format!("{count} ended by {name} (below {upper:.2} %)"))
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
            self.verdict(),
        )
    }

    /// `a loss of 0.42 % (95 %: 0.30 to 0.54 %)`, or a gain.
    fn verdict(&self) -> String {
        let scale = 100.0 / self.before.summary.total.mean.abs().max(f64::MIN_POSITIVE);
        let loss = self.loss;
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
    pub fn lines(&self, program: &Program, task: Id<Task>) -> Vec<String> {
        let (before, after) = (&self.before, &self.after);
        let mut changes: BTreeMap<Change, usize> = BTreeMap::new();
        for step in &self.steps {
            *changes.entry(step.change).or_default() += 1;
        }
        let changes: Vec<String> = changes.iter().map(|(c, n)| format!("{n} {c}")).collect();
        let mut lines = vec![
            format!(
                "simplified   {} to {} nodes, {} to {} literals; tested, not proved",
                before.size.nodes, after.size.nodes, before.size.literals, after.size.literals
            ),
            format!(
                "             in {} steps ({}), {} ticks",
                self.steps.len(),
                changes.join(", "),
                self.ticks
            ),
            format!(
                "return       {:.3} to {:.3}, {}, {} allowed, in {} fresh episodes",
                before.summary.total.mean,
                after.summary.total.mean,
                self.verdict(),
                percent(self.allowed),
                after.summary.episodes
            ),
        ];
        let rates = before.summary.events.iter().zip(&after.summary.events);
        for (event, ((_, was), (_, is))) in program.events.values().zip(rates) {
            lines.push(format!(
                "{:<12} {:.3} to {:.3} in 1000 ticks",
                event.name, was.mean, is.mean
            ));
        }
        let (was, is) = (ended(program, task, before), ended(program, task, after));
        for ((name, was, _), (_, is, upper)) in was.zip(is) {
            lines.push(format!(
                "ended        {was} to {is} of {} by {name}, at most {upper:.2} % (95 %)",
                after.summary.episodes
            ));
        }
        lines
    }

    /// The figures for `metrics.json`.
    pub fn json(&self, program: &Program, task: Id<Task>) -> Value {
        let figures = |figures: &Figures| {
            let size = &figures.size;
            let ran = run::Ran {
                summary: figures.summary.clone(),
                events: program
                    .events
                    .values()
                    .map(|e| e.name.to_string())
                    .collect(),
                ends: run::end_names(program, &program.tasks[task]),
            };
            json!({
                "nodes": size.nodes,
                "literals": size.literals,
                "depth": size.depth,
                "ran": ran.json(),
            })
        };
        json!({
            "allowed": self.allowed,
            "before": figures(&self.before),
            "after": figures(&self.after),
            "loss": { "mean": self.loss.mean, "ci95": self.loss.ci95 },
            "ticks": self.ticks,
            "steps": self.steps.iter().map(|step| json!({
                "change": step.change.to_string(),
                "nodes": step.size.nodes,
                "loss": step.loss.mean,
                "ci95": step.loss.ci95,
            })).collect::<Vec<_>>(),
        })
    }
}

/// For each line of `end on`, its name, how many episodes it ended, and the upper bound in percent.
fn ended<'a>(
    program: &Program,
    task: Id<Task>,
    figures: &'a Figures,
) -> impl Iterator<Item = (String, u64, f64)> + use<'a> {
    let names = run::end_names(program, &program.tasks[task]);
    let summary = &figures.summary;
    names
        .into_iter()
        .zip(&summary.ended)
        .map(|(name, &count)| (name, count, 100.0 * upper95(count, summary.episodes)))
}

fn percent(part: f64) -> String {
    format!("{} %", (1e6 * part).round() / 1e4)
}
