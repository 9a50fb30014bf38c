//! A tree as it is drawn: guards are leaves and composites like everything else.
//!
//! The literals of a guard stand as children under the sequence of `guard => node`; each `or` is a selector, each of
//! its alternatives with several literals a sequence; a negated literal is one leaf.

use super::guard::View;
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

/// Whether the literals of a guard stand under this node, with no node between them: it is a sequence without memory.
pub(super) fn joins_guards(node: &Node) -> bool {
    matches!(
        node,
        Node::Composite {
            kind: Composite::Sequence,
            memory: false,
            ..
        }
    )
}

impl Drawing {
    /// Draws a tree.
    pub fn of(node: &Node) -> Self {
        let drawn = |children: &[Node]| children.iter().map(Self::of).collect();
        match node {
            Node::Behavior(behavior) => Self::leaf(Shape::Behavior(*behavior)),
            Node::Condition(guard) => Self::one(Self::guard(guard, true)),
            Node::Composite {
                kind,
                memory,
                children,
            } => {
                let joins = joins_guards(node);
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

    /// A guard, negated unless `positive`: how it joins its parts, and these; a leaf is a sequence of one.
    fn guard(guard: &Guard, positive: bool) -> (Composite, Vec<Self>) {
        let leaf = |shape| (Composite::Sequence, vec![Self::leaf(shape)]);
        match View::of(guard, positive) {
            View::Const(value) => leaf(Shape::Const(value)),
            View::Literal(atom, value) => leaf(Shape::Literal(atom, value)),
            View::Join(kind, parts, positive) => {
                let parts = parts.iter().map(|part| Self::guard(part, positive));
                let parts = parts.flat_map(|part| Self::under(kind, part));
                (kind, parts.collect())
            }
        }
    }

    /// A joined guard as children of a composite: its parts alone if both join alike.
    fn under(outer: Composite, (kind, parts): (Composite, Vec<Self>)) -> Vec<Self> {
        match kind == outer {
            true => parts,
            false => vec![Self::one((kind, parts))],
        }
    }

    /// A joined guard as one node.
    fn one((kind, mut parts): (Composite, Vec<Self>)) -> Self {
        match parts.len() {
            1 => parts.swap_remove(0),
            _ => Self {
                shape: Shape::Composite(kind, false),
                children: parts,
            },
        }
    }
}
