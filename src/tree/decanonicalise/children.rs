//! The children of a selector that decides every row that reaches it, with their price.

use super::problem::Problem;
use crate::ir::tree::{Composite, Guard, Node};
use crate::logic::covering::{Grouped, List, Part, Rule};
use crate::logic::{Cover, Cube, Literal};
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

    /// A list of rules, and then the class of what they leave.
    pub(super) fn listed(problem: &Problem, list: &List) -> Self {
        Self::leaf(problem, list.last).after(problem, &list.rules)
    }

    /// The same of a list with groups.
    pub(super) fn grouped(problem: &Problem, list: &Grouped) -> Self {
        let mut children = Self::leaf(problem, list.last);
        // The rules that stand before what was placed last.
        let mut run: Vec<Rule> = Vec::new();
        for part in list.parts.iter().rev() {
            match part {
                Part::Rule(rule) => run.insert(0, rule.clone()),
                Part::Group(cube, inner) => {
                    children = children.after(problem, &std::mem::take(&mut run));
                    children = children.behind(problem, cube, Self::grouped(problem, inner));
                }
            }
        }
        children.after(problem, &run)
    }

    /// A group of these children behind a cube, and then the children here.
    fn behind(mut self, problem: &Problem, cube: &Cube, inner: Self) -> Self {
        let literals = cube.literals().iter();
        let literals = literals.map(|literal| guard::literal(*literal, &problem.policy.atoms));
        let price = Price::COMPOSITE + Price::literals(cube.literals().len());
        self.price = self.price + price + Price::COMPOSITE + inner.price;
        let group = guarded(guard::and(literals), selector(inner.nodes));
        self.nodes.insert(0, group);
        self
    }

    /// Rules, and then the children here. Neighbours of one class share a unit where that is smaller.
    fn after(mut self, problem: &Problem, rules: &[Rule]) -> Self {
        let mut units = Vec::new();
        for run in rules.chunk_by(|a, b| a.class == b.class) {
            let Some(class) = run.first().map(|rule| rule.class) else {
                continue;
            };
            let mut cubes: Vec<_> = run.iter().map(|rule| rule.cube.clone()).collect();
            // Rules of one class may stand in any order.
            cubes.sort_by_key(|cube| cube.literals().len());
            let body = Self::leaf(problem, class).nodes;
            let mut rest = cubes.as_slice();
            while !rest.is_empty() {
                let (count, price, guard) = together(problem, rest);
                let units_of = body.iter().map(|body| guarded(guard.clone(), body.clone()));
                units.extend(units_of);
                self.price = self.price + price;
                rest = rest.get(count..).unwrap_or_default();
            }
        }
        self.nodes.splice(0..0, units);
        self
    }

    /// The selector of them.
    pub(super) fn node(self) -> Node {
        selector(self.nodes)
    }
}

/// The most neighbouring rules that are tried under one guard.
const RUN: usize = 12;

/// How many of the first of these cubes of one class stand best under one guard, with the price of their unit.
fn together(problem: &Problem, cubes: &[Cube]) -> (usize, Price, Guard) {
    let mut best = (1, Price::default(), Guard::Const(true));
    let mut most = (isize::MIN, isize::MIN);
    let mut alone = Price::default();
    for (count, cube) in (1..=RUN).zip(cubes) {
        let literals = Price::literals(cube.literals().len());
        alone = alone + literals + Price::COMPOSITE + LEAF;
        let cover = Cover::new(cubes.iter().take(count).cloned());
        let guard = factored(&cover, &problem.policy.atoms);
        let guarding = Price::of_guard(&guard, Composite::Sequence);
        let price = guarding + Price::COMPOSITE + LEAF;
        let saved = (
            alone.nodes as isize - price.nodes as isize,
            alone.literals as isize - price.literals as isize,
        );
        // Of those that save as much the longest.
        if saved >= most {
            (most, best) = (saved, (count, price, guard));
        }
    }
    best
}
