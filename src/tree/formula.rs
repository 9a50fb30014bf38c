//! Guards, built and folded.

use crate::ir::tree::{Atom, Composite, Guard, Node};
use crate::logic::{Cover, Literal};

/// The conjunction, without nested conjunctions, repetitions and constants.
pub fn and(guards: impl IntoIterator<Item = Guard>) -> Guard {
    let mut parts: Vec<Guard> = Vec::new();
    for guard in guards {
        match guard {
            Guard::Const(true) => {}
            Guard::Const(false) => return Guard::Const(false),
            Guard::And(inner) => inner.into_iter().for_each(|g| add(&mut parts, g)),
            guard => add(&mut parts, guard),
        }
    }
    if parts.iter().any(|part| parts.contains(&not(part.clone()))) {
        return Guard::Const(false);
    }
    match parts.len() {
        0 => Guard::Const(true),
        1 => parts.remove(0),
        _ => Guard::And(parts),
    }
}

/// The disjunction, without nested disjunctions, repetitions and constants.
pub fn or(guards: impl IntoIterator<Item = Guard>) -> Guard {
    not(and(guards.into_iter().map(not)))
}

/// The negation, pushed down to the atoms.
pub fn not(guard: Guard) -> Guard {
    match guard {
        Guard::Const(value) => Guard::Const(!value),
        Guard::Atom(_) => Guard::Not(Box::new(guard)),
        Guard::Not(inner) => *inner,
        Guard::And(guards) => Guard::Or(guards.into_iter().map(not).collect()),
        Guard::Or(guards) => Guard::And(guards.into_iter().map(not).collect()),
    }
}

fn add(parts: &mut Vec<Guard>, guard: Guard) {
    if !parts.contains(&guard) {
        parts.push(guard);
    }
}

/// A literal over these atoms.
pub fn literal(literal: Literal, atoms: &[Atom]) -> Guard {
    match (atoms.get(literal.atom), literal.positive) {
        (Some(atom), true) => Guard::Atom(*atom),
        (Some(atom), false) => not(Guard::Atom(*atom)),
        (None, positive) => Guard::Const(!positive),
    }
}

/// A cover over these atoms.
pub fn cover(cover: &Cover, atoms: &[Atom]) -> Guard {
    let cubes = cover
        .cubes()
        .iter()
        .map(|cube| and(cube.literals().iter().map(|l| literal(*l, atoms))));
    let mut cubes: Vec<Guard> = cubes.collect();
    match cubes.len() {
        0 => Guard::Const(false),
        1 => cubes.remove(0),
        _ => Guard::Or(cubes),
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

/// A selector; its only child where it has one, and the children of selectors among its children as its own.
pub fn selector(children: Vec<Node>) -> Node {
    let mut flat = Vec::new();
    for child in children {
        match child {
            Node::Composite {
                kind: Composite::Selector,
                memory: false,
                children,
            } => flat.extend(children),
            child => flat.push(child),
        }
    }
    match flat.len() {
        1 => flat.remove(0),
        _ => Node::Composite {
            kind: Composite::Selector,
            memory: false,
            children: flat,
        },
    }
}
