//! What moves leave behind, cleared away.

use crate::ir::tree::{Composite, Guard, Node};
use crate::tree::guard::{and, simplified};
use crate::tree::unit::{selector, spliced};

/// The same tree without what a move leaves behind: composites of one child, selectors in selectors, sequences in
/// sequences, guards before guards, constants in guards, and children that can never be reached for them.
pub fn tidy(node: Node) -> Node {
    match node {
        Node::Condition(guard) => Node::Condition(simplified(guard)),
        Node::Behavior(_) => node,
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let children: Vec<Node> = children.into_iter().map(tidy).collect();
            match (kind, memory) {
                (Composite::Selector, false) => tidy_selector(children),
                (Composite::Sequence, false) => tidy_sequence(children),
                (_, true) => remembering(kind, children),
            }
        }
        Node::Parallel {
            successes,
            children,
        } => Node::Parallel {
            successes,
            children: children.into_iter().map(tidy).collect(),
        },
        Node::Decorator { kind, child } => Node::Decorator {
            kind,
            child: Box::new(tidy(*child)),
        },
    }
}

fn tidy_selector(children: Vec<Node>) -> Node {
    let mut reached = Vec::new();
    for child in spliced(Composite::Selector, false, children) {
        match child {
            Node::Condition(Guard::Const(false)) => {}
            Node::Condition(Guard::Const(true)) => {
                reached.push(child);
                break;
            }
            child => reached.push(child),
        }
    }
    match reached.is_empty() {
        true => Node::Condition(Guard::Const(false)),
        false => selector(reached),
    }
}

fn tidy_sequence(children: Vec<Node>) -> Node {
    let mut flat: Vec<Node> = Vec::new();
    for child in spliced(Composite::Sequence, false, children) {
        match (flat.last_mut(), child) {
            (_, Node::Condition(Guard::Const(true))) => {}
            (Some(Node::Condition(before)), Node::Condition(guard)) => {
                *before = simplified(and([before.clone(), guard]));
            }
            (_, child) => flat.push(child),
        }
        if matches!(flat.last(), Some(Node::Condition(Guard::Const(false)))) {
            break;
        }
    }
    match flat.as_slice() {
        [] => Node::Condition(Guard::Const(true)),
        [_] => flat.remove(0),
        // Nothing runs behind a first condition that never holds.
        [Node::Condition(Guard::Const(false)), ..] => Node::Condition(Guard::Const(false)),
        _ => Node::Composite {
            kind: Composite::Sequence,
            memory: false,
            children: flat,
        },
    }
}

fn remembering(kind: Composite, mut children: Vec<Node>) -> Node {
    match children.len() {
        1 => children.remove(0),
        _ => Node::Composite {
            kind,
            memory: true,
            children,
        },
    }
}
