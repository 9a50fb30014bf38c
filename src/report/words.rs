//! Words that several reports use.

use crate::ir::task::Task;
use crate::ir::tree::Atom;
use crate::ir::{Expr, ExprId, Program};
use crate::learn::statistics::Summary;
use crate::policy::{Minterm, Policy};
use crate::tree::Size;
use crate::tree::decanonicalise::Failing;

/// A line of a report.
pub fn line(title: &str, text: &str) -> String {
    format!("{title:<12} {text}")
}

/// A number of things.
pub fn counted(n: usize, what: &str) -> String {
    match n {
        0 => format!("no {what}s"),
        n => numbered(n as u64, what),
    }
}

/// A number of things as a figure, 0 included.
pub fn numbered(n: u64, what: &str) -> String {
    match n {
        1 => format!("1 {what}"),
        n => format!("{n} {what}s"),
    }
}

/// That episodes return far less than nearly all others, if any do.
pub fn apart(summary: &Summary) -> Option<String> {
    let apart = summary.worst.map_or(0, |worst| worst.apart);
    let verb = if apart == 1 { "returns" } else { "return" };
    let far = || {
        format!(
            "{} {verb} far less than the others",
            numbered(apart, "episode")
        )
    };
    (apart > 0).then(far)
}

/// The size of a tree.
pub fn size(size: &Size) -> String {
    let (nodes, literals) = (size.nodes as u64, size.literals as u64);
    format!(
        "{}, {}",
        numbered(nodes, "node"),
        numbered(literals, "literal")
    )
}

/// A text as the data of a workflow command for GitHub.
pub fn command_data(text: &str) -> String {
    let text = text.replace('%', "%25").replace('\r', "%0D");
    text.replace('\n', "%0A")
}

/// A text as a property of a workflow command for GitHub.
pub fn command_property(text: &str) -> String {
    command_data(text).replace(':', "%3A").replace(',', "%2C")
}

/// The atoms that hold in a minterm, in braces.
pub fn minterm(program: &Program, atoms: &[Atom], minterm: &Minterm) -> String {
    let atoms = atoms.iter().zip(minterm.values());
    let held = atoms.filter(|(_, holds)| *holds);
    let held: Vec<String> = held
        .map(|(atom, _)| program.atom_name(*atom).to_string())
        .collect();
    format!("{{{}}}", held.join(", "))
}

/// The number of rows of a table.
pub fn rows(policy: &Policy) -> String {
    let cubes = policy.rows.iter().filter(|row| row.free.is_some()).count();
    match cubes {
        0 => counted(policy.rows.len(), "minterm"),
        _ => format!(
            "{} ({cubes} of them cubes)",
            counted(policy.rows.len(), "row")
        ),
    }
}

/// Where a policy was seen to fail outright, and what its tree does then, which is called so.
pub fn failing(program: &Program, policy: &Policy, failing: &Failing, tree: &str) -> String {
    let then = failing.then.iter().map(|next| match next {
        Some(id) => format!("goes on to {}", program.behaviors[*id].name),
        None => "selects nothing".to_owned(),
    });
    let then: Vec<String> = then.collect();
    // No path of the tree may come here with this failure.
    let then = match then.is_empty() {
        true => String::new(),
        false => format!("; {tree} {}", then.join(" or ")),
    };
    format!(
        "{} failed outright {} times ({} with no change) in {}{then}",
        program.behaviors[failing.behavior].name,
        failing.count,
        failing.repeated,
        minterm(program, &policy.atoms, &failing.minterm),
    )
}

/// The longest condition that stands for the name of an end, in characters.
const LONGEST: usize = 40;

/// The names of what ends the episodes of a task: of the event, or else the condition, `end N` where that is long.
pub fn end_names(program: &Program, task: &Task) -> Vec<String> {
    let name = |(i, id): (usize, &ExprId)| {
        let events = events_of(program, *id).map(|events| events.join(" or "));
        let written = || {
            let text = task.written.ends.get(i)?;
            (text.chars().count() <= LONGEST).then(|| text.clone())
        };
        events
            .or_else(written)
            .unwrap_or_else(|| format!("end {}", i + 1))
    };
    task.end_on.iter().enumerate().map(name).collect()
}

/// The names of the events that are joined by `or`, if there is nothing else.
fn events_of(program: &Program, id: ExprId) -> Option<Vec<String>> {
    let name = |id| match program.pool.get(id) {
        Expr::Event(event) => Some(program.events[event].name.to_string()),
        _ => None,
    };
    let alternatives = program.alternatives(id, false).into_iter();
    alternatives.map(name).collect()
}
