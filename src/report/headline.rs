//! The report of `btc learn` in five lines: four on the tree that is printed, one on the values of the policy.

use super::ends::{EndLine, Ended};
use super::grown;
use super::results::Results;
use super::value::Value;
use super::words::{self, line, numbered};

/// Return, events, ends, size with what was proved or tested, and values.
pub fn lines<W>(results: &Results<W>) -> Vec<String> {
    let printed = results.printed();
    let summary = printed.summary;
    let experiment = results.experiment;
    let program = experiment.program;
    let mut ends = Ended::all(&EndLine::all(program, experiment.task), summary);
    // What is not wanted stands first.
    ends.sort_by_key(|end| end.is_goal);
    let [low, high] = summary.total.ci95;
    let mut first = format!(
        "{:.3}, 95 % [{low:.3}, {high:.3}], in {}",
        summary.total.mean,
        numbered(summary.episodes, "episode")
    );
    for often in Ended::often(&ends, "them") {
        first.push_str("; ");
        first.push_str(&often);
    }
    if let (Some(apart), Some(worst)) = (words::apart(summary), summary.worst) {
        first.push_str(&format!("; {apart}, {:.3} at worst", worst.total));
    }
    let events = program.events.values().zip(&summary.events);
    let events: Vec<String> = events
        .map(|(event, rate)| {
            let [low, high] = rate.ci95;
            format!("{} {:.3} [{low:.3}, {high:.3}]", event.name, rate.per_1000)
        })
        .collect();
    let events = match events.is_empty() {
        true => "none are declared".to_owned(),
        false => format!("{} in 1000 ticks", events.join(", ")),
    };
    let ends = ends.iter().map(|end| {
        let (count, episodes) = (end.count, end.episodes);
        format!("{count} of {episodes} by {}, {}", end.name, end.bound())
    });
    let limit = format!("{} at the limit", summary.cut);
    let ends: Vec<String> = ends.chain([limit]).collect();
    let grown = results.grown.as_ref();
    let beside = grown.and_then(|grown| grown::beside(grown, program, experiment.task));
    if let Some(beside) = beside {
        first.push_str("; ");
        first.push_str(&beside);
    }
    let tree = format!("{}; {}", words::size(&printed.size), printed.evidence);
    let value = Value::of(results).text();
    vec![
        line("return", &first),
        line("events", &events),
        line("ends", &ends.join("; ")),
        line("tree", &tree),
        line("value", &value),
    ]
}
