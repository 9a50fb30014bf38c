//! The rows of a large table that a search works on.

use super::alone::{REACH, SEARCHED, THOROUGH, WHOLE};
use super::children::Children;
use super::problem::Problem;
use crate::ir::tree::Node;
use crate::logic::covering::{Grouped, Known, List, Regroup, lists};
use crate::logic::{Account, Bits};
use crate::policy::Policy;
use crate::tree::Size;

/// The rows of the first core.
const FIRST: usize = 512;
/// A list with fewer nodes than one for so many rows says that the table has structure.
const RARE: usize = 8;
/// Attempts at a smaller list before it is tried on all rows.
const QUICK: usize = 40;
/// One part in so many of an account is kept to make a list right on all rows.
const KEPT: usize = 4;

/// Some rows of a table.
pub(super) struct Core<'a, 'p> {
    problem: &'a Problem<'p>,
    pub(super) rows: Bits,
    /// The smallest list for some rows that no account went far enough to make right on all of them.
    pub(super) unfinished: Option<Grouped>,
}

impl<'a, 'p> Core<'a, 'p> {
    /// Rows of every behaviour, evenly spread; all of a small table.
    pub(super) fn first(problem: &'a Problem<'p>) -> Self {
        let count = problem.policy.rows.len();
        if count <= WHOLE || problem.wide {
            let rows = Bits::full(count);
            return Self {
                problem,
                rows,
                unfinished: None,
            };
        }
        let mut rows = Bits::empty(count);
        for (_, own) in &problem.on {
            let size = own.count();
            let wanted = (FIRST * size).div_ceil(count).max(8);
            let step = size.div_ceil(wanted).max(1);
            rows.unite(&Bits::collect(count, own.iter().step_by(step)));
        }
        Self {
            problem,
            rows,
            unfinished: None,
        }
    }

    pub(super) fn policy(&self) -> Policy {
        part(self.problem.policy, &self.rows)
    }

    /// Lists for cores that grow until lists are right on all rows, first quickly, then thoroughly: those that are; `None` where no list
    /// is found at all.
    pub(super) fn lists(&mut self, known: &mut Known, account: &Account) -> Option<Vec<List>> {
        let mut right = Vec::new();
        let mut patience = QUICK;
        loop {
            let policy = self.policy();
            let sample = Problem::new(&policy);
            let (columns, classes) = (sample.columns(), sample.classes());
            let found = lists(columns, &classes, REACH, patience, known, account);
            let best = found.into_iter().last();
            let node = |list: &List| Children::listed(&sample, list).node();
            match best.map(|best| (self.adopt(&node(&best), account), best)) {
                Some((true, best)) => {
                    right.push(best);
                    if patience == THOROUGH {
                        return Some(right);
                    }
                    patience = THOROUGH;
                }
                Some((false, _)) => {}
                None if right.is_empty() => return None,
                None => return Some(right),
            }
            let rows = self.rows.count();
            let structured = known
                .list
                .as_ref()
                .is_some_and(|list| list.nodes() * RARE < rows);
            if account.is_spent() || rows > SEARCHED && !structured {
                return Some(right);
            }
        }
    }

    /// A list with groups for cores that grow until it is right on all rows, as a tree; `None` where the account does not go so far.
    /// Each begins with what an earlier one can keep, and ends where so many attempts find no smaller one. A part of the account is
    /// kept to make the last one right on all rows.
    pub(super) fn groups(
        &mut self,
        mut list: Grouped,
        patience: usize,
        known: &mut Known,
        account: &Account,
    ) -> Option<Node> {
        if self.problem.wide {
            return None;
        }
        while !account.is_spent() {
            let policy = self.policy();
            let sample = Problem::new(&policy);
            let (columns, classes) = (sample.columns(), sample.classes());
            let part = match self.rows.count() == self.problem.policy.rows.len() {
                true => account.part(1),
                false => account.but(KEPT),
            };
            let found = Regroup::new(columns, &classes, &part).smaller(&list, patience, known);
            account.settle(&part);
            list = found?;
            let tree = Children::grouped(&sample, &list).node();
            if self.adopt(&tree, account) {
                return Some(tree);
            }
            if part.is_spent() {
                break;
            }
        }
        if account.is_spent() {
            self.leave(list);
            return None;
        }
        let (columns, classes) = (self.problem.columns(), self.problem.classes());
        let Some(right) = Regroup::new(columns, &classes, account).smaller(&list, 0, known) else {
            self.leave(list);
            return None;
        };
        Some(Children::grouped(self.problem, &right).node())
    }

    fn leave(&mut self, list: Grouped) {
        let nodes = |list: &Grouped| list.nodes();
        if self
            .unfinished
            .as_ref()
            .is_none_or(|other| list.nodes() < nodes(other))
        {
            self.unfinished = Some(list);
        }
    }

    /// Whether the tree is right on all rows. Else some rows on which it is wrong join the core.
    pub(super) fn adopt(&mut self, tree: &Node, account: &Account) -> bool {
        account.spend(Size::of(tree).nodes as u64 * self.problem.words());
        let Some(wrong) = self.problem.wrong(tree) else {
            return false;
        };
        let count = wrong.count();
        let most = (self.rows.count() / 2).max(1);
        let step = count.div_ceil(most).max(1);
        self.rows
            .unite(&Bits::collect(wrong.bound(), wrong.iter().step_by(step)));
        let all = self.problem.policy.rows.len();
        if 2 * self.rows.count() > all {
            self.rows = Bits::full(all);
        }
        count == 0
    }
}

/// Some rows of a policy, as a policy.
pub(super) fn part(whole: &Policy, rows: &Bits) -> Policy {
    let rows = rows.iter();
    Policy {
        atoms: whole.atoms.clone(),
        behaviors: whole.behaviors.clone(),
        history: whole.history,
        rows: rows
            .filter_map(|row| whole.rows.get(row).cloned())
            .collect(),
        fields: whole.fields.clone(),
        ..Policy::default()
    }
}
