//! What the reader of an exported tree has to know.

use crate::ir::Program;
use crate::ir::task::History;
use crate::ir::tree::{Decorator, Node, Status};

/// The length of a tick in milliseconds, to the nanosecond, if there is a world.
pub(super) fn tick(program: &Program) -> Option<f64> {
    let world = program.world.as_ref()?;
    Some((world.tick * 1e9).round() / 1e6)
}

/// Whether the tree has a memory node that moves on.
pub(super) fn moves_on(node: &Node) -> bool {
    let here = matches!(node, Node::Composite { memory: true, children, .. } if children.len() > 1);
    here || node.children().iter().any(moves_on)
}

/// Whether the tree has such a decorator.
pub(super) fn has_decorator(node: &Node, test: &impl Fn(Decorator) -> bool) -> bool {
    let here = matches!(node, Node::Decorator { kind, .. } if test(*kind));
    let mut children = node.children().iter();
    here || children.any(|child| has_decorator(child, test))
}

/// When `done` (of a success) or `failed` (of a failure) of `what` holds.
pub(super) fn window(outcome: Status, what: &str, history: Option<History>) -> String {
    let outcome = outcome.name();
    let Some(history) = history else {
        return format!("a {outcome} of {what} is in the history window");
    };
    let (one, several) = match (history.success, history.failure) {
        (true, false) => (Status::Success.name(), "successes"),
        (false, true) => (Status::Failure.name(), "failures"),
        _ => ("termination", "terminations"),
    };
    match history.window {
        1 => format!("the last {one} is a {outcome} of {what}"),
        window => format!("a {outcome} of {what} is among the last {window} {several}"),
    }
}
