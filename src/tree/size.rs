//! The size of a tree, the figure in every report.

use super::drawing::joins_guards;
use super::guard::View;
use crate::ir::tree::{Composite, Guard, Node};
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::iter::Sum;
use std::ops::Add;

/// The size of a tree as it is drawn; smaller ones come first: by nodes, then depth, then literals. Of as many nodes, those of a flat
/// tree are read more easily.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Size {
    /// Composites, decorators, behaviour leaves, literals in guards, and the composites that join literals.
    pub nodes: usize,
    /// Occurrences of literals in guards.
    pub literals: usize,
    /// Nodes on the longest path from the root to a leaf.
    pub depth: usize,
}

impl Ord for Size {
    fn cmp(&self, other: &Self) -> Ordering {
        let order = |size: &Self| (size.nodes, size.depth, size.literals);
        order(self).cmp(&order(other))
    }
}

impl PartialOrd for Size {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Size {
    /// The size of a tree.
    pub fn of(node: &Node) -> Self {
        Children::of(node, None).size
    }

    /// The nodes and literals.
    pub fn price(&self) -> Price {
        Price {
            nodes: self.nodes,
            literals: self.literals,
        }
    }
}

/// What is drawn under a composite for one of its children: the child, or the parts of a guard that joins them alike.
#[derive(Clone, Copy, Debug, Default)]
struct Children {
    /// How many there are.
    count: usize,
    /// The size of all of them, as deep as the deepest.
    size: Size,
}

impl Children {
    const fn leaf(literals: usize) -> Self {
        Self {
            count: 1,
            size: Size {
                nodes: 1,
                literals,
                depth: 1,
            },
        }
    }

    fn of(node: &Node, under: Option<Composite>) -> Self {
        match node {
            Node::Behavior(_) => Self::leaf(0),
            Node::Condition(guard) => Self::of_view(View::of(guard, true), under),
            node => {
                let joins = joins_guards(node).then_some(Composite::Sequence);
                let children = node.children().iter();
                children
                    .map(|child| Self::of(child, joins))
                    .sum::<Self>()
                    .under_a_node()
            }
        }
    }

    fn of_view(view: View, under: Option<Composite>) -> Self {
        match view {
            View::Const(_) => Self::leaf(0),
            View::Literal(..) => Self::leaf(1),
            View::Join(kind, parts, positive) => {
                let parts = parts.iter().map(|part| View::of(part, positive));
                let parts: Self = parts.map(|part| Self::of_view(part, Some(kind))).sum();
                match Some(kind) == under || parts.count == 1 {
                    true => parts,
                    false => parts.under_a_node(),
                }
            }
        }
    }

    /// These under a node of their own.
    fn under_a_node(self) -> Self {
        Self {
            count: 1,
            size: Size {
                nodes: self.size.nodes + 1,
                depth: self.size.depth + 1,
                ..self.size
            },
        }
    }
}

impl Sum for Children {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |all, one| Self {
            count: all.count + one.count,
            size: Size {
                nodes: all.size.nodes + one.size.nodes,
                literals: all.size.literals + one.size.literals,
                depth: all.size.depth.max(one.size.depth),
            },
        })
    }
}

/// The part of a size that adds up: what a part of a tree adds to the whole. Compared by nodes, then literals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Price {
    /// Nodes.
    pub nodes: usize,
    /// Literals.
    pub literals: usize,
}

impl Price {
    /// A composite, without its children.
    pub const COMPOSITE: Self = Self {
        nodes: 1,
        literals: 0,
    };

    /// Literals as children of a composite.
    pub fn literals(literals: usize) -> Self {
        Self {
            nodes: literals,
            literals,
        }
    }

    /// A node without what stands under it, as it is drawn under its parent; a guard is drawn as all that it asks.
    pub fn of_node(node: &Node, parent: Option<&Node>) -> Self {
        match node {
            Node::Condition(_) => {
                let joins = parent.is_some_and(joins_guards);
                let under = joins.then_some(Composite::Sequence);
                Children::of(node, under).size.price()
            }
            _ => Self::COMPOSITE,
        }
    }

    /// A guard as it is drawn under a composite of this kind.
    pub fn of_guard(guard: &Guard, under: Composite) -> Self {
        Children::of_view(View::of(guard, true), Some(under))
            .size
            .price()
    }
}

impl Add for Price {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            nodes: self.nodes + other.nodes,
            literals: self.literals + other.literals,
        }
    }
}

impl Sum for Price {
    fn sum<I: Iterator<Item = Self>>(prices: I) -> Self {
        prices.fold(Self::default(), Self::add)
    }
}

#[cfg(test)]
mod tests {
    use super::{Price, Size};
    use crate::ir::Id;
    use crate::ir::tree::{Atom, Composite, Guard, Node};
    use crate::tree::guard::{and, not};
    use crate::tree::unit::{guarded, selector};

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
        let root = selector(rules.chain([leaf(9)]));
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

    #[test]
    fn the_price_of_a_guard_is_what_it_adds_to_a_tree() {
        let either = Guard::Or(vec![and([atom(0), atom(1)]), not(atom(2))]);
        let nested = Guard::And(vec![either.clone(), Guard::Not(Box::new(either.clone()))]);
        for guard in [atom(0), Guard::Const(false), either.clone(), nested] {
            let drawn = Size::of(&guarded(guard.clone(), leaf(0)));
            let sequence_and_leaf = Price::COMPOSITE + Size::of(&leaf(0)).price();
            let price = Price::of_guard(&guard, Composite::Sequence);
            assert_eq!(drawn.price(), sequence_and_leaf + price, "{guard:?}");
        }
    }
    #[test]
    fn the_nodes_of_a_tree_are_those_that_each_of_its_nodes_is_drawn_as() {
        fn sum(node: &Node, parent: Option<&Node>) -> Price {
            let children = node.children().iter();
            Price::of_node(node, parent) + children.map(|child| sum(child, Some(node))).sum()
        }
        let both = and([atom(0), atom(1)]);
        let either = Guard::Or(vec![both.clone(), not(atom(2))]);
        let alone = Node::Condition(both.clone());
        for root in [
            alone.clone(),
            selector([alone.clone(), guarded(both, leaf(0)), leaf(1)]),
            guarded(either.clone(), selector([Node::Condition(either), leaf(2)])),
            Node::Composite {
                kind: Composite::Sequence,
                memory: true,
                children: vec![alone, leaf(0)],
            },
        ] {
            assert_eq!(sum(&root, None), Size::of(&root).price(), "{root:?}");
        }
    }
}
