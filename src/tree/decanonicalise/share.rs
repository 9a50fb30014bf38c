//! Literals that neighbouring units have in common, once before a selector of them.

use crate::ir::tree::{Composite, Guard, Node};
use crate::tree::Size;
use crate::tree::guard::{and, atom, conjuncts, or};
use crate::tree::unit::{self, Unit, guarded, selector};

/// The tree with shared literals taken out of the guards of neighbours wherever that makes it smaller: a unit whose
/// guard fails lets the next one try, and so does a group of units none of whose guards hold.
pub(super) fn shared(node: Node) -> Node {
    match node {
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let children = children.into_iter().map(shared).collect();
            match (kind, memory) {
                (Composite::Selector, false) => grouped(neighbours(children)),
                _ => Node::Composite {
                    kind,
                    memory,
                    children,
                },
            }
        }
        node => node,
    }
}

/// The selector of these, the group that saves most made until none does.
fn grouped(mut children: Vec<Node>) -> Node {
    loop {
        let guards: Vec<Vec<Guard>> = children.iter().map(literals).collect();
        let Some((start, end, literal)) = best(&guards, &children) else {
            return selector(children);
        };
        let run = children.get(start..end).unwrap_or_default();
        let inside = grouped(run.iter().map(|child| without(child, &literal)).collect());
        // What is behind one guard of its own needs no second one before it.
        let inside = Unit::of(&inside);
        let group = guarded(and([literal, inside.guard]), inside.body);
        children.splice(start..end, [group]);
    }
}

/// The children of a selector, those neighbours under one guard that have one body, where that makes them smaller.
fn neighbours(children: Vec<Node>) -> Vec<Node> {
    let mut joined: Vec<Node> = Vec::new();
    for child in children {
        let both = joined.last().and_then(|before| either(before, &child));
        match (joined.last_mut(), both) {
            (Some(last), Some(both)) => *last = both,
            _ => joined.push(child),
        }
    }
    joined
}

/// Two units with one body, as one, if that is smaller.
fn either(one: &Node, other: &Node) -> Option<Node> {
    let ((first, body), (second, same)) = (unit::parts(one)?, unit::parts(other)?);
    if body != same || !body.answers_again() {
        return None;
    }
    let both = guarded(or([first.clone(), second.clone()]), body.clone());
    let nodes = |node: &Node| Size::of(node).nodes;
    (nodes(&both) < nodes(one) + nodes(other)).then_some(both)
}

/// The neighbours that save most behind a literal that all of them have. A group costs a sequence, the literal and a selector;
/// each unit in it saves the literal, and its sequence if it has no other guard.
fn best(guards: &[Vec<Guard>], children: &[Node]) -> Option<(usize, usize, Guard)> {
    let mut best: Option<(usize, (usize, usize, Guard))> = None;
    for (start, own) in guards.iter().enumerate() {
        let before = start.checked_sub(1).and_then(|at| guards.get(at));
        for literal in own {
            // A run that begins before is longer.
            if before.is_some_and(|before| before.contains(literal)) {
                continue;
            }
            let run = guards.iter().skip(start);
            let run = run.take_while(|guards| guards.contains(literal)).count();
            let units = children.iter().skip(start).take(run);
            let saved: usize = units.map(|unit| 1 + usize::from(is_behind_one(unit))).sum();
            if run > 1 && saved >= 3 && best.as_ref().is_none_or(|(most, _)| saved > *most) {
                best = Some((saved, (start, start + run, literal.clone())));
            }
        }
    }
    best.map(|(_, found)| found)
}

/// Whether a unit's guard is a single literal.
fn is_behind_one(node: &Node) -> bool {
    unit::parts(node).is_some_and(|(guard, _)| atom(guard).is_some())
}

/// The literals without which a unit lets nothing through.
fn literals(node: &Node) -> Vec<Guard> {
    let parts = unit::parts(node).map_or(&[][..], |(guard, _)| conjuncts(guard));
    let literals = parts.iter().filter(|part| atom(part).is_some());
    literals.cloned().collect()
}

/// The unit without one of its literals.
fn without(node: &Node, literal: &Guard) -> Node {
    let unit = Unit::of(node);
    let rest = conjuncts(&unit.guard).iter();
    let rest = and(rest.filter(|part| *part != literal).cloned());
    guarded(rest, unit.body)
}
