//! Windows: neighbouring children of a selector, replaced by the smallest that decide as they do on the rows that reach them.
//!
//! The rows that reach a window fall into few kinds where there are few of them, or where the window asks few atoms: rows of a
//! kind are alike in these. What a window decides is a body for each kind: behaviours, groups as they stand, and what follows
//! the window. [`Division`] finds the smallest list that does the same, so a tree to which nothing more is done is smallest in
//! each of its windows.

use super::optimum::Division;
use super::problem::Problem;
use super::reach::{Decided, Parts, Reach, Reached, push, replaced, selector_of};
use crate::ir::tree::Node;
use crate::logic::{Account, Bits};
use crate::tree::Size;
use crate::tree::atoms::atoms;
use crate::tree::unit::{Unit, selector};
use rustc_hash::FxHashMap;

/// The most kinds of rows, and children of a window that others follow.
const KINDS: usize = 12;
const CHILDREN: usize = 8;
/// The work of copying a child and counting its nodes.
const COPY: u64 = 50;
/// One window may take this part of what is left.
const WINDOWS: u64 = 16;

/// What a window comes to: the sets of kinds in which its atoms hold, and for each of its bodies the nodes and the kinds.
type Key = (Vec<usize>, Vec<(usize, usize)>);

/// Windows that are looked at on one account.
pub(super) struct Windows<'a, 'p> {
    reach: Reach<'a, 'p>,
    /// The nodes of the smallest lists.
    known: FxHashMap<Key, usize>,
}

impl<'a, 'p> Windows<'a, 'p> {
    pub(super) fn new(problem: &'a Problem<'p>, account: &'a Account) -> Self {
        Self {
            reach: Reach::new(problem, account),
            known: FxHashMap::default(),
        }
    }

    /// The tree with every window as small as it can be, as far as the account goes; `None` if that is no smaller. A tree with
    /// memory is left as it is.
    pub(super) fn tightened(&mut self, tree: &Node) -> Option<Node> {
        self.smaller(tree)
    }

    /// Fewer children for a window and all that follows it.
    fn window(
        &mut self,
        children: &[Unit],
        from: usize,
        to: usize,
        rows: &Bits,
    ) -> Option<Vec<Node>> {
        let own = children.get(from..to)?;
        let after = children.get(to..)?;
        // What follows is copied and counted, whatever becomes of the window.
        let copied = (children.len() - from) as u64 * COPY;
        self.reach.account.spend(copied);
        if self.reach.account.is_spent() {
            return None;
        }
        for whole in [false, true] {
            let mut decided = Some(Decided::new());
            let mut left = rows.clone();
            for unit in own {
                left = match whole {
                    true => self.reach.left_by_all(unit, &left, &mut decided),
                    false => self.reach.left(unit, &left, &mut decided),
                };
            }
            let mut decided = decided?;
            match (left.is_empty(), after.is_empty()) {
                (true, _) => {}
                (false, true) => return None,
                (false, false) => push(&mut decided, selector_of(after), left),
            }
            let before = Size::of(&selector_of(children.get(from..)?)).nodes;
            let single = children.len() - from == 1;
            let before = before - usize::from(!single);
            if let Some(list) = self.divided(own, decided, rows, before) {
                return Some(list);
            }
        }
        None
    }

    /// A list of fewer nodes that decides so.
    fn divided(
        &mut self,
        own: &[Unit],
        decided: Decided,
        rows: &Bits,
        before: usize,
    ) -> Option<Vec<Node>> {
        let Reach { problem, account } = self.reach;
        let most = (1..=KINDS).rev().find(|kinds| {
            let work = Division::work(*kinds).saturating_mul(WINDOWS);
            account.affords(work)
        })?;
        let asked = match rows.count() <= most {
            true => problem.policy.atoms.clone(),
            false => {
                let own = own.iter().map(|unit| unit.clone().node());
                atoms(&selector(own)).into_iter().collect()
            }
        };
        let kinds = problem.kinds(rows, &asked, most, account)?;
        let kinds_of = |set: &Bits| {
            let kinds = kinds.iter().enumerate();
            let own = kinds.filter(|(_, kind)| !kind.is_disjoint(set));
            own.fold(0, |all, (kind, _)| all | 1 << kind)
        };
        let columns: Option<Vec<usize>> = asked
            .iter()
            .map(|atom| Some(kinds_of(problem.column(*atom)?)))
            .collect();
        let columns = columns?;
        let bodies = decided.iter();
        let bodies: Vec<(Node, usize)> = bodies
            .map(|(node, rows)| (node.clone(), kinds_of(rows)))
            .collect();
        let sizes = bodies.iter();
        let sizes = sizes.map(|(node, kinds)| (Size::of(node).nodes, *kinds));
        let key = (columns.clone(), sizes.collect());
        if self.known.get(&key).is_some_and(|nodes| *nodes >= before) {
            return None;
        }
        account.spend(Division::work(kinds.len()));
        let division = Division::new(kinds.len(), columns, bodies);
        self.known.insert(key, division.nodes());
        (division.nodes() < before).then(|| division.children(&asked))
    }
}

impl<'a, 'p> Parts<'a, 'p> for Windows<'a, 'p> {
    fn reach(&self) -> &Reach<'a, 'p> {
        &self.reach
    }

    fn here(&mut self, units: &[Unit], reached: &Reached) -> Option<Node> {
        let last = units.len();
        reached
            .units
            .iter()
            .enumerate()
            .find_map(|(from, (rows, _))| {
                let near = (from + 2..last).take(CHILDREN);
                let mut ends = near.chain([last]);
                let list = ends.find_map(|to| self.window(units, from, to, rows))?;
                Some(replaced(units, from, last, list))
            })
    }
}

#[cfg(test)]
mod tests {
    use super::Windows;
    use crate::ir::Id;
    use crate::ir::tree::{Atom, Guard, Node};
    use crate::logic::Account;
    use crate::policy::{Minterm, Policy, Row};
    use crate::tree::Size;
    use crate::tree::decanonicalise::problem::Problem;
    use crate::tree::guard::{and, not};
    use crate::tree::unit::{guarded, selector};

    /// `selector { d and e => go, a and b => one, a and not b => two, not a and c => one, three }`
    fn loose() -> Node {
        let [a, b, c, d, e] = [0, 1, 2, 3, 4].map(|i| Guard::Atom(Atom::Predicate(Id::new(i))));
        let [one, two, three, go] = [1, 2, 3, 4].map(|i| Node::Behavior(Id::new(i)));
        selector([
            guarded(and([d, e]), go),
            guarded(and([a.clone(), b.clone()]), one.clone()),
            guarded(and([a.clone(), not(b)]), two),
            guarded(and([not(a), c]), one),
            three,
        ])
    }

    #[test]
    fn a_window_of_few_atoms_becomes_the_smallest_list() {
        let rows = (0..32).map(|number| {
            let [a, b, c, d, e] = [16, 8, 4, 2, 1].map(|bit| number & bit != 0);
            let does = match (a, b, c, d && e) {
                (.., true) => 4,
                (true, true, ..) | (false, _, true, _) => 1,
                (true, false, ..) => 2,
                (false, _, false, _) => 3,
            };
            Row {
                minterm: Minterm::new([a, b, c, d, e]),
                free: None,
                behavior: Id::new(does),
                visits: 0,
                values: Vec::new(),
            }
        });
        let policy = Policy {
            atoms: (0..5).map(|i| Atom::Predicate(Id::new(i))).collect(),
            behaviors: (1..5).map(Id::new).collect(),
            rows: rows.collect(),
            ..Policy::default()
        };
        let problem = Problem::new(&policy);
        let account = Account::unlimited();
        let mut windows = Windows::new(&problem, &account);
        let tight = windows.tightened(&loose()).unwrap();
        assert!(problem.proves(&loose()) && problem.proves(&tight));
        // … `a and not b => two, not a and not c => three, one`
        assert_eq!((Size::of(&loose()).nodes, Size::of(&tight).nodes), (18, 14));
        assert!(windows.tightened(&tight).is_none());
    }
}
