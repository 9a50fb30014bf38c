//! Selectors as the beam builds them: lists of children with their price.

use super::minimiser::{Minimiser, Priced};
use super::rules::{Applied, Rules};
use super::subunit::Subunit;
use crate::ir::tree::Node;
use crate::logic::{Bits, Literal};
use crate::tree::Size;
use crate::tree::guard;
use crate::tree::size::Price;
use crate::tree::unit::{guarded, selector};
use std::rc::Rc;

/// The most neighbouring rules of one subunit that are tried under one guard.
const TOGETHER: usize = 12;

/// A child of a selector.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Child {
    /// A subunit that takes all rows left.
    Bare(usize),
    /// A subunit behind one of these rules.
    Ruled(usize, Vec<usize>),
    /// A subunit behind a guard.
    Guarded(usize, Rc<Priced>),
    /// A selector behind a literal that decides all rows left that the literal lets through.
    Group(Literal, Rc<List>),
}

/// Children from the left.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct List {
    pub(super) children: Vec<Rc<Child>>,
    /// The price of the children, without the selector over them.
    pub(super) price: Price,
}

impl List {
    /// The price as one node.
    pub(super) fn whole(&self) -> Price {
        match self.children.len() {
            1 => self.price,
            _ => Price::COMPOSITE + self.price,
        }
    }

    /// These children, and then those of another list.
    pub(super) fn then(&self, rest: &Self) -> Self {
        let children = self.children.iter().chain(&rest.children);
        Self {
            children: children.cloned().collect(),
            price: self.price + rest.price,
        }
    }

    /// With one more child.
    pub(super) fn with(&self, child: Rc<Child>, price: Price) -> Self {
        let mut children = self.children.clone();
        children.push(child);
        Self {
            children,
            price: self.price + price,
        }
    }
}

/// What lists are made of: subunits, and rules to put before them.
pub(super) struct Stock<'a, 'p> {
    pub(super) minimiser: &'a Minimiser<'p>,
    pub(super) subunits: &'a [Subunit],
    pub(super) rules: Rules,
    bodies: Vec<Price>,
    /// The subunit of each row.
    owners: Vec<usize>,
}

impl<'a, 'p> Stock<'a, 'p> {
    pub(super) fn new(minimiser: &'a Minimiser<'p>, subunits: &'a [Subunit], rules: Rules) -> Self {
        let body = |subunit: &Subunit| Size::of(&subunit.body).price();
        let mut owners = vec![0; minimiser.problem.columns().rows()];
        for (number, subunit) in subunits.iter().enumerate() {
            for row in subunit.rows.iter() {
                if let Some(owner) = owners.get_mut(row) {
                    *owner = number;
                }
            }
        }
        Self {
            minimiser,
            subunits,
            rules,
            owners,
            bodies: subunits.iter().map(body).collect(),
        }
    }

    /// The rules that apply among the rows left.
    pub(super) fn applied(&self, left: &Bits) -> Vec<Applied> {
        self.rules
            .applied(self.minimiser, self.subunits, &self.owners, left)
    }

    /// The price of a child.
    pub(super) fn price(&self, child: &Child) -> Price {
        let body = |subunit: &usize| self.bodies.get(*subunit).copied().unwrap_or_default();
        match child {
            Child::Bare(subunit) => body(subunit),
            Child::Ruled(subunit, rules) => {
                let guard = match rules.as_slice() {
                    [rule] => Price::literals(self.rules.literals(*rule)),
                    rules => self.rules.guard(self.minimiser, rules).price,
                };
                Price::COMPOSITE + guard + body(subunit)
            }
            Child::Guarded(subunit, guard) => Price::COMPOSITE + guard.price + body(subunit),
            Child::Group(_, list) => Price::COMPOSITE + Price::literals(1) + list.whole(),
        }
    }

    /// The list with neighbouring rules of one subunit under one guard where that is cheaper.
    pub(super) fn merged(&self, list: &List) -> List {
        let mut merged = List::default();
        let mut at = 0;
        while let Some(child) = list.children.get(at) {
            let mut best = (child.clone(), self.price(child));
            let mut next = at + 1;
            let (mut joined, mut single) = ((**child).clone(), best.1);
            for (j, child) in list.children.iter().enumerate().skip(at + 1) {
                let (Child::Ruled(a, rules), Child::Ruled(b, more)) = (&mut joined, &**child)
                else {
                    break;
                };
                if a != b || rules.len() >= TOGETHER {
                    break;
                }
                rules.extend(more);
                single = single + self.price(child);
                let price = self.price(&joined);
                // At the same price, fewer units.
                if price <= single {
                    best = (Rc::new(joined.clone()), price);
                    single = price;
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
        selector(list.children.iter().map(|child| self.child(child)))
    }

    fn child(&self, child: &Child) -> Node {
        let atoms = &self.minimiser.problem.policy.atoms;
        let body = |subunit: &usize| {
            let subunit = self.subunits.get(*subunit);
            subunit.map_or_else(|| selector(Vec::new()), |subunit| subunit.body.clone())
        };
        match child {
            Child::Bare(subunit) => body(subunit),
            Child::Ruled(subunit, rules) => {
                guarded(self.rules.guard(self.minimiser, rules).guard, body(subunit))
            }
            Child::Guarded(subunit, priced) => guarded(priced.guard.clone(), body(subunit)),
            Child::Group(literal, list) => {
                guarded(guard::literal(*literal, atoms), self.node(list))
            }
        }
    }
}
