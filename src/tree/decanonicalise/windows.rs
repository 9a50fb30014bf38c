//! Windows: neighbouring children of a selector, replaced by the smallest that decide as they do on the rows that reach them.
//!
//! The rows that reach a window fall into few kinds where there are few of them, or where the window asks few atoms: rows of a
//! kind are alike in these. What a window decides is a body for each kind: behaviours, groups as they stand, and what follows
//! the window. [`Division`] finds the smallest list that does the same, so a tree to which nothing more is done is smallest in
//! each of its windows.

use super::optimum::Division;
use super::problem::Problem;
use crate::ir::tree::{Guard, Node};
use crate::logic::{Account, Bits};
use crate::tree::Size;
use crate::tree::atoms::atoms;
use crate::tree::guard::and;
use crate::tree::unit::{Unit, guarded, selector, units};
use rustc_hash::FxHashMap;

/// The most kinds of rows, and children of a window that others follow.
const KINDS: usize = 12;
const CHILDREN: usize = 8;
/// One window may take this part of what is left.
const WINDOWS: u64 = 16;

/// Whether a tree is made of selectors, units and behaviours alone.
pub(super) fn is_plain(node: &Node) -> bool {
    match units(node) {
        Some(units) => units.iter().all(|unit| is_plain(&unit.body)),
        None => matches!(node, Node::Behavior(_)),
    }
}

/// What decides some rows.
type Decided = Vec<(Node, Bits)>;

/// What a window comes to: the sets of kinds in which its atoms hold, and for each of its bodies the nodes and the kinds.
type Key = (Vec<usize>, Vec<(usize, usize)>);

/// Windows that are looked at on one account.
pub(super) struct Windows<'a, 'p> {
    problem: &'a Problem<'p>,
    account: &'a Account,
    /// The nodes of the smallest lists.
    known: FxHashMap<Key, usize>,
}

impl<'a, 'p> Windows<'a, 'p> {
    pub(super) fn new(problem: &'a Problem<'p>, account: &'a Account) -> Self {
        Self {
            problem,
            account,
            known: FxHashMap::default(),
        }
    }

    /// The tree with every window as small as it can be, as far as the account goes; `None` if that is no smaller. A tree with
    /// memory is left as it is.
    pub(super) fn tightened(&mut self, tree: &Node) -> Option<Node> {
        if self.problem.wide || !is_plain(tree) {
            return None;
        }
        let all = self.problem.all();
        let next = |tree: &Node| self.smaller(tree, &all);
        std::iter::successors(Some(tree.clone()), next)
            .skip(1)
            .last()
    }

    /// The tree with one window smaller.
    fn smaller(&mut self, node: &Node, rows: &Bits) -> Option<Node> {
        let children = units(node)?;
        let mut reaching = rows.clone();
        let mut reached = Vec::new();
        for unit in &children {
            if self.account.is_spent() {
                return None;
            }
            let through = self.holds(&unit.guard, &reaching);
            let left = self.left(unit, &reaching, &mut None);
            reached.push((std::mem::replace(&mut reaching, left), through));
        }
        for (at, (unit, (_, through))) in children.iter().zip(&reached).enumerate() {
            if let Some(body) = self.smaller(&unit.body, through) {
                let body = Unit::of(&body);
                let guard = and([unit.guard.clone(), body.guard]);
                let unit = guarded(guard, body.body);
                return Some(replaced(&children, at, at + 1, vec![unit]));
            }
        }
        for (from, (rows, _)) in reached.iter().enumerate() {
            let last = children.len();
            let near = (from + 2..last).take(CHILDREN);
            for to in near.chain([last]) {
                if let Some(list) = self.window(&children, from, to, rows) {
                    return Some(replaced(&children, from, last, list));
                }
            }
        }
        None
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
        for whole in [false, true] {
            let mut decided = Some(Decided::new());
            let mut left = rows.clone();
            for unit in own {
                left = match whole {
                    true => self.left_by_all(unit, &left, &mut decided),
                    false => self.left(unit, &left, &mut decided),
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
        let most = (1..=KINDS).rev().find(|kinds| {
            let work = Division::work(*kinds).saturating_mul(WINDOWS);
            self.account.affords(work)
        })?;
        let asked = match rows.count() <= most {
            true => self.problem.policy.atoms.clone(),
            false => {
                let own = own.iter().map(|unit| unit.clone().node());
                atoms(&selector(own)).into_iter().collect()
            }
        };
        let kinds = self.problem.kinds(rows, &asked, most, self.account)?;
        let kinds_of = |set: &Bits| {
            let kinds = kinds.iter().enumerate();
            let own = kinds.filter(|(_, kind)| !kind.is_disjoint(set));
            own.fold(0, |all, (kind, _)| all | 1 << kind)
        };
        let columns: Option<Vec<usize>> = asked
            .iter()
            .map(|atom| Some(kinds_of(self.problem.column(*atom)?)))
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
        self.account.spend(Division::work(kinds.len()));
        let division = Division::new(kinds.len(), columns, bodies);
        self.known.insert(key, division.nodes());
        (division.nodes() < before).then(|| division.children(&asked))
    }

    /// The rows that a unit leaves. What decides the others is told, a group that leaves none as it stands.
    pub(super) fn left(&self, unit: &Unit, rows: &Bits, decided: &mut Option<Decided>) -> Bits {
        let through = self.holds(&unit.guard, rows);
        let inner = self.left_by(&unit.body, &through, &mut None);
        if !inner.is_empty() {
            return self.left_by_all(unit, rows, decided);
        }
        let left = rows.minus(&through);
        if let Some(decided) = decided {
            push(decided, unit.body.clone(), through);
        }
        left
    }

    /// The same; what stands in groups is told each by itself.
    fn left_by_all(&self, unit: &Unit, rows: &Bits, decided: &mut Option<Decided>) -> Bits {
        let through = self.holds(&unit.guard, rows);
        let left = self.left_by(&unit.body, &through, decided);
        rows.minus(&through).or(&left)
    }

    fn left_by(&self, body: &Node, rows: &Bits, decided: &mut Option<Decided>) -> Bits {
        match (units(body), decided) {
            (Some(units), decided) => units.iter().fold(rows.clone(), |left, unit| {
                self.left_by_all(unit, &left, decided)
            }),
            (None, decided) => {
                if let Some(decided) = decided {
                    push(decided, body.clone(), rows.clone());
                }
                Bits::empty(self.problem.policy.rows.len())
            }
        }
    }

    /// The rows among these on which a guard holds.
    pub(super) fn holds(&self, guard: &Guard, among: &Bits) -> Bits {
        self.spend(1);
        match guard {
            Guard::Const(true) => among.clone(),
            Guard::Const(false) => Bits::empty(self.problem.policy.rows.len()),
            Guard::Atom(atom) => match self.problem.column(*atom) {
                Some(column) => among.and(column),
                None => Bits::empty(self.problem.policy.rows.len()),
            },
            Guard::Not(inner) => among.minus(&self.holds(inner, among)),
            Guard::And(parts) => parts
                .iter()
                .fold(among.clone(), |left, part| self.holds(part, &left)),
            Guard::Or(parts) => {
                let none = Bits::empty(self.problem.policy.rows.len());
                let parts = parts.iter();
                parts.fold(none, |all, part| all.or(&self.holds(part, among)))
            }
        }
    }

    fn spend(&self, operations: u64) {
        self.account.spend(self.problem.words() * operations);
    }
}

/// Some rows to a body, with those that it has.
fn push(decided: &mut Decided, node: Node, rows: Bits) {
    if rows.is_empty() {
        return;
    }
    match decided.iter_mut().find(|(known, _)| *known == node) {
        Some((_, own)) => own.unite(&rows),
        None => decided.push((node, rows)),
    }
}

pub(super) fn selector_of(units: &[Unit]) -> Node {
    selector(units.iter().cloned().map(Unit::node))
}

/// The selector of these units with others in the place of some.
pub(super) fn replaced(units: &[Unit], from: usize, to: usize, by: Vec<Node>) -> Node {
    let node = |unit: &Unit| unit.clone().node();
    let before = units.iter().take(from).map(node);
    let after = units.iter().skip(to).map(node);
    selector(before.chain(by).chain(after))
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
