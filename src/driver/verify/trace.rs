//! The shortest way to where two sides part, in words.

use crate::driver::learn::minterm_text;
use crate::ir::law::Behavior;
use crate::ir::{Id, Program};
use crate::policy::Policy;
use crate::tree::equivalence::Trace;
use std::fmt::Display;

/// The ticks in which two sides agree, and the one in which they part.
pub(super) fn text(
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
    let policy = Policy {
        atoms: trace.atoms.clone(),
        ..Policy::default()
    };
    let held = |minterm| minterm_text(program, &policy, minterm);
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
