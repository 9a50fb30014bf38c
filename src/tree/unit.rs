//! Units `guard => body`, and composites built from them.

use crate::ir::tree::{Composite, Guard, Node};

/// `guard => body`: a reactive sequence of a condition and a node. Any other node is a unit whose guard always holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// When it lets its body through.
    pub guard: Guard,
    /// What it lets through.
    pub body: Node,
}

impl Unit {
    /// A node as a unit.
    pub fn of(node: &Node) -> Self {
        let (guard, body) = match parts(node) {
            Some((guard, body)) => (guard.clone(), body),
            None => (Guard::Const(true), node),
        };
        Self {
            guard,
            body: body.clone(),
        }
    }

    /// The unit as a node.
    pub fn node(self) -> Node {
        guarded(self.guard, self.body)
    }

    /// The same body under another guard.
    #[must_use]
    pub fn under(&self, guard: Guard) -> Self {
        Self {
            guard,
            body: self.body.clone(),
        }
    }
}

/// The guard and the body of `guard => body`; `None` for any other node.
pub fn parts(node: &Node) -> Option<(&Guard, &Node)> {
    match node {
        Node::Composite {
            kind: Composite::Sequence,
            memory: false,
            children,
        } => match children.as_slice() {
            [Node::Condition(guard), body] => Some((guard, body)),
            _ => None,
        },
        _ => None,
    }
}

/// `guard => node`; the node alone where the guard always holds.
pub fn guarded(guard: Guard, node: Node) -> Node {
    match guard {
        Guard::Const(true) => node,
        guard => Node::Composite {
            kind: Composite::Sequence,
            memory: false,
            children: vec![Node::Condition(guard), node],
        },
    }
}

/// The units of a selector; `None` for any other node.
pub fn units(node: &Node) -> Option<Vec<Unit>> {
    match node {
        Node::Composite {
            kind: Composite::Selector,
            memory: false,
            children,
        } => Some(children.iter().map(Unit::of).collect()),
        _ => None,
    }
}

/// A selector; its only child where it has one, and the children of selectors among its children as its own.
pub fn selector(children: impl IntoIterator<Item = Node>) -> Node {
    let mut children = spliced(Composite::Selector, false, children);
    match children.len() {
        1 => children.remove(0),
        _ => Node::Composite {
            kind: Composite::Selector,
            memory: false,
            children,
        },
    }
}

/// A memory node, with the children of memory nodes of its kind among its children as its own: chains are one node.
pub fn memory(kind: Composite, children: impl IntoIterator<Item = Node>) -> Node {
    Node::Composite {
        kind,
        memory: true,
        children: spliced(kind, true, children),
    }
}

/// The children of a composite, with the children of composites of its own kind in their places.
pub fn spliced(
    outer: Composite,
    remembers: bool,
    children: impl IntoIterator<Item = Node>,
) -> Vec<Node> {
    let mut flat = Vec::new();
    for child in children {
        match child {
            Node::Composite {
                kind,
                memory,
                children,
            } if (kind, memory) == (outer, remembers) => flat.extend(children),
            child => flat.push(child),
        }
    }
    flat
}
