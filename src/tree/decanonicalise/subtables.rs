//! Parts of a tree as tables of their own.
//!
//! What a group decides for the rows that reach it is a table, and so is what the end of a selector decides for the rows that its
//! beginning leaves. Such a table is smaller than the whole one, and what is found for it by itself may be smaller than what stands
//! there: atoms that are asked last in one part of a tree need not be so in another.

use super::core::part;
use super::problem::Problem;
use super::reach::{Parts, Reach, Reached, replaced, selector_of};
use crate::ir::tree::Node;
use crate::logic::{Account, Bits};
use crate::tree::Size;
use crate::tree::unit::Unit;
use rustc_hash::FxHashMap;

/// The fewest nodes of a part for which a smaller tree is sought.
const FEWEST: usize = 10;
/// One part may take this part of what is left.
const PARTS: usize = 8;

/// Parts that are looked at on one account.
pub(super) struct Subtables<'a, 'p, F> {
    reach: Reach<'a, 'p>,
    /// Trees for a table.
    seek: F,
    /// The smallest tree for these rows.
    known: FxHashMap<Bits, Option<Node>>,
}

impl<'a, 'p, F: Fn(&Problem, &Account) -> Vec<Node>> Subtables<'a, 'p, F> {
    pub(super) fn new(problem: &'a Problem<'p>, account: &'a Account, seek: F) -> Self {
        Self {
            reach: Reach::new(problem, account),
            seek,
            known: FxHashMap::default(),
        }
    }

    /// The smallest tree for these rows.
    fn found(&mut self, rows: &Bits) -> Option<Node> {
        if let Some(known) = self.known.get(rows) {
            return known.clone();
        }
        let Reach { problem, account } = self.reach;
        let own = account.part(PARTS);
        let policy = part(problem.policy, rows);
        let table = Problem::new(&policy);
        let trees = (self.seek)(&table, &own).into_iter();
        let best = trees.min_by_key(Size::of);
        account.settle(&own);
        self.known.insert(rows.clone(), best.clone());
        best
    }
}

impl<'a, 'p: 'a, F: Fn(&Problem, &Account) -> Vec<Node>> Parts<'a, 'p> for Subtables<'a, 'p, F> {
    fn reach(&self) -> &Reach<'a, 'p> {
        &self.reach
    }

    fn here(&mut self, units: &[Unit], reached: &Reached) -> Option<Node> {
        // What lets rows through to what follows is no table of its own.
        if !reached.rest.is_empty() {
            return None;
        }
        let Reach { problem, account } = self.reach;
        for (from, (rows, _)) in reached.units.iter().enumerate() {
            let end = selector_of(units.get(from..)?);
            let before = Size::of(&end).nodes;
            let whole = rows.count() == problem.columns().rows();
            if before < FEWEST || whole || account.is_spent() {
                continue;
            }
            let found = self.found(rows);
            if let Some(found) = found.filter(|found| Size::of(found).nodes < before) {
                return Some(replaced(units, from, units.len(), vec![found]));
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{Parts, Subtables};
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
