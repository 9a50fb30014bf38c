//! The search for the smallest selector over the subunits of one configuration: a beam over what may stand next.
//!
//! A subunit may stand behind a smallest guard for all of its rows, behind a rule for some of them, or with others in a
//! group behind a literal. What is not finished is judged by what comes of always taking the rule that decides most
//! rows for its cost.

use super::covers::Covers;
use super::factor::{Cost, add};
use super::list::{Child, List, Stock};
use super::rules::{Rules, Standing, guarding};
use super::subunit::Subunit;
use crate::ir::tree::Node;
use crate::logic::{Bits, Cube, Literal};
use rustc_hash::{FxHashMap, FxHashSet};
use std::cmp::Reverse;
use std::rc::Rc;

/// How wide and how deep a beam is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// Unfinished selectors that are kept after each step at the root.
    pub(super) width: usize,
    /// The same within groups.
    pub(super) inner: usize,
    /// Selectors within selectors.
    pub(super) depth: usize,
}

/// Rules that are tried as the next child, groups that are, and groups that are searched from within.
const NEXT_RULES: usize = 10;
const NEXT_GROUPS: usize = 4;
/// Finished selectors that are kept.
const FINALISTS: usize = 24;

/// A selector that is not finished, and the rows that its children leave.
#[derive(Clone)]
struct Partial {
    list: List,
    left: Bits,
}

/// A child that may stand next, with the rows that it decides.
struct Step {
    child: Rc<Child>,
    rows: Bits,
}

pub(super) struct Beam<'a, 'p> {
    stock: Stock<'a, 'p>,
    shape: Shape,
    greedy: FxHashMap<Bits, Option<Rc<List>>>,
    best: FxHashMap<(Bits, usize), Option<Rc<List>>>,
}

impl<'a, 'p> Beam<'a, 'p> {
    pub(super) fn new(
        covers: &'a Covers<'p>,
        subunits: &'a [Subunit],
        rules: Rules,
        shape: Shape,
    ) -> Self {
        Self {
            stock: Stock::new(covers, subunits, rules),
            shape,
            greedy: FxHashMap::default(),
            best: FxHashMap::default(),
        }
    }

    /// The best trees for all rows, smallest first as far as costs tell.
    pub(super) fn trees(&mut self) -> Vec<Node> {
        let all = self.stock.covers.problem.all();
        let lists = self.beam(&all, self.shape.width, self.shape.depth);
        lists.iter().map(|list| self.stock.node(list)).collect()
    }

    /// The best finished selectors for these rows, cheapest first.
    fn beam(&mut self, rows: &Bits, width: usize, depth: usize) -> Vec<List> {
        let mut open = vec![Partial {
            list: List::default(),
            left: rows.clone(),
        }];
        let mut done: Vec<List> = Vec::new();
        done.extend(self.rest(rows).map(|list| self.stock.merged(&list)));
        while !open.is_empty() {
            let mut next: Vec<(Cost, Partial, Rc<List>)> = Vec::new();
            let mut seen: FxHashSet<(Bits, Cost)> = FxHashSet::default();
            for partial in &open {
                for step in self.steps(partial, depth) {
                    let left = partial.left.minus(&step.rows);
                    let cost = self.stock.cost(&step.child);
                    if !seen.insert((left.clone(), add(partial.list.cost, cost))) {
                        continue;
                    }
                    let Some(rest) = self.rest(&left) else {
                        continue;
                    };
                    let list = partial.list.with(step.child, cost);
                    let estimate = add(list.cost, rest.cost);
                    next.push((estimate, Partial { list, left }, rest));
                }
            }
            next.sort_by_key(|(estimate, ..)| *estimate);
            let finished = next.iter().take(width);
            done.extend(
                finished.map(|(_, partial, rest)| self.stock.merged(&partial.list.then(rest))),
            );
            next.retain(|(_, partial, _)| self.sole(&partial.left).is_none());
            next.truncate(width);
            open = next.into_iter().map(|(_, partial, _)| partial).collect();
        }
        done.sort_by_key(List::whole);
        done.dedup();
        done.truncate(FINALISTS);
        done
    }

    /// Every child that may stand next.
    fn steps(&mut self, partial: &Partial, depth: usize) -> Vec<Step> {
        let covers = self.stock.covers;
        let left = &partial.left;
        let mut steps = Vec::new();
        if self.sole(left).is_some() || !covers.affords(0) {
            return steps;
        }
        let subunits = self.stock.subunits;
        let mut standing = self.stock.rules.standing(covers, subunits, left);
        for (number, subunit) in subunits.iter().enumerate() {
            let own = subunit.rows.and(left);
            if own.is_empty() {
                continue;
            }
            if subunit.guards_itself {
                if own == subunit.rows {
                    let child = Rc::new(Child::Bare(number));
                    steps.push(Step { child, rows: own });
                }
                continue;
            }
            let of_this: Vec<&Standing> = standing.iter().filter(|s| s.subunit == number).collect();
            if let Some(rules) = self.stock.rules.covering(&of_this, &own)
                && rules.len() > 1
            {
                let child = Rc::new(Child::Ruled(number, rules));
                let rows = own.clone();
                steps.push(Step { child, rows });
            }
            let off = left.minus(&own);
            if depth == self.shape.depth && covers.may_minimise(&own, &off) {
                let child = Rc::new(Child::Guarded(number, covers.guard(&own, &off)));
                self.stock.rules.learn(covers, &covers.cover(&own, &off));
                steps.push(Step { child, rows: own });
            }
        }
        standing.sort_by_cached_key(|s| self.worth(s.rule, &s.rows));
        standing.truncate(NEXT_RULES);
        steps.extend(standing.into_iter().map(|s| Step {
            child: Rc::new(Child::Ruled(s.subunit, vec![s.rule])),
            rows: s.rows,
        }));
        if depth > 1 {
            steps.extend(self.groups(left, depth));
        }
        steps
    }

    /// Rules that decide many rows for their cost first.
    fn worth(&self, rule: usize, rows: &Bits) -> (Reverse<usize>, usize) {
        let literals = self.stock.rules.get(rule).map_or(0, |rule| rule.literals);
        // Rows by nodes, in 2520ths, so that small costs divide it.
        (Reverse(rows.count() * 2520 / (2 + literals)), rule)
    }

    /// Literals that let some, but not all of the rows through, and rows of several subunits, with the best selectors
    /// behind them.
    fn groups(&mut self, left: &Bits, depth: usize) -> Vec<Step> {
        let mut promising: Vec<(Cost, Cube, Bits)> = Vec::new();
        for cube in self.literals() {
            let covers = self.stock.covers;
            covers.spend(covers.words() * 4);
            let through = covers.problem.columns().cube_rows(&cube, left);
            if through.is_empty() || through == *left || self.sole(&through).is_some() {
                continue;
            }
            if self.cuts(&through, left) {
                continue;
            }
            let after = left.minus(&through);
            let (Some(inner), Some(rest)) = (self.rest(&through), self.rest(&after)) else {
                continue;
            };
            let cost = add(add(guarding(1), inner.whole()), rest.cost);
            promising.push((cost, cube, through));
        }
        promising.sort_by_key(|(cost, ..)| *cost);
        promising.truncate(NEXT_GROUPS);
        let groups = promising.into_iter().filter_map(|(_, cube, rows)| {
            let inner = self.inner(&rows, depth - 1)?;
            let child = Rc::new(Child::Group(cube, inner));
            Some(Step { child, rows })
        });
        groups.collect()
    }

    /// The literals that groups may stand behind: of all atoms while they are few, else those that rules ask.
    fn literals(&self) -> Vec<Cube> {
        let asked = self.stock.rules.asked();
        let both = asked.iter().flat_map(|atom| {
            [true, false].map(|positive| {
                Cube::new([Literal {
                    atom: *atom,
                    positive,
                }])
            })
        });
        both.collect()
    }

    /// Whether these rows are some, but not all of those that a memory node has left: it stands in one place only.
    fn cuts(&self, through: &Bits, left: &Bits) -> bool {
        self.stock.subunits.iter().any(|subunit| {
            let own = subunit.rows.and(left);
            !subunit.is_behavior() && !own.is_disjoint(through) && !own.is_subset(through)
        })
    }

    /// The best selector for rows below the root.
    fn inner(&mut self, rows: &Bits, depth: usize) -> Option<Rc<List>> {
        let key = (rows.clone(), depth);
        if let Some(known) = self.best.get(&key) {
            return known.clone();
        }
        let found = self.beam(rows, self.shape.inner, depth);
        let best = found.into_iter().next().map(Rc::new);
        self.best.insert(key, best.clone());
        best
    }

    /// What comes of always taking the rule that decides most rows for its cost; `None` where the rules do not suffice
    /// and the work is spent.
    fn rest(&mut self, rows: &Bits) -> Option<Rc<List>> {
        if let Some(known) = self.greedy.get(rows) {
            return known.clone();
        }
        let found = self.greedily(rows).map(Rc::new);
        self.greedy.insert(rows.clone(), found.clone());
        found
    }

    fn greedily(&self, rows: &Bits) -> Option<List> {
        let (stock, covers) = (&self.stock, self.stock.covers);
        let mut list = List::default();
        let mut left = rows.clone();
        while !left.is_empty() {
            if let Some(sole) = self.sole(&left) {
                let child = Child::Bare(sole);
                let cost = stock.cost(&child);
                return Some(list.with(Rc::new(child), cost));
            }
            let standing = stock.rules.standing(covers, stock.subunits, &left);
            let best = standing
                .into_iter()
                .min_by_key(|standing| self.worth(standing.rule, &standing.rows));
            let (child, rows) = match best {
                Some(best) => (Child::Ruled(best.subunit, vec![best.rule]), best.rows),
                None => self.whole(&left)?,
            };
            let cost = stock.cost(&child);
            list = list.with(Rc::new(child), cost);
            left.subtract(&rows);
        }
        Some(list)
    }

    /// The first subunit that may stand whole, where no rule stands.
    fn whole(&self, left: &Bits) -> Option<(Child, Bits)> {
        let covers = self.stock.covers;
        let mut subunits = self.stock.subunits.iter().enumerate();
        subunits.find_map(|(number, subunit)| {
            let own = subunit.rows.and(left);
            if own.is_empty() || subunit.guards_itself && own != subunit.rows {
                return None;
            }
            let off = left.minus(&own);
            let child = match subunit.guards_itself {
                true => Child::Bare(number),
                false if covers.may_minimise(&own, &off) => {
                    Child::Guarded(number, covers.guard(&own, &off))
                }
                false => return None,
            };
            Some((child, own))
        })
    }

    /// The subunit that holds all of the rows.
    fn sole(&self, rows: &Bits) -> Option<usize> {
        let subunits = &self.stock.subunits;
        subunits
            .iter()
            .position(|subunit| rows.is_subset(&subunit.rows))
    }
}
