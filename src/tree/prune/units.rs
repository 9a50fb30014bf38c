//! Moves over the units of a selector.

use super::guards::looser;
use super::plain::unasked;
use super::{Change, Move, Requirement};
use crate::ir::tree::{Composite, Guard, Node};
use crate::tree::guard::{and, common, conjuncts, either, literals};
use crate::tree::unit::{Unit, selector, units};

/// The selector of these units.
pub(super) fn select(units: Vec<Unit>) -> Node {
    selector(units.into_iter().map(Unit::node))
}

/// The units with the one at `at` replaced.
pub(super) fn put(units: &[Unit], at: usize, unit: Unit) -> Vec<Unit> {
    let mut units = units.to_vec();
    if let Some(old) = units.get_mut(at) {
        *old = unit;
    }
    units
}

/// The selector of these units with `unit` instead of the one at `at`, and without the one at `gone`.
pub(super) fn join(units: &[Unit], at: usize, gone: usize, unit: Unit) -> Node {
    let mut units = put(units, at, unit);
    units.remove(gone);
    select(units)
}

/// The moves at a node, if it is a selector.
pub(super) fn moves(node: &Node, requirements: &[Requirement]) -> Vec<Move> {
    let Some(units) = units(node) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    merged(&units, &mut found);
    required(&units, requirements, &mut found);
    last_resort(&units, requirements, &mut found);
    reordered(&units, &mut found);
    factored(&units, &mut found);
    found
}

/// Two units as one: of the same behaviour wherever they stand, of different ones if they are neighbours.
fn merged(units: &[Unit], found: &mut Vec<Move>) {
    for (i, first) in units.iter().enumerate() {
        for (j, second) in units.iter().enumerate().skip(i + 1) {
            let same = first.body == second.body;
            if !same && j > i + 1 {
                continue;
            }
            let both = either(&first.guard, &second.guard);
            let shared = and(common(&both).0);
            for guard in [both, shared] {
                for (at, gone) in [(i, j), (j, i)] {
                    found.push((
                        Change::Merged,
                        join(units, at, gone, first.under(guard.clone())),
                    ));
                    if !same {
                        found.push((
                            Change::Merged,
                            join(units, at, gone, second.under(guard.clone())),
                        ));
                    }
                }
            }
        }
    }
}

/// The predicate that a body requires: that of the behaviour that it ticks first.
pub(super) fn needs(body: &Node, requirements: &[Requirement]) -> Option<Guard> {
    match body {
        Node::Behavior(behavior) => requirements
            .iter()
            .find(|(b, _)| b == behavior)
            .map(|(_, atom)| Guard::Atom(*atom)),
        Node::Composite {
            kind: Composite::Sequence,
            memory: true,
            children,
        } => needs(children.first()?, requirements),
        _ => None,
    }
}

/// A unit that asks for what its behaviour requires: beside its guard, instead of one part of it, or instead of all of it,
/// alone or with one of the guard's literals.
fn required(units: &[Unit], requirements: &[Requirement], found: &mut Vec<Move>) {
    for (i, unit) in units.iter().enumerate() {
        let Some(needs) = needs(&unit.body, requirements) else {
            continue;
        };
        let mut guards = vec![needs.clone()];
        if unasked(unit, requirements).is_some() {
            let parts = conjuncts(&unit.guard);
            guards.push(and(parts.iter().cloned().chain([needs.clone()])));
            for at in 0..parts.len() {
                let kept = parts.iter().enumerate().filter(|(j, _)| *j != at);
                let kept = kept.map(|(_, part)| part.clone());
                guards.push(and(kept.chain([needs.clone()])));
            }
        }
        guards.extend(
            literals(&unit.guard)
                .into_iter()
                .map(|literal| and([literal, needs.clone()])),
        );
        for guard in guards.into_iter().filter(|guard| *guard != unit.guard) {
            let units = put(units, i, unit.under(guard));
            found.push((Change::Required, select(units)));
        }
    }
}

/// Another unit last, without a guard; the one that was last then asks for what its behaviour requires.
fn last_resort(units: &[Unit], requirements: &[Requirement], found: &mut Vec<Move>) {
    let Some((last, others)) = units.split_last() else {
        return;
    };
    let Some(needs) = needs(&last.body, requirements) else {
        return;
    };
    for (i, unit) in others.iter().enumerate() {
        let mut units = others.to_vec();
        units.remove(i);
        units.push(last.under(and([last.guard.clone(), needs.clone()])));
        units.push(unit.under(Guard::Const(true)));
        found.push((Change::Required, select(units)));
    }
}

/// Two neighbours exchanged, or a unit moved to the front, with a looser guard of one of them.
fn reordered(units: &[Unit], found: &mut Vec<Move>) {
    for (i, unit) in units.iter().enumerate().skip(1) {
        let mut exchanged = units.to_vec();
        exchanged.swap(i - 1, i);
        for at in [i - 1, i] {
            if let Some(moved) = exchanged.get(at) {
                for guard in looser(&moved.guard) {
                    let units = put(&exchanged, at, moved.under(guard));
                    found.push((Change::Reordered, select(units)));
                }
            }
        }
        if i > 1 {
            for guard in looser(&unit.guard) {
                let mut units = units.to_vec();
                units.remove(i);
                units.insert(0, unit.under(guard));
                found.push((Change::Reordered, select(units)));
            }
        }
    }
}

/// A literal that the guards of neighbours share, once before a selector of them.
fn factored(units: &[Unit], found: &mut Vec<Move>) {
    for (i, first) in units.iter().enumerate() {
        for literal in common(&first.guard).0 {
            let run = units.iter().skip(i).map_while(|unit| {
                let (shared, rest) = common(&unit.guard);
                shared.contains(&literal).then(|| {
                    let others = shared.into_iter().filter(|part| *part != literal);
                    unit.under(and(others.chain([rest])))
                })
            });
            let run: Vec<Unit> = run.collect();
            let length = run.len();
            if length < 2 {
                continue;
            }
            let unit = Unit {
                guard: literal,
                body: select(run),
            };
            let before = units.iter().take(i).cloned();
            let after = units.iter().skip(i + length).cloned();
            let units = before.chain([unit]).chain(after).collect();
            found.push((Change::Factored, select(units)));
        }
    }
}
