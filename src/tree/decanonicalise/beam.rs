//! The search for the smallest selector over the subunits of one configuration: a beam search over its children.
//!
//! # Glossary
//!
//! - A **row** is a minterm of the policy. A row is *left* while no child of the selector decides it.
//! - A **subunit** is a behaviour or a memory node, with its own rows: those in which the policy takes it.
//! - A **rule** is a cube. It *applies* among the rows left if all of them that it lets through belong to one subunit:
//!   `rule => subunit` decides these rows rightly, whatever the rule does on rows that earlier children have decided.
//! - A **child** ([`Child`]) is a subunit, bare or behind rules or a guard, or a *group*: a literal before a selector.
//! - A **list** is the children of a selector from the left; its **price** is their nodes, then their literals.
//! - The **rest** of some rows is the list that greedy choice makes for them: again and again the child that decides most
//!   rows for its price. Until all rows are decided, a partial list is judged by its price and that of its rest.
//!
//! # One step
//!
//! A beam holds some partial lists. Each is extended by every child that may stand next. The extended lists are sorted
//! by their estimates; the best of them, each completed by its rest, become candidates for the result, and those that
//! still leave rows of several subunits are the next beam. The selector in a group is found in the same way, by a
//! narrower beam over the rows that the literal lets through.
//!
//! # Example
//!
//! ```text
//! low  carrying  near  behavior
//!  0      0       -    fetch
//!  0      1       -    deliver
//!  1      -       0    go
//!  1      -       1    dock
//! ```
//!
//! A row with `-` stands for two minterms here, so there are eight rows, two for each behaviour. At first no literal
//! alone applies: each lets rows of several behaviours through. So the rest of all rows begins with a cube of two
//! literals and comes to 12 nodes and 4 literals:
//!
//! ```text
//! selector { low and near => dock, low => go, carrying => deliver, fetch }
//! ```
//!
//! Among the children that may stand first is the group behind `low`. Of the rows that it lets through, the rest is
//! `near => dock, go`; of those that it leaves, `carrying => deliver, fetch`. The estimate is 12 nodes and 3 literals, the
//! best of all, and so the tree is
//!
//! ```text
//! selector { low => selector { near => dock, go }, carrying => deliver, fetch }
//! ```

mod rest;

use super::list::{Child, List, Stock};
use super::minimiser::Minimiser;
use super::rules::{Applied, Rules};
use super::subunit::Subunit;
use crate::ir::tree::Node;
use crate::logic::{Bits, Literal};
use crate::tree::size::Price;
use rustc_hash::{FxHashMap, FxHashSet};
use std::rc::Rc;

/// How wide and how deep a beam is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// Partial lists that are kept after each step at the root.
    pub(super) width: usize,
    /// The same within groups.
    pub(super) inner: usize,
    /// Selectors within selectors.
    pub(super) depth: usize,
}

/// Rules that are tried as the next child, and groups that are.
const NEXT_RULES: usize = 10;
const NEXT_GROUPS: usize = 4;
/// Complete lists that are kept.
const FINALISTS: usize = 24;

/// A partial list, and the rows that its children leave.
struct Partial {
    list: List,
    left: Bits,
}

/// A child that may stand next, with the rows that it decides.
struct Next {
    child: Rc<Child>,
    rows: Bits,
}

pub(super) struct Beam<'a, 'p> {
    stock: Stock<'a, 'p>,
    bounds: Bounds,
    /// The rest of each set of rows.
    rests: FxHashMap<Bits, Option<Rc<List>>>,
    /// The best selector in a group, by its rows and its depth.
    groups: FxHashMap<(Bits, usize), Option<Rc<List>>>,
}

impl<'a, 'p> Beam<'a, 'p> {
    pub(super) fn new(
        minimiser: &'a Minimiser<'p>,
        subunits: &'a [Subunit],
        rules: Rules,
        bounds: Bounds,
    ) -> Self {
        Self {
            stock: Stock::new(minimiser, subunits, rules),
            bounds,
            rests: FxHashMap::default(),
            groups: FxHashMap::default(),
        }
    }

    /// The best trees for all rows, cheapest first.
    pub(super) fn trees(&mut self) -> Vec<Node> {
        let all = self.stock.minimiser.problem.all();
        let lists = self.lists(&all, self.bounds.width, self.bounds.depth);
        lists.iter().map(|list| self.stock.node(list)).collect()
    }

    /// The best complete lists for these rows, cheapest first.
    fn lists(&mut self, rows: &Bits, width: usize, depth: usize) -> Vec<List> {
        let mut complete: Vec<List> = Vec::new();
        complete.extend(self.rest(rows).map(|list| self.stock.merged(&list)));
        let mut beam = vec![Partial {
            list: List::default(),
            left: rows.clone(),
        }];
        while !beam.is_empty() {
            let mut extended: Vec<(Price, Partial, Rc<List>)> = Vec::new();
            let mut seen: FxHashSet<(Bits, Price)> = FxHashSet::default();
            for partial in &beam {
                for next in self.next(&partial.left, depth) {
                    let left = partial.left.minus(&next.rows);
                    let price = self.stock.price(&next.child);
                    if !seen.insert((left.clone(), partial.list.price + price)) {
                        continue;
                    }
                    let Some(rest) = self.rest(&left) else {
                        continue;
                    };
                    let list = partial.list.with(next.child, price);
                    let estimate = list.price + rest.price;
                    extended.push((estimate, Partial { list, left }, rest));
                }
            }
            extended.sort_by_key(|(estimate, ..)| *estimate);
            let best = extended.iter().take(width);
            complete
                .extend(best.map(|(_, partial, rest)| self.stock.merged(&partial.list.then(rest))));
            extended.retain(|(_, partial, _)| self.sole(&partial.left).is_none());
            extended.truncate(width);
            beam = extended
                .into_iter()
                .map(|(_, partial, _)| partial)
                .collect();
        }
        complete.sort_by_key(List::whole);
        complete.dedup();
        complete.truncate(FINALISTS);
        complete
    }

    /// Every child that may stand next: subunits with all of their rows left, rules, and groups.
    fn next(&mut self, left: &Bits, depth: usize) -> Vec<Next> {
        let minimiser = self.stock.minimiser;
        if self.sole(left).is_some() || minimiser.account.is_spent() {
            return Vec::new();
        }
        let mut applied = self.stock.applied(left);
        let mut found = Vec::new();
        for number in 0..self.stock.subunits.len() {
            self.whole_subunits(number, left, &applied, depth, &mut found);
        }
        applied.sort_by_cached_key(|applied| self.order(applied));
        applied.truncate(NEXT_RULES);
        found.extend(applied.into_iter().map(|applied| Next {
            child: Rc::new(Child::Ruled(applied.subunit, vec![applied.rule])),
            rows: applied.rows,
        }));
        if depth > 1 {
            found.extend(self.next_groups(left, depth));
        }
        found
    }

    /// A subunit as a child that decides all of its rows left: bare if it guards itself, else behind several rules, and
    /// at the root behind a guard of its own.
    fn whole_subunits(
        &mut self,
        number: usize,
        left: &Bits,
        applied: &[Applied],
        depth: usize,
        found: &mut Vec<Next>,
    ) {
        let minimiser = self.stock.minimiser;
        let Some(subunit) = self.stock.subunits.get(number) else {
            return;
        };
        let own = subunit.rows.and(left);
        let mut push = |child| {
            found.push(Next {
                child: Rc::new(child),
                rows: own.clone(),
            });
        };
        if own.is_empty() {
            return;
        }
        if subunit.guards_itself {
            if own == subunit.rows {
                push(Child::Bare(number));
            }
            return;
        }
        let of_this: Vec<&Applied> = applied.iter().filter(|a| a.subunit == number).collect();
        if let Some(rules) = self.stock.rules.covering(&of_this, &own)
            && rules.len() > 1
        {
            push(Child::Ruled(number, rules));
        }
        let off = left.minus(&own);
        if depth == self.bounds.depth && minimiser.may_minimise(&own, &off) {
            if let Some(guard) = minimiser.guard(&own, &off) {
                push(Child::Guarded(number, guard));
            }
            if let Some(cover) = minimiser.cover(&own, &off) {
                self.stock.rules.learn(minimiser, &cover);
            }
        }
    }

    /// The best groups: behind a literal that lets some, but not all rows through, and rows of several subunits.
    fn next_groups(&mut self, left: &Bits, depth: usize) -> Vec<Next> {
        let mut promising: Vec<(Price, Literal, Bits)> = Vec::new();
        for literal in self.stock.rules.literals_asked() {
            let minimiser = self.stock.minimiser;
            minimiser.account.spend(minimiser.words() * 4);
            let mut through = left.clone();
            minimiser.problem.columns().restrict(&mut through, literal);
            if through.is_empty()
                || through == *left
                || self.sole(&through).is_some()
                || self.divides_memory(&through, left)
            {
                continue;
            }
            let after = left.minus(&through);
            let (Some(inner), Some(rest)) = (self.rest(&through), self.rest(&after)) else {
                continue;
            };
            let estimate = self.stock.price(&Child::Group(literal, inner)) + rest.price;
            promising.push((estimate, literal, through));
        }
        promising.sort_by_key(|(estimate, ..)| *estimate);
        promising.truncate(NEXT_GROUPS);
        let groups = promising.into_iter().filter_map(|(_, literal, rows)| {
            let inner = self.group(&rows, depth - 1)?;
            let child = Rc::new(Child::Group(literal, inner));
            Some(Next { child, rows })
        });
        groups.collect()
    }

    /// Whether these are some, but not all of the rows that a memory node has left. A memory node stands in one place.
    fn divides_memory(&self, through: &Bits, left: &Bits) -> bool {
        self.stock.subunits.iter().any(|subunit| {
            let own = subunit.rows.and(left);
            !subunit.is_behavior() && !own.is_disjoint(through) && !own.is_subset(through)
        })
    }

    /// The best list in a group of these rows.
    fn group(&mut self, rows: &Bits, depth: usize) -> Option<Rc<List>> {
        let key = (rows.clone(), depth);
        if let Some(known) = self.groups.get(&key) {
            return known.clone();
        }
        let found = self.lists(rows, self.bounds.inner, depth);
        let best = found.into_iter().next().map(Rc::new);
        self.groups.insert(key, best.clone());
        best
    }

    /// The subunit to which all of the rows belong.
    fn sole(&self, rows: &Bits) -> Option<usize> {
        let mut subunits = self.stock.subunits.iter();
        subunits.position(|subunit| rows.is_subset(&subunit.rows))
    }
}

#[cfg(test)]
mod tests {
    use super::{Beam, Bounds};
    use crate::ir::Id;
    use crate::ir::tree::{Atom, Guard, Node};
    use crate::logic::Account;
    use crate::policy::{Minterm, Policy, Row};
    use crate::tree::decanonicalise::minimiser::Minimiser;
    use crate::tree::decanonicalise::problem::Problem;
    use crate::tree::decanonicalise::rules::Rules;
    use crate::tree::decanonicalise::subunit::behaviors;
    use crate::tree::guard::and;
    use crate::tree::unit::{guarded, selector};

    const FETCH: usize = 0;
    const DELIVER: usize = 1;
    const GO: usize = 2;
    const DOCK: usize = 3;

    fn example() -> Policy {
        let decides = |[low, carrying, near]: [bool; 3]| match (low, carrying, near) {
            (false, false, _) => FETCH,
            (false, true, _) => DELIVER,
            (true, _, false) => GO,
            (true, _, true) => DOCK,
        };
        let rows = (0..8).map(|number| {
            let values = [4, 2, 1].map(|bit| number & bit != 0);
            Row {
                minterm: Minterm::new(values),
                free: None,
                behavior: Id::new(decides(values)),
                visits: 0,
                values: Vec::new(),
            }
        });
        Policy {
            atoms: (0..3).map(|i| Atom::Predicate(Id::new(i))).collect(),
            behaviors: (0..4).map(Id::new).collect(),
            rows: rows.collect(),
            ..Policy::default()
        }
    }

    /// What the page above says of the example.
    #[test]
    fn the_group_of_the_example_saves_a_literal() {
        let policy = example();
        let problem = Problem::new(&policy);
        let minimiser = Minimiser::new(&problem, Account::unlimited());
        let subunits = behaviors(&problem);
        let rules = Rules::new(&minimiser, &[], &[]);
        let bounds = Bounds {
            width: 8,
            inner: 2,
            depth: 2,
        };
        let mut beam = Beam::new(&minimiser, &subunits, rules, bounds);
        let [low, carrying, near] = [0, 1, 2].map(|i| Guard::Atom(policy.atoms[i]));
        let leaf = |behavior| Node::Behavior(Id::new(behavior));

        let rest = beam.rest(&problem.all()).unwrap();
        assert_eq!((rest.whole().nodes, rest.whole().literals), (12, 4));
        let greedy = [
            guarded(and([low.clone(), near.clone()]), leaf(DOCK)),
            guarded(low.clone(), leaf(GO)),
            guarded(carrying.clone(), leaf(DELIVER)),
            leaf(FETCH),
        ];
        assert_eq!(beam.stock.node(&rest), selector(greedy));

        let best = beam.lists(&problem.all(), 8, 2).remove(0);
        assert_eq!((best.whole().nodes, best.whole().literals), (12, 3));
        let group = selector([guarded(near, leaf(DOCK)), leaf(GO)]);
        let expected = [
            guarded(low, group),
            guarded(carrying, leaf(DELIVER)),
            leaf(FETCH),
        ];
        assert_eq!(beam.trees()[0], selector(expected));
    }
}
