//! The children of a selector that decides every row that reaches it, with their price.

use super::problem::Problem;
use crate::ir::tree::{Composite, Guard, Node};
use crate::logic::covering::List;
use crate::logic::{Cover, Literal};
use crate::tree::guard::{self, factored, or};
use crate::tree::size::Price;
use crate::tree::unit::{Unit, guarded, selector};

/// Children from the left, the last without a guard.
#[derive(Clone, Debug)]
pub(super) struct Children {
    nodes: Vec<Node>,
    /// The price of all, without the selector over them.
    pub(super) price: Price,
}

/// The price of a behaviour.
const LEAF: Price = Price {
    nodes: 1,
    literals: 0,
};

impl Children {
    /// The behaviour of a class alone.
    pub(super) fn leaf(problem: &Problem, class: usize) -> Self {
        let behavior = problem.on.get(class).map(|(behavior, _)| *behavior);
        let node = behavior.map_or_else(|| selector(Vec::new()), Node::Behavior);
        Self {
            nodes: vec![node],
            price: LEAF,
        }
    }

    /// The children of `one` where an atom is 1, and of `zero` where it is 0. The smaller of the two stands in a unit, so that
    /// nesting is no deeper than the logarithm of the size.
    pub(super) fn divided(problem: &Problem, atom: usize, zero: Self, one: Self) -> Self {
        let positive = one.price <= zero.price;
        let (mut inner, mut outer) = match positive {
            true => (one, zero),
            false => (zero, one),
        };
        let literal = Literal { atom, positive };
        let literal = guard::literal(literal, &problem.policy.atoms);
        // What stands last in both is reached where no unit before it holds.
        if inner.nodes.len() > 1
            && outer.nodes.len() == 1
            && inner.nodes.last() == outer.nodes.last()
        {
            inner.nodes.pop();
            inner.price = Price {
                nodes: inner.price.nodes.saturating_sub(LEAF.nodes),
                ..inner.price
            };
        }
        let (nodes, price) = match inner.nodes.len() {
            1 => {
                let unit = inner.nodes.pop().map(|node| Unit::of(&node));
                let unit = unit.map(|unit| guarded(guard::and([literal, unit.guard]), unit.body));
                let behind = match inner.price == LEAF {
                    // A sequence and the literal.
                    true => Price::COMPOSITE + Price::literals(1),
                    false => Price::literals(1),
                };
                (unit, behind + inner.price)
            }
            _ => {
                let group = guarded(literal, selector(inner.nodes));
                let price = Price::COMPOSITE + Price::literals(1) + Price::COMPOSITE;
                (Some(group), price + inner.price)
            }
        };
        outer.price = outer.price + price;
        outer.nodes.splice(0..0, nodes);
        outer.joined()
    }

    /// The first two under one guard where they have one body and that is no dearer.
    fn joined(mut self) -> Self {
        let [first, second, rest @ ..] = self.nodes.as_slice() else {
            return self;
        };
        let (a, b) = (Unit::of(first), Unit::of(second));
        let last = rest.is_empty();
        if a.body != b.body || last || b.guard == Guard::Const(true) {
            return self;
        }
        let price = |unit: &Unit| Price::of_guard(&unit.guard, Composite::Sequence);
        let either = a.under(or([a.guard.clone(), b.guard.clone()]));
        let body = crate::tree::Size::of(&a.body).price();
        let before = price(&a) + price(&b) + Price::COMPOSITE + Price::COMPOSITE + body + body;
        let after = price(&either) + Price::COMPOSITE + body;
        if after > before {
            return self;
        }
        self.price = Price {
            nodes: self.price.nodes + after.nodes - before.nodes,
            literals: self.price.literals + after.literals - before.literals,
        };
        self.nodes.splice(0..2, [either.node()]);
        self
    }

    /// A list of rules, and then the class of what they leave. Neighbours of one class share a unit where that is smaller.
    pub(super) fn listed(problem: &Problem, list: &List) -> Self {
        let mut children = Self::leaf(problem, list.last);
        let atoms = &problem.policy.atoms;
        let mut units = Vec::new();
        for run in list.rules.chunk_by(|a, b| a.class == b.class) {
            let Some(class) = run.first().map(|rule| rule.class) else {
                continue;
            };
            let mut cubes: Vec<_> = run.iter().map(|rule| rule.cube.clone()).collect();
            // Rules of one class may stand in any order.
            cubes.sort_by_key(|cube| cube.literals().len());
            let mut rest = cubes.as_slice();
            while !rest.is_empty() {
                let alone = |count: usize| -> Price {
                    let cubes = rest.iter().take(count);
                    let price = cubes.map(|cube| Price::literals(cube.literals().len()));
                    price.map(|guard| guard + Price::COMPOSITE + LEAF).sum()
                };
                let together = |count: usize| {
                    let cover = Cover::new(rest.iter().take(count).cloned());
                    let guard = factored(&cover, atoms);
                    let price = Price::of_guard(&guard, Composite::Sequence);
                    (price + Price::COMPOSITE + LEAF, guard)
                };
                let most = rest.len().min(RUN);
                let counts = (1..=most).map(|count| (count, together(count)));
                // Of those that save as much the longest.
                let best = counts.max_by_key(|(count, (price, _))| {
                    let before = alone(*count);
                    let saved = before.nodes as isize - price.nodes as isize;
                    (saved, before.literals as isize - price.literals as isize)
                });
                let Some((count, (price, guard))) = best else {
                    break;
                };
                let body = Self::leaf(problem, class).nodes;
                units.extend(body.into_iter().map(|body| guarded(guard.clone(), body)));
                children.price = children.price + price;
                rest = rest.get(count..).unwrap_or_default();
            }
        }
        children.nodes.splice(0..0, units);
        children
    }

    /// The selector of them.
    pub(super) fn node(self) -> Node {
        selector(self.nodes)
    }
}

/// The most neighbouring rules that are tried under one guard.
const RUN: usize = 12;
