//! Sequences with memory instead of guards over the history.

use super::units::join;
use super::{Change, Move};
use crate::ir::tree::{Atom, Composite, Guard, Node};
use crate::tree::guard::{self, alternatives, and, common, conjuncts, either, literals, or};
use crate::tree::unit::{Unit, memory, units};

/// Two units `… done(a) … => b` and `… => a` as `guard => memory sequence { a, b }`, where either of them stood.
///
/// The guard is that of one or the other or both without the literals over a, or one literal of it. Simulation tells
/// whether that is right.
pub(super) fn moves(node: &Node) -> Vec<Move> {
    let Some(units) = units(node) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for (j, second) in units.iter().enumerate() {
        for (i, first) in units.iter().enumerate() {
            let Some(done) = done(&first.body) else {
                continue;
            };
            let asked = Guard::Atom(done);
            if i == j || first.body == second.body || !literals(&second.guard).contains(&asked) {
                continue;
            }
            let (a, b) = (without(&first.guard, done), without(&second.guard, done));
            let both = either(&a, &b);
            let mut guards = vec![a, b, and(common(&both).0)];
            guards.extend(literals(&both));
            guards.push(both);
            let body = chain(&first.body, &second.body);
            for (at, guard) in guards.iter().enumerate() {
                if guards.iter().take(at).any(|known| known == guard) {
                    continue;
                }
                let unit = Unit {
                    guard: guard.clone(),
                    body: body.clone(),
                };
                found.push((Change::Joined, join(&units, i, j, unit.clone())));
                found.push((Change::Joined, join(&units, j, i, unit)));
            }
        }
    }
    found
}

/// What the history shows once the body has succeeded.
pub(super) fn done(body: &Node) -> Option<Atom> {
    match body {
        Node::Behavior(behavior) => Some(Atom::Done(*behavior)),
        Node::Composite {
            kind: Composite::Sequence,
            memory: true,
            children,
        } => done(children.last()?),
        _ => None,
    }
}

/// The memory sequence of two bodies; those that are memory sequences themselves become part of it.
pub(super) fn chain(first: &Node, second: &Node) -> Node {
    memory(Composite::Sequence, [first.clone(), second.clone()])
}

/// The guard without its literals over an atom.
fn without(guard: &Guard, atom: Atom) -> Guard {
    or(alternatives(guard).iter().map(|cube| {
        let parts = conjuncts(cube).iter();
        and(parts
            .filter(|part| guard::atom(part) != Some(atom))
            .cloned())
    }))
}
