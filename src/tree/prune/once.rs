//! What is asked or done twice in a tick is asked or done once.

use super::tidy::tidy;
use crate::ir::tree::{Composite, Guard, Node};
use crate::tree::guard::{and, common, not, or};

/// The same tree without the literals that an enclosing sequence has asked before in the same tick, and without the children of a node
/// without memory that stand before it already. It decides the same.
pub fn asked_once(root: &Node) -> Node {
    let once = under(root, &mut Vec::new());
    match once == *root {
        true => once,
        false => tidy(once),
    }
}

/// The node where these literals hold whenever it is ticked.
fn under(node: &Node, held: &mut Vec<Guard>) -> Node {
    let known = held.len();
    let node = match node {
        Node::Condition(guard) => Node::Condition(given(guard, held)),
        Node::Behavior(_) => node.clone(),
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            // A sequence with memory does not ask again what it has left behind.
            let asks = *kind == Composite::Sequence && !memory;
            let mut below = Vec::new();
            for (at, child) in children.iter().enumerate() {
                let before = children.get(..at).unwrap_or_default();
                if !memory && child.answers_again() && before.contains(child) {
                    continue;
                }
                below.push(under(child, held));
                if let (true, Node::Condition(guard)) = (asks, child) {
                    held.extend(common(guard).0.into_iter().filter(is_literal));
                }
            }
            Node::Composite {
                kind: *kind,
                memory: *memory,
                children: below,
            }
        }
        Node::Parallel {
            successes,
            children,
        } => Node::Parallel {
            successes: *successes,
            children: children.iter().map(|child| under(child, held)).collect(),
        },
        Node::Decorator { kind, child } => Node::Decorator {
            kind: *kind,
            child: Box::new(under(child, held)),
        },
    };
    held.truncate(known);
    node
}

/// The guard where these literals hold.
fn given(guard: &Guard, held: &[Guard]) -> Guard {
    match guard {
        Guard::And(parts) => and(parts.iter().map(|part| given(part, held))),
        Guard::Or(parts) => or(parts.iter().map(|part| given(part, held))),
        literal if held.contains(literal) => Guard::Const(true),
        literal if held.contains(&not(literal.clone())) => Guard::Const(false),
        other => other.clone(),
    }
}

fn is_literal(guard: &Guard) -> bool {
    match guard {
        Guard::Atom(_) => true,
        Guard::Not(inner) => matches!(**inner, Guard::Atom(_)),
        _ => false,
    }
}
