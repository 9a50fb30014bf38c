//! The size of a tree, the figure in every report.

use crate::ir::tree::{Composite, Guard, Node};

/// The size of a tree as it would be drawn; smaller ones come first: by nodes, then literals, then depth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Size {
    /// Composites, decorators, behaviour leaves, literals in guards, and the composites that join literals.
    pub nodes: usize,
    /// Occurrences of literals in guards.
    pub literals: usize,
    /// Nodes on the longest way from the root to a leaf.
    pub depth: usize,
}

impl Size {
    /// The size of a tree.
    ///
    /// The literals of a guard stand as children under the sequence of `guard => node`; each `or` is a selector, each
    /// of its alternatives with several literals a sequence; negating a literal is free.
    pub fn of(node: &Node) -> Self {
        match node {
            Node::Behavior(_) => Self::leaf(0),
            Node::Condition(guard) => Self::guard(guard, false, None),
            Node::Composite {
                kind,
                memory,
                children,
            } => {
                let joins = (*kind, *memory) == (Composite::Sequence, false);
                Self::over(children.iter().map(|child| match child {
                    Node::Condition(guard) if joins => {
                        Self::guard(guard, false, Some(Composite::Sequence))
                    }
                    child => Self::of(child),
                }))
            }
            Node::Parallel { children, .. } => Self::over(children.iter().map(Self::of)),
            Node::Decorator { child, .. } => Self::over([Self::of(child)].into_iter()),
        }
    }

    fn leaf(literals: usize) -> Self {
        Self {
            nodes: 1,
            literals,
            depth: 1,
        }
    }

    /// A node over these.
    fn over(children: impl Iterator<Item = Self>) -> Self {
        let below = Self::beside(children);
        Self {
            nodes: below.nodes + 1,
            literals: below.literals,
            depth: below.depth + 1,
        }
    }

    /// These side by side.
    fn beside(children: impl Iterator<Item = Self>) -> Self {
        children.fold(Self::default(), |all, child| Self {
            nodes: all.nodes + child.nodes,
            literals: all.literals + child.literals,
            depth: all.depth.max(child.depth),
        })
    }

    /// A guard, negated if so, under a node that joins in the way `under`.
    fn guard(guard: &Guard, negated: bool, under: Option<Composite>) -> Self {
        let (joins, guards) = match (guard, negated) {
            (Guard::Const(_), _) => return Self::leaf(0),
            (Guard::Atom(_), _) => return Self::leaf(1),
            (Guard::Not(guard), _) => return Self::guard(guard, !negated, under),
            (Guard::And(guards), false) | (Guard::Or(guards), true) => {
                (Composite::Sequence, guards)
            }
            (Guard::Or(guards), false) | (Guard::And(guards), true) => {
                (Composite::Selector, guards)
            }
        };
        let parts = guards
            .iter()
            .map(|guard| Self::guard(guard, negated, Some(joins)));
        if under == Some(joins) {
            Self::beside(parts)
        } else {
            Self::over(parts)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Size;
    use crate::ir::Id;
    use crate::ir::tree::{Atom, Composite, Guard, Node};
    use crate::tree::formula::{and, guarded, not, selector};

    fn atom(i: usize) -> Guard {
        Guard::Atom(Atom::Predicate(Id::new(i)))
    }

    fn leaf(i: usize) -> Node {
        Node::Behavior(Id::new(i))
    }

    #[test]
    fn figure_8_has_10_nodes() {
        let charge = Node::Composite {
            kind: Composite::Sequence,
            memory: true,
            children: vec![leaf(2), leaf(3)],
        };
        let root = selector(vec![
            guarded(atom(1), charge),
            guarded(atom(0), leaf(1)),
            leaf(0),
        ]);
        let size = Size::of(&root);
        assert_eq!((size.nodes, size.literals, size.depth), (10, 2, 4));
    }

    #[test]
    fn five_rules_of_two_literals_and_a_default_have_22_nodes() {
        let rules = (0..5).map(|i| guarded(and([atom(i), not(atom(i + 1))]), leaf(i)));
        let root = selector(rules.chain([leaf(9)]).collect());
        assert_eq!((Size::of(&root).nodes, Size::of(&root).literals), (22, 10));
    }

    #[test]
    fn an_or_is_a_selector_and_its_long_alternatives_are_sequences() {
        let long = and([atom(0), atom(1)]);
        let either = Guard::Or(vec![long, not(atom(2))]);
        // sequence, selector, sequence, three literals, leaf
        assert_eq!(Size::of(&guarded(either.clone(), leaf(0))).nodes, 7);
        // negated: a conjunction of an alternative and a literal, which the sequence joins
        let negated = Guard::Not(Box::new(either));
        assert_eq!(Size::of(&guarded(negated, leaf(0))).nodes, 6);
    }
}
