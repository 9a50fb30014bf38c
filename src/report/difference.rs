//! The shortest way to where two sides part, in words.

use super::words;
use crate::ir::Id;
use crate::ir::Program;
use crate::ir::law::Behavior;
use crate::tree::equivalence::Trace;
use std::fmt::Display;

/// The ticks in which two sides agree, and the one in which they part.
pub fn text(
    program: &Program,
    (left, right): (impl Display, impl Display),
    along: &str,
    trace: &Trace,
) -> String {
    let name = |behavior: &Option<Id<Behavior>>| {
        behavior.map_or_else(
            || "nothing".to_owned(),
            |id| program.behaviors[id].name.to_string(),
        )
    };
    let held = |minterm| words::minterm(program, &trace.atoms, minterm);
    let mut lines = vec![format!(
        "different: `{left}` and `{right}` part after {} ticks {along}",
        trace.steps.len()
    )];
    let mut first = 1;
    for alike in trace.steps.chunk_by(|a, b| a == b) {
        let Some(step) = alike.first() else { continue };
        let last = first + alike.len() - 1;
        let ticks = if first == last {
            format!("tick {first:<3}")
        } else {
            format!("ticks {first} to {last}")
        };
        lines.push(format!(
            "  {ticks} {}: both select {}, which answers {}",
            held(&step.valuation),
            name(&step.behavior),
            step.status.name()
        ));
        first = last + 1;
    }
    lines.push(format!(
        "  tick {:<3} {}: `{left}` selects {}, `{right}` selects {}",
        trace.steps.len() + 1,
        held(&trace.valuation),
        name(&trace.left),
        name(&trace.right)
    ));
    lines.join("\n")
}
