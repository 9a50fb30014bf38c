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
    match history {
        None => format!("a {outcome} of {what} is in the history window"),
        Some(history) if history.window == 1 => {
            format!("the last {} is a {outcome} of {what}", held(Some(history)))
        }
        Some(_) => format!("a {outcome} of {what} is among the last {}", held(history)),
    }
}

/// What the window holds: `success`, `2 terminations`.
pub(super) fn held(history: Option<History>) -> String {
    let Some(history) = history else {
        return "terminations".to_owned();
    };
    let (one, several) = match (history.success, history.failure) {
        (true, false) => ("success", "successes"),
        (false, true) => ("failure", "failures"),
        _ => ("termination", "terminations"),
    };
    match history.window {
        1 => one.to_owned(),
        window => format!("{window} {several}"),
    }
}

/// The kinds of terminations that enter the window.
pub(super) fn kinds(history: History) -> impl Iterator<Item = Status> {
    [Status::Success, Status::Failure]
        .into_iter()
        .filter(move |status| history.keeps(*status))
}
