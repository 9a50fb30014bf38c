//! How hard a tree is to read, and moves to plainer trees of the same size.

use super::units::{needs, select};
use super::{Candidate, Change, Move, Requirement, tidy, with_child};
use crate::ir::tree::{Guard, Node};
use crate::tree::Size;
use crate::tree::guard::{common, negations, not};
use crate::tree::unit::{Unit, units};

/// How hard a tree is to read, compared field by field; less is better.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cost {
    /// Its nodes, and one more for each unit that does not ask for what its behaviour requires: the reader has to know it.
    pub nodes: usize,
    /// The number of such units.
    pub unasked: usize,
    /// Literals.
    pub literals: usize,
    /// Depth.
    pub depth: usize,
}

impl Cost {
    /// The cost of a tree.
    pub fn of(root: &Node, requirements: &[Requirement]) -> Self {
        let size = Size::of(root);
        let unasked = count_unasked(root, requirements);
        Self {
            nodes: size.nodes + unasked,
            unasked,
            literals: size.literals,
            depth: size.depth,
        }
    }
}

/// Trees with the same behaviours that cost no more, depth aside, and have fewer negated literals.
pub fn plainer(root: &Node, requirements: &[Requirement]) -> Vec<Candidate> {
    let flat = |cost: Cost| Cost { depth: 0, ..cost };
    let cost = flat(Cost::of(root, requirements));
    let negated = negated_literals(root);
    let mut found = Vec::new();
    for (change, node) in everywhere(root) {
        let candidate = Candidate::new(change, tidy(node), requirements);
        if flat(candidate.cost) <= cost && negated_literals(&candidate.root) < negated {
            found.push(candidate);
        }
    }
    found
}

/// The negated literals in the guards of a tree, each time they occur.
pub fn negated_literals(node: &Node) -> usize {
    let own = match node {
        Node::Condition(guard) => negations(guard),
        _ => 0,
    };
    own + node.children().iter().map(negated_literals).sum::<usize>()
}

/// The units that do not ask for what their behaviours require.
fn count_unasked(node: &Node, requirements: &[Requirement]) -> usize {
    let own = units(node).unwrap_or_default();
    let own = own
        .iter()
        .filter(|unit| unasked(unit, requirements).is_some());
    let below = node.children().iter();
    own.count()
        + below
            .map(|child| count_unasked(child, requirements))
            .sum::<usize>()
}

/// What the behaviour of a unit requires, if the guard does not ask for it.
pub(super) fn unasked(unit: &Unit, requirements: &[Requirement]) -> Option<Guard> {
    let needs = needs(&unit.body, requirements)?;
    (!common(&unit.guard).0.contains(&needs)).then_some(needs)
}

fn everywhere(node: &Node) -> Vec<Move> {
    let mut found = Vec::new();
    if let Some(units) = units(node) {
        turned(&units, &mut found);
    }
    for (i, child) in node.children().iter().enumerate() {
        let below = everywhere(child).into_iter();
        found.extend(below.map(|(change, moved)| (change, with_child(node, i, moved))));
    }
    found
}

/// A unit exchanged with all that follow it: `not c => a, b` as `c => b, a`.
fn turned(units: &[Unit], found: &mut Vec<Move>) {
    for (i, unit) in units.iter().enumerate() {
        let rest: Vec<Unit> = units.iter().skip(i + 1).cloned().collect();
        if rest.is_empty() || unit.guard == Guard::Const(true) {
            continue;
        }
        let first = Unit {
            guard: not(unit.guard.clone()),
            body: select(rest),
        };
        let before = units.iter().take(i).cloned();
        let units = before.chain([first, unit.under(Guard::Const(true))]);
        found.push((Change::Turned, select(units.collect())));
    }
}
