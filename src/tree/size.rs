//! The size of a tree, the figure in every report.

use super::drawing::{Drawing, Shape};
use crate::ir::tree::Node;

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
    pub fn of(node: &Node) -> Self {
        Self::drawn(&Drawing::of(node))
    }

    fn drawn(drawing: &Drawing) -> Self {
        let own = Self {
            nodes: 1,
            literals: usize::from(matches!(drawing.shape, Shape::Literal(..))),
            depth: 1,
        };
        drawing.children.iter().fold(own, |all, child| {
            let below = Self::drawn(child);
            Self {
                nodes: all.nodes + below.nodes,
                literals: all.literals + below.literals,
                depth: all.depth.max(below.depth + 1),
            }
        })
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
