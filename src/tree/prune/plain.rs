//! Trees of the same size that are easier to read.

use super::guards::{common, negations};
use super::units::{Unit, needs, put, select, units};
use super::{Candidate, Change, Move, Possible, tidy, with_child};
use crate::ir::tree::{Guard, Node};
use crate::tree::Size;
use crate::tree::atoms::children;
use crate::tree::formula::{and, not};

/// Every tree with no more nodes and literals that reads more plainly: with fewer negated literals, and fewer units
/// that start a behaviour without asking for the predicate outside of which it fails.
///
/// They differ from the given one at least where a behaviour fails outright.
pub fn plainer(root: &Node, possible: &[Possible]) -> Vec<Candidate> {
    let size = Size::of(root);
    let odd = oddities(root, possible);
    let mut found = Vec::new();
    for (change, node) in everywhere(root, possible) {
        let root = tidy(node);
        let same = Size::of(&root);
        let no_larger = (same.nodes, same.literals) <= (size.nodes, size.literals);
        if no_larger && oddities(&root, possible) < odd {
            found.push(Candidate {
                change,
                size: same,
                root,
            });
        }
    }
    found
}

/// Negated literals, and units that do not ask for what their behaviour needs.
pub fn oddities(node: &Node, possible: &[Possible]) -> usize {
    let own = match node {
        Node::Condition(guard) => negations(guard),
        node => units(node)
            .unwrap_or_default()
            .iter()
            .filter(|unit| unasked(unit, possible).is_some())
            .count(),
    };
    let below = children(node).iter();
    own + below.map(|child| oddities(child, possible)).sum::<usize>()
}

/// What the behaviour of a unit needs and its guard does not ask for.
fn unasked(unit: &Unit, possible: &[Possible]) -> Option<Guard> {
    let needs = needs(&unit.body, possible)?;
    (!common(&unit.guard).0.contains(&needs)).then_some(needs)
}

fn everywhere(node: &Node, possible: &[Possible]) -> Vec<Move> {
    let mut found = Vec::new();
    if let Some(units) = units(node) {
        turned(&units, &mut found);
        asked(&units, possible, &mut found);
    }
    for (i, child) in children(node).iter().enumerate() {
        let below = everywhere(child, possible).into_iter();
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

/// What a behaviour needs in the place of one part of its guard, or in the place of the guard before the last unit,
/// which then comes last.
fn asked(units: &[Unit], possible: &[Possible], found: &mut Vec<Move>) {
    for (i, unit) in units.iter().enumerate() {
        let Some(needs) = unasked(unit, possible) else {
            continue;
        };
        let parts = super::tidy::parts(&unit.guard);
        for at in 0..parts.len() {
            let kept = parts.iter().enumerate().filter(|(j, _)| *j != at);
            let kept = kept.map(|(_, part)| part.clone());
            let guard = and(kept.chain([needs.clone()]));
            found.push((Change::Possible, select(put(units, i, unit.under(guard)))));
        }
        if parts.is_empty()
            && i + 1 == units.len()
            && let Some(before) = i.checked_sub(1)
            && let Some(resort) = units.get(before)
        {
            let asked = put(units, before, unit.under(needs));
            let units = put(&asked, i, resort.under(Guard::Const(true)));
            found.push((Change::Possible, select(units)));
        }
    }
}
