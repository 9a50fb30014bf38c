//! Which trees read more plainly, and moves to them that change no size.

use super::units::{needs, select};
use super::{Candidate, Change, Move, Possible, tidy, with_child};
use crate::ir::tree::{Guard, Node};
use crate::tree::Size;
use crate::tree::atoms::children;
use crate::tree::guard::{common, negations, not};
use crate::tree::unit::{Unit, units};

/// What it takes to read a tree; less is better, by the fields in their order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Cost {
    /// Its nodes, and one more for each unit that does not ask for what its behaviour needs: the reader has to know it.
    pub nodes: usize,
    /// How many such units there are.
    pub unasked: usize,
    /// Literals.
    pub literals: usize,
    /// Depth.
    pub depth: usize,
}

impl Cost {
    /// The cost of a tree.
    pub fn of(root: &Node, possible: &[Possible]) -> Self {
        let size = Size::of(root);
        let unasked = count_unasked(root, possible);
        Self {
            nodes: size.nodes + unasked,
            unasked,
            literals: size.literals,
            depth: size.depth,
        }
    }
}

/// Every tree with the same behaviours that costs no more, depth aside, and has fewer negated literals.
pub fn plainer(root: &Node, possible: &[Possible]) -> Vec<Candidate> {
    let flat = |cost: Cost| Cost { depth: 0, ..cost };
    let cost = flat(Cost::of(root, possible));
    let odd = oddities(root);
    let mut found = Vec::new();
    for (change, node) in everywhere(root) {
        let candidate = Candidate::new(change, tidy(node), possible);
        if flat(candidate.cost) <= cost && oddities(&candidate.root) < odd {
            found.push(candidate);
        }
    }
    found
}

/// Negated literals.
pub fn oddities(node: &Node) -> usize {
    let own = match node {
        Node::Condition(guard) => negations(guard),
        _ => 0,
    };
    own + children(node).iter().map(oddities).sum::<usize>()
}

/// Units that start a behaviour without asking for the predicate outside of which it fails.
fn count_unasked(node: &Node, possible: &[Possible]) -> usize {
    let own = units(node).unwrap_or_default();
    let own = own.iter().filter(|unit| unasked(unit, possible).is_some());
    let below = children(node).iter();
    own.count()
        + below
            .map(|child| count_unasked(child, possible))
            .sum::<usize>()
}

/// What the behaviour of a unit needs and its guard does not ask for.
pub(super) fn unasked(unit: &Unit, possible: &[Possible]) -> Option<Guard> {
    let needs = needs(&unit.body, possible)?;
    (!common(&unit.guard).0.contains(&needs)).then_some(needs)
}

fn everywhere(node: &Node) -> Vec<Move> {
    let mut found = Vec::new();
    if let Some(units) = units(node) {
        turned(&units, &mut found);
    }
    for (i, child) in children(node).iter().enumerate() {
        let below = everywhere(child).into_iter();
        found.extend(below.map(|(change, moved)| (change, with_child(node, i, moved))));
    }
    found
}

/// A unit and those after it exchanged: `not c => a, b` as `c => b, a`.
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
