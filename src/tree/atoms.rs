//! What a tree mentions.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Guard, Node};
use std::collections::BTreeSet;

/// The atoms that the guards of a tree ask.
pub fn atoms(node: &Node) -> BTreeSet<Atom> {
    let mut found = BTreeSet::new();
    visit(node, &mut |node| {
        if let Node::Condition(guard) = node {
            guard_atoms(guard, &mut found);
        }
    });
    found
}

/// The behaviours that stand in a tree.
pub fn behaviors(node: &Node) -> BTreeSet<Id<Behavior>> {
    let mut found = BTreeSet::new();
    visit(node, &mut |node| {
        if let Node::Behavior(behavior) = node {
            found.insert(*behavior);
        }
    });
    found
}

/// The children of a node, from the left.
pub fn children(node: &Node) -> &[Node] {
    match node {
        Node::Condition(_) | Node::Behavior(_) => &[],
        Node::Composite { children, .. } | Node::Parallel { children, .. } => children,
        Node::Decorator { child, .. } => std::slice::from_ref(child),
    }
}

fn visit(node: &Node, see: &mut impl FnMut(&Node)) {
    see(node);
    for child in children(node) {
        visit(child, see);
    }
}

fn guard_atoms(guard: &Guard, found: &mut BTreeSet<Atom>) {
    match guard {
        Guard::Const(_) => {}
        Guard::Atom(atom) => {
            found.insert(*atom);
        }
        Guard::Not(guard) => guard_atoms(guard, found),
        Guard::And(guards) | Guard::Or(guards) => {
            for guard in guards {
                guard_atoms(guard, found);
            }
        }
    }
}
