//! A tree as it is drawn: guards are leaves and composites like everything else.
//!
//! The literals of a guard stand as children under the sequence of `guard => node`; each `or` is a selector, each of
//! its alternatives with several literals a sequence; a negated literal is one leaf.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Guard, Node};

/// A node of the drawing with what stands under it, from the left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// What is drawn.
    pub shape: Shape,
    /// What stands under it.
    pub children: Vec<Drawing>,
}

/// What is drawn for a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A selector or a sequence, and whether it has memory.
    Composite(Composite, bool),
    /// `parallel` with the number of successes.
    Parallel(u32),
    /// A decorator.
    Decorator(Decorator),
    /// A behaviour.
    Behavior(Id<Behavior>),
    /// An atom, or its negation if `false`.
    Literal(Atom, bool),
    /// A condition that always, or never, holds.
    Const(bool),
}

impl Drawing {
    /// Draws a tree.
    pub fn of(node: &Node) -> Self {
        let drawn = |children: &[Node]| children.iter().map(Self::of).collect();
        match node {
            Node::Behavior(behavior) => Self::leaf(Shape::Behavior(*behavior)),
            Node::Condition(guard) => Self::one(Composite::Sequence, Self::guard(guard, true)),
            Node::Composite {
                kind,
                memory,
                children,
            } => {
                let joins = (*kind, *memory) == (Composite::Sequence, false);
                let children = children.iter().flat_map(|child| match child {
                    Node::Condition(guard) if joins => {
                        Self::under(Composite::Sequence, Self::guard(guard, true))
                    }
                    child => vec![Self::of(child)],
                });
                Self {
                    shape: Shape::Composite(*kind, *memory),
                    children: children.collect(),
                }
            }
            Node::Parallel {
                successes,
                children,
            } => Self {
                shape: Shape::Parallel(*successes),
                children: drawn(children),
            },
            Node::Decorator { kind, child } => Self {
                shape: Shape::Decorator(*kind),
                children: vec![Self::of(child)],
            },
        }
    }

    fn leaf(shape: Shape) -> Self {
        Self {
            shape,
            children: Vec::new(),
        }
    }

    /// A guard, negated unless `positive`: a way to join and what it joins; a leaf is a sequence of one.
    fn guard(guard: &Guard, positive: bool) -> (Composite, Vec<Self>) {
        let (joins, guards) = match (guard, positive) {
            (Guard::Const(value), _) => {
                let leaf = Self::leaf(Shape::Const(*value == positive));
                return (Composite::Sequence, vec![leaf]);
            }
            (Guard::Atom(atom), _) => {
                let leaf = Self::leaf(Shape::Literal(*atom, positive));
                return (Composite::Sequence, vec![leaf]);
            }
            (Guard::Not(guard), _) => return Self::guard(guard, !positive),
            (Guard::And(guards), true) | (Guard::Or(guards), false) => {
                (Composite::Sequence, guards)
            }
            (Guard::And(guards), false) | (Guard::Or(guards), true) => {
                (Composite::Selector, guards)
            }
        };
        let parts = guards.iter().map(|guard| Self::guard(guard, positive));
        (
            joins,
            parts.flat_map(|part| Self::under(joins, part)).collect(),
        )
    }

    /// A joined guard as children of a node that joins in the way `outer`.
    fn under(outer: Composite, (joins, mut parts): (Composite, Vec<Self>)) -> Vec<Self> {
        match parts.len() {
            1 => vec![parts.swap_remove(0)],
            _ if joins == outer => parts,
            _ => vec![Self {
                shape: Shape::Composite(joins, false),
                children: parts,
            }],
        }
    }

    /// A joined guard as one node.
    fn one(outer: Composite, (joins, parts): (Composite, Vec<Self>)) -> Self {
        let mut children = Self::under(outer, (joins, parts));
        match children.len() {
            1 => children.swap_remove(0),
            _ => Self {
                shape: Shape::Composite(joins, false),
                children,
            },
        }
    }
}
