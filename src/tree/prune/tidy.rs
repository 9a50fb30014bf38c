//! Trees without the traces of what was taken out of them.

use crate::ir::tree::{Atom, Composite, Guard, Node};
use crate::tree::formula::{and, not, or, selector};

/// The same tree without what a move leaves behind: composites of one child, selectors in selectors, sequences in
/// sequences, guards before guards, constants in guards, and children that can never be reached for them.
pub fn tidy(node: Node) -> Node {
    match node {
        Node::Condition(guard) => Node::Condition(folded(guard)),
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

/// A guard with its constants folded and nested joins flattened.
fn folded(guard: Guard) -> Guard {
    match guard {
        Guard::Const(_) | Guard::Atom(_) => guard,
        Guard::Not(inner) => not(folded(*inner)),
        Guard::And(parts) => {
            let mut parts: Vec<Guard> = parts.into_iter().map(folded).collect();
            parts.sort_by_key(place);
            and(parts)
        }
        Guard::Or(parts) => match or(parts.into_iter().map(folded)) {
            Guard::Or(cubes) => or(absorbed(cubes)),
            guard => guard,
        },
    }
}

/// Where a part of a conjunction stands: literals by their atoms, as in a table, before what is longer.
fn place(part: &Guard) -> (bool, Option<Atom>) {
    let atom = match part {
        Guard::Atom(atom) => Some(*atom),
        Guard::Not(inner) => match **inner {
            Guard::Atom(atom) => Some(atom),
            _ => None,
        },
        _ => None,
    };
    (atom.is_none(), atom)
}

/// The alternatives without those that another one covers: `a or a and b` is `a`.
fn absorbed(cubes: Vec<Guard>) -> Vec<Guard> {
    let covers = |wide: &Guard, narrow: &Guard| {
        let narrow = parts(narrow);
        parts(wide).iter().all(|part| narrow.contains(part))
    };
    let kept = |(i, cube): (usize, &Guard)| {
        !cubes.iter().enumerate().any(|(j, other)| {
            // Of two equal ones the first stays.
            i != j && covers(other, cube) && (j < i || !covers(cube, other))
        })
    };
    let keep: Vec<bool> = cubes.iter().enumerate().map(kept).collect();
    let both = cubes.into_iter().zip(keep);
    both.filter(|(_, keep)| *keep)
        .map(|(cube, _)| cube)
        .collect()
}

/// The parts of a conjunction.
pub(super) fn parts(guard: &Guard) -> &[Guard] {
    match guard {
        Guard::And(parts) => parts,
        Guard::Const(true) => &[],
        guard => std::slice::from_ref(guard),
    }
}

fn tidy_selector(children: Vec<Node>) -> Node {
    let spliced = children.into_iter().flat_map(|child| match child {
        Node::Composite {
            kind: Composite::Selector,
            memory: false,
            children,
        } => children,
        child => vec![child],
    });
    let mut reached = Vec::new();
    for child in spliced {
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
    let spliced = children.into_iter().flat_map(|child| match child {
        Node::Composite {
            kind: Composite::Sequence,
            memory: false,
            children,
        } => children,
        child => vec![child],
    });
    for child in spliced {
        match (flat.last_mut(), child) {
            (_, Node::Condition(Guard::Const(true))) => {}
            (Some(Node::Condition(before)), Node::Condition(guard)) => {
                *before = folded(and([before.clone(), guard]));
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
