//! Smaller trees that decide almost as a given one: the moves of a search that simulation judges.
//!
//! Nothing here knows what a tree is worth. Each move rewrites one place of the tree, and what comes of it is tidied;
//! a candidate is well formed, drives something, and costs strictly less to read.

mod flat;
mod guards;
mod memory;
mod plain;
mod tidy;
mod units;

use super::Size;
use super::atoms::children;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use std::collections::BTreeSet;
use std::fmt;

pub use flat::{Decided, flat};
pub use plain::{Cost, oddities, plainer};
pub use tidy::tidy;

/// A predicate outside of which a behaviour fails outright, such as `vis(A)` for `goto(A)`.
pub type Possible = (Id<Behavior>, Atom);

/// A tree that a move makes of another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// What was done.
    pub change: Change,
    /// The tree.
    pub root: Node,
    /// Its size.
    pub size: Size,
    /// What it takes to read it.
    pub cost: Cost,
}

impl Candidate {
    fn new(change: Change, root: Node, possible: &[Possible]) -> Self {
        Self {
            change,
            size: Size::of(&root),
            cost: Cost::of(&root, possible),
            root,
        }
    }
}

/// The moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Change {
    /// A unit of a selector, or another child, was left out.
    Dropped,
    /// A guard lost a literal or an alternative, or all of it.
    Loosened,
    /// A subtree was replaced by a part of it.
    Reduced,
    /// Two units became one.
    Merged,
    /// Two units became a sequence with memory.
    Joined,
    /// A guard asks for the predicate outside of which its behaviour fails.
    Possible,
    /// Units changed places and a guard was loosened.
    Reordered,
    /// A unit and those after it changed places, and a guard lost its negation.
    Turned,
    /// What units of a selector had in common was put before them.
    Factored,
    /// One unit for each behaviour, with what was seen to hold where the tree chose it.
    Flattened,
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Change::Dropped => "dropped",
            Change::Loosened => "loosened",
            Change::Reduced => "reduced",
            Change::Merged => "merged",
            Change::Joined => "joined",
            Change::Possible => "only where possible",
            Change::Reordered => "reordered",
            Change::Turned => "turned",
            Change::Factored => "factored",
            Change::Flattened => "flattened",
        })
    }
}

/// A rewriting of one node.
type Move = (Change, Node);

/// Every tree that one move makes of this one and that costs strictly less to read ([`Cost`]), without repetitions, in
/// an order that depends on the tree alone.
pub fn candidates(root: &Node, possible: &[Possible]) -> Vec<Candidate> {
    let cost = Cost::of(root, possible);
    let mut found: Vec<Candidate> = Vec::new();
    for (change, moved) in everywhere(root, possible) {
        let candidate = Candidate::new(change, tidy(moved), possible);
        let known = |c: &Candidate| c.cost == candidate.cost && c.root == candidate.root;
        if candidate.cost < cost && drives(&candidate.root) && !found.iter().any(known) {
            found.push(candidate);
        }
    }
    found
}

/// The moves at a node and at all that is below it.
fn everywhere(node: &Node, possible: &[Possible]) -> Vec<Move> {
    let mut found = here(node, possible);
    for (i, child) in children(node).iter().enumerate() {
        for (change, moved) in everywhere(child, possible) {
            found.push((change, with_child(node, i, moved)));
        }
    }
    found
}

fn here(node: &Node, possible: &[Possible]) -> Vec<Move> {
    let mut found = Vec::new();
    if let Node::Condition(guard) = node {
        let looser = guards::looser(guard).into_iter();
        found.extend(looser.map(|guard| (Change::Loosened, Node::Condition(guard))));
        return found;
    }
    for i in 0..children(node).len() {
        // A guard alone would have the robot stand still.
        let less = without(node, i).filter(drives);
        found.extend(less.map(|node| (Change::Dropped, node)));
    }
    found.extend(reduced(node).into_iter().map(|n| (Change::Reduced, n)));
    found.extend(units::moves(node, possible));
    found.extend(memory::moves(node));
    found
}

/// The children of a node, and the behaviours below them, each in the node's place.
fn reduced(node: &Node) -> Vec<Node> {
    let parts = children(node).iter();
    let mut found: Vec<Node> = parts
        .filter(|child| !matches!(child, Node::Condition(_) | Node::Behavior(_)))
        .cloned()
        .collect();
    let mut behaviors = BTreeSet::new();
    node.visit_behaviors(&mut |behavior| {
        behaviors.insert(behavior);
    });
    if !children(node).is_empty() {
        found.extend(behaviors.into_iter().map(Node::Behavior));
    }
    found
}

/// The node with another child in the place of the `at`-th.
fn with_child(node: &Node, at: usize, new: Node) -> Node {
    let mut node = node.clone();
    match &mut node {
        Node::Condition(_) | Node::Behavior(_) => {}
        Node::Composite { children, .. } | Node::Parallel { children, .. } => {
            if let Some(child) = children.get_mut(at) {
                *child = new;
            }
        }
        Node::Decorator { child, .. } => **child = new,
    }
    node
}

/// The composite without its `at`-th child.
fn without(node: &Node, at: usize) -> Option<Node> {
    let mut node = node.clone();
    match &mut node {
        Node::Composite { children, .. } if children.len() > 1 => {
            children.remove(at);
            Some(node)
        }
        _ => None,
    }
}

/// Whether any behaviour stands in the tree.
fn drives(node: &Node) -> bool {
    let mut any = false;
    node.visit_behaviors(&mut |_| any = true);
    any
}
