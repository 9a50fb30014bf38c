//! What another language of trees cannot say.

use crate::ir::tree::{Decorator, Node};

/// A node that cannot be written, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The way to the node, by the positions of children from the root.
    pub path: Vec<usize>,
    /// Why.
    pub reason: Reason,
}

/// Why a node cannot be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// A `parallel` of BehaviorTree.CPP does not tick a child again that has finished.
    Finished,
    /// A `parallel` of py_trees fails with its first child.
    Partial,
    /// A time that the runtime cannot count.
    Time,
    /// Ticks, and no world says how long one is.
    Ticks,
}

/// The first node from the left for which there is a reason.
pub(super) fn first(root: &Node, reason: &impl Fn(&Node) -> Option<Reason>) -> Option<Refusal> {
    fn visit(
        node: &Node,
        path: &mut Vec<usize>,
        reason: &impl Fn(&Node) -> Option<Reason>,
    ) -> Option<Refusal> {
        if let Some(reason) = reason(node) {
            let path = path.clone();
            return Some(Refusal { path, reason });
        }
        node.children().iter().enumerate().find_map(|(at, child)| {
            path.push(at);
            let found = visit(child, path, reason);
            path.pop();
            found
        })
    }
    visit(root, &mut Vec::new(), reason)
}

/// Whether a node ends in the tick in which it is reached, whatever the robot does.
pub(super) fn answers_at_once(node: &Node) -> bool {
    let waits = matches!(
        node,
        Node::Behavior(_)
            | Node::Decorator {
                kind: Decorator::Retry(_) | Decorator::Repeat(_) | Decorator::Timeout(_),
                ..
            }
    );
    !waits && node.children().iter().all(answers_at_once)
}
