//! Parts of a tree as tables of their own.
//!
//! What a group decides for the rows that reach it is a table, and so is what the end of a selector decides for the rows that its
//! beginning leaves. Such a table is smaller than the whole one, and what is found for it by itself may be smaller than what stands
//! there: atoms that are asked last in one part of a tree need not be so in another.

use super::core::part;
use super::problem::Problem;
use super::windows::{Windows, is_plain, replaced, selector_of};
use crate::ir::tree::Node;
use crate::logic::{Account, Bits};
use crate::tree::Size;
use crate::tree::guard::and;
use crate::tree::unit::{Unit, guarded, units};
use rustc_hash::FxHashMap;

/// The fewest nodes of a part for which a smaller tree is sought.
const FEWEST: usize = 10;
/// One part may take this part of what is left.
const PARTS: usize = 8;

/// Parts that are looked at on one account.
pub(super) struct Subtables<'a, 'p, F> {
    problem: &'a Problem<'p>,
    account: &'a Account,
    windows: Windows<'a, 'p>,
    /// Trees for a table.
    seek: F,
    /// The smallest tree for these rows.
    known: FxHashMap<Bits, Option<Node>>,
}

impl<'a, 'p, F: Fn(&Problem, &Account) -> Vec<Node>> Subtables<'a, 'p, F> {
    pub(super) fn new(problem: &'a Problem<'p>, account: &'a Account, seek: F) -> Self {
        Self {
            problem,
            account,
            windows: Windows::new(problem, account),
            seek,
            known: FxHashMap::default(),
        }
    }

    /// The tree with a smaller one in the place of every part that has one, as far as the account goes; `None` if there are none. A
    /// tree with memory is left as it is.
    pub(super) fn smaller(&mut self, tree: &Node) -> Option<Node> {
        if self.problem.wide || !is_plain(tree) {
            return None;
        }
        let all = self.problem.all();
        let next = |tree: &Node| self.with_one(tree, &all);
        std::iter::successors(Some(tree.clone()), next)
            .skip(1)
            .last()
    }

    /// The tree with one part smaller.
    fn with_one(&mut self, node: &Node, rows: &Bits) -> Option<Node> {
        let children = units(node)?;
        let mut reaching = rows.clone();
        let mut reached = Vec::new();
        for unit in &children {
            if self.account.is_spent() {
                return None;
            }
            let through = self.windows.holds(&unit.guard, &reaching);
            let left = self.windows.left(unit, &reaching, &mut None);
            reached.push((std::mem::replace(&mut reaching, left), through));
        }
        for (at, (unit, (_, through))) in children.iter().zip(&reached).enumerate() {
            if let Some(body) = self.with_one(&unit.body, through) {
                let body = Unit::of(&body);
                let unit = guarded(and([unit.guard.clone(), body.guard]), body.body);
                return Some(replaced(&children, at, at + 1, vec![unit]));
            }
        }
        // What lets rows through to what follows is no table of its own.
        if !reaching.is_empty() {
            return None;
        }
        for (from, (reaching, _)) in reached.iter().enumerate() {
            let end = selector_of(children.get(from..)?);
            let before = Size::of(&end).nodes;
            let whole = reaching.count() == self.problem.columns().rows();
            if before < FEWEST || whole || self.account.is_spent() {
                continue;
            }
            let found = self.found(reaching);
            if let Some(found) = found.filter(|found| Size::of(found).nodes < before) {
                return Some(replaced(&children, from, children.len(), vec![found]));
            }
        }
        None
    }

    /// The smallest tree for these rows.
    fn found(&mut self, rows: &Bits) -> Option<Node> {
        if let Some(known) = self.known.get(rows) {
            return known.clone();
        }
        let own = self.account.part(PARTS);
        let policy = part(self.problem.policy, rows);
        let table = Problem::new(&policy);
        let trees = (self.seek)(&table, &own).into_iter();
        let best = trees.min_by_key(Size::of);
        self.account.settle(&own);
        self.known.insert(rows.clone(), best.clone());
        best
    }
}

#[cfg(test)]
mod tests {
    use super::Subtables;
    use crate::ir::Id;
    use crate::ir::tree::{Atom, Guard, Node};
    use crate::logic::Account;
    use crate::policy::{Minterm, Policy, Row};
    use crate::tree::Size;
    use crate::tree::decanonicalise::optimum::optimum;
    use crate::tree::decanonicalise::problem::Problem;
    use crate::tree::guard::{and, not};
    use crate::tree::unit::{guarded, selector};

    #[test]
    fn what_a_group_decides_is_a_table() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| Guard::Atom(Atom::Predicate(Id::new(i))));
        let [one, two, three] = [0, 1, 2].map(|i| Node::Behavior(Id::new(i)));
        let group = |children: Vec<Node>| guarded(a.clone(), selector(children));
        let end = [guarded(d.clone(), three.clone()), one.clone()];
        let with = |inner: Vec<Node>| selector([group(inner)].into_iter().chain(end.clone()));
        let loose = with(vec![
            guarded(and([b.clone(), c.clone()]), one.clone()),
            guarded(and([b.clone(), not(c)]), one.clone()),
            guarded(d, two.clone()),
            two.clone(),
        ]);
        let rows = (0..16_usize).map(|row| {
            let [a, b, _, d] = [8, 4, 2, 1].map(|bit| row & bit != 0);
            let does = match (a, b, d) {
                (true, true, _) | (false, _, false) => 0,
                (true, false, _) => 1,
                (false, _, true) => 2,
            };
            Row {
                minterm: Minterm::new([8, 4, 2, 1].map(|bit| row & bit != 0)),
                free: None,
                behavior: Id::new(does),
                visits: 0,
                values: Vec::new(),
            }
        });
        let policy = Policy {
            atoms: (0..4).map(|i| Atom::Predicate(Id::new(i))).collect(),
            behaviors: (0..3).map(Id::new).collect(),
            rows: rows.collect(),
            ..Policy::default()
        };
        let problem = Problem::new(&policy);
        let account = Account::unlimited();
        let seek =
            |table: &Problem, account: &Account| optimum(table, account).into_iter().collect();
        let found = Subtables::new(&problem, &account, seek)
            .smaller(&loose)
            .unwrap();
        assert!(problem.proves(&loose) && problem.proves(&found));
        let smallest = with(vec![guarded(b, one), two]);
        assert_eq!(Size::of(&found), Size::of(&smallest));
    }
}
