//! Smaller trees that decide almost as a given one: the moves of a search that simulation judges.
//!
//! Nothing here knows what a tree is worth. Each move rewrites one place of the tree and tidies the result. A candidate is
//! well formed, ticks some behaviour, and costs strictly less to read.

mod guards;
mod memory;
mod once;
mod plain;
mod tidy;
mod units;

use super::Size;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use std::collections::BTreeSet;
use std::fmt;

pub use once::asked_once;
pub use plain::{Cost, negated_literals, plainer};
pub use tidy::tidy;

/// The predicate that a behaviour requires: where it does not hold, the behaviour fails outright. `vis(A)` for `goto(A)`.
pub type Requirement = (Id<Behavior>, Atom);

/// A tree that a move makes of another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Candidate {
    /// The move.
    pub change: Change,
    /// The tree.
    pub root: Node,
    /// Its size.
    pub size: Size,
    /// How hard it is to read.
    pub cost: Cost,
}

impl Candidate {
    fn new(change: Change, root: Node, requirements: &[Requirement]) -> Self {
        Self {
            change,
            size: Size::of(&root),
            cost: Cost::of(&root, requirements),
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
    /// A guard asks for the predicate that its behaviour requires.
    Required,
    /// Units changed places and a guard was loosened.
    Reordered,
    /// A unit and those after it changed places, and a guard lost its negation.
    Turned,
    /// What the guards of neighbouring units share was put before a selector of them.
    Factored,
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Change::Dropped => "dropped",
            Change::Loosened => "loosened",
            Change::Reduced => "reduced",
            Change::Merged => "merged",
            Change::Joined => "joined",
            Change::Required => "only where possible",
            Change::Reordered => "reordered",
            Change::Turned => "turned",
            Change::Factored => "factored",
        })
    }
}

/// What was done, and the node that it makes.
type Move = (Change, Node);

/// The trees that one move makes of this one and that cost strictly less to read ([`Cost`]), each once, in an order that
/// depends on the tree alone.
pub fn candidates(root: &Node, requirements: &[Requirement]) -> Vec<Candidate> {
    let cost = Cost::of(root, requirements);
    let mut found: Vec<Candidate> = Vec::new();
    for (change, moved) in everywhere(root, requirements) {
        let candidate = Candidate::new(change, tidy(moved), requirements);
        let known = |c: &Candidate| c.cost == candidate.cost && c.root == candidate.root;
        if candidate.cost < cost && drives(&candidate.root) && !found.iter().any(known) {
            found.push(candidate);
        }
    }
    found
}

/// The moves at a node and below it.
fn everywhere(node: &Node, requirements: &[Requirement]) -> Vec<Move> {
    let mut found = here(node, requirements);
    for (i, child) in node.children().iter().enumerate() {
        for (change, moved) in everywhere(child, requirements) {
            found.push((change, with_child(node, i, moved)));
        }
    }
    found
}

fn here(node: &Node, requirements: &[Requirement]) -> Vec<Move> {
    let mut found = Vec::new();
    if let Node::Condition(guard) = node {
        let looser = guards::looser(guard).into_iter();
        found.extend(looser.map(|guard| (Change::Loosened, Node::Condition(guard))));
        return found;
    }
    for i in 0..node.children().len() {
        // Under a guard alone the robot would stand still.
        let less = without(node, i).filter(drives);
        found.extend(less.map(|node| (Change::Dropped, node)));
    }
    found.extend(reduced(node).into_iter().map(|n| (Change::Reduced, n)));
    found.extend(units::moves(node, requirements));
    found.extend(memory::moves(node));
    found
}

/// The children of a node and the behaviours below them: each may replace the node.
fn reduced(node: &Node) -> Vec<Node> {
    let parts = node.children().iter();
    let mut found: Vec<Node> = parts
        .filter(|child| !matches!(child, Node::Condition(_) | Node::Behavior(_)))
        .cloned()
        .collect();
    let mut behaviors = BTreeSet::new();
    node.visit_behaviors(&mut |behavior| {
        behaviors.insert(behavior);
    });
    if !node.children().is_empty() {
        found.extend(behaviors.into_iter().map(Node::Behavior));
    }
    found
}

/// The node with its `at`-th child replaced.
pub(super) fn with_child(node: &Node, at: usize, new: Node) -> Node {
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

/// Whether the tree has a behaviour.
fn drives(node: &Node) -> bool {
    let mut any = false;
    node.visit_behaviors(&mut |_| any = true);
    any
}
