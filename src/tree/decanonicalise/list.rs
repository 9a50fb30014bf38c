//! Selectors as they are searched: lists of children.

use super::covers::{Covers, Priced};
use super::factor::{Cost, add};
use super::rules::{Rules, guarding};
use super::subunit::Subunit;
use crate::ir::tree::Node;
use crate::logic::{Cover, Cube};
use crate::tree::Size;
use crate::tree::formula::{cover, guarded, selector};
use std::rc::Rc;

/// A child of a selector.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Child {
    /// A subunit that takes all that comes to it.
    Bare(usize),
    /// A subunit behind one of these rules.
    Ruled(usize, Vec<usize>),
    /// A subunit behind a guard.
    Guarded(usize, Rc<Priced>),
    /// A cube before a selector that decides all of its rows that are left.
    Group(Cube, Rc<List>),
}

/// Children from the left that decide all rows that come to them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct List {
    pub(super) children: Vec<Rc<Child>>,
    /// What the children cost, without the selector over them.
    pub(super) cost: Cost,
}

impl List {
    /// The cost as one node.
    pub(super) fn whole(&self) -> Cost {
        match self.children.len() {
            1 => self.cost,
            _ => add(self.cost, (1, 0)),
        }
    }

    /// These children, and then those of another list.
    pub(super) fn then(&self, rest: &Self) -> Self {
        let children = self.children.iter().chain(&rest.children);
        Self {
            children: children.cloned().collect(),
            cost: add(self.cost, rest.cost),
        }
    }

    /// With one more child.
    pub(super) fn with(&self, child: Rc<Child>, cost: Cost) -> Self {
        let mut children = self.children.clone();
        children.push(child);
        Self {
            children,
            cost: add(self.cost, cost),
        }
    }
}

/// What children are made of.
pub(super) struct Stock<'a, 'p> {
    pub(super) covers: &'a Covers<'p>,
    pub(super) subunits: &'a [Subunit],
    pub(super) rules: Rules,
    bodies: Vec<Cost>,
}

impl<'a, 'p> Stock<'a, 'p> {
    pub(super) fn new(covers: &'a Covers<'p>, subunits: &'a [Subunit], rules: Rules) -> Self {
        let body = |subunit: &Subunit| {
            let size = Size::of(&subunit.body);
            (size.nodes, size.literals)
        };
        Self {
            covers,
            subunits,
            rules,
            bodies: subunits.iter().map(body).collect(),
        }
    }

    /// Nodes and literals of a child.
    pub(super) fn cost(&self, child: &Child) -> Cost {
        let body = |subunit: &usize| self.bodies.get(*subunit).copied().unwrap_or_default();
        match child {
            Child::Bare(subunit) => body(subunit),
            Child::Ruled(subunit, rules) => {
                let guard = match rules.as_slice() {
                    [rule] => guarding(self.rules.get(*rule).map_or(0, |rule| rule.literals)),
                    rules => add((1, 0), self.rules.guard(self.covers, rules).cost),
                };
                add(guard, body(subunit))
            }
            Child::Guarded(subunit, guard) => add(add((1, 0), guard.cost), body(subunit)),
            Child::Group(cube, list) => add(guarding(cube.literals().len()), list.whole()),
        }
    }

    /// The list with neighbouring rules of one subunit under one guard where that costs less.
    pub(super) fn merged(&self, list: &List) -> List {
        let mut merged = List::default();
        let mut at = 0;
        while let Some(child) = list.children.get(at) {
            let mut best = (child.clone(), self.cost(child));
            let mut next = at + 1;
            let (mut joined, mut apart) = ((**child).clone(), best.1);
            for (j, child) in list.children.iter().enumerate().skip(at + 1) {
                let (Child::Ruled(a, rules), Child::Ruled(b, more)) = (&mut joined, &**child)
                else {
                    break;
                };
                if a != b {
                    break;
                }
                rules.extend(more);
                apart = add(apart, self.cost(child));
                let cost = self.cost(&joined);
                // Of equal cost, fewer units.
                if (cost.0, cost.1) <= (apart.0, apart.1) {
                    best = (Rc::new(joined.clone()), cost);
                    apart = cost;
                    next = j + 1;
                }
            }
            merged = merged.with(best.0, best.1);
            at = next;
        }
        merged
    }

    /// The node of a list.
    pub(super) fn node(&self, list: &List) -> Node {
        selector(
            list.children
                .iter()
                .map(|child| self.child(child))
                .collect(),
        )
    }

    fn child(&self, child: &Child) -> Node {
        let atoms = &self.covers.problem.policy.atoms;
        let body = |subunit: &usize| {
            let subunit = self.subunits.get(*subunit);
            subunit.map_or_else(|| selector(Vec::new()), |subunit| subunit.body.clone())
        };
        match child {
            Child::Bare(subunit) => body(subunit),
            Child::Ruled(subunit, rules) => {
                guarded(self.rules.guard(self.covers, rules).guard, body(subunit))
            }
            Child::Guarded(subunit, priced) => guarded(priced.guard.clone(), body(subunit)),
            Child::Group(cube, list) => {
                guarded(cover(&Cover::new([cube.clone()]), atoms), self.node(list))
            }
        }
    }
}
