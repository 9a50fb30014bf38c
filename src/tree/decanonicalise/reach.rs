//! Which rows reach the parts of a tree of selectors, and the walk through the parts that makes one after another smaller.

use super::problem::Problem;
use crate::ir::tree::{Guard, Node};
use crate::logic::{Account, Bits};
use crate::tree::guard::and;
use crate::tree::unit::{Unit, guarded, selector, units};

/// Whether a tree is made of selectors, units and behaviours alone.
fn is_plain(node: &Node) -> bool {
    match units(node) {
        Some(units) => units.iter().all(|unit| is_plain(&unit.body)),
        None => matches!(node, Node::Behavior(_)),
    }
}

/// What decides some rows.
pub(super) type Decided = Vec<(Node, Bits)>;

/// What reaches the units of a selector.
pub(super) struct Reached {
    /// The rows that come to each unit, and those of them that its guard lets through.
    pub(super) units: Vec<(Bits, Bits)>,
    /// The rows that none decides.
    pub(super) rest: Bits,
}

/// What makes parts of a tree smaller.
pub(super) trait Parts<'a, 'p: 'a> {
    /// What reads which rows reach a part.
    fn reach(&self) -> &Reach<'a, 'p>;

    /// The selector of these units with one part smaller; what stands within a unit is looked at by itself.
    fn here(&mut self, units: &[Unit], reached: &Reached) -> Option<Node>;

    /// The tree with smaller parts in the places of others, the innermost first, as far as the account goes; `None` if there are
    /// none. A tree with memory is left as it is.
    fn smaller(&mut self, tree: &Node) -> Option<Node> {
        let problem = self.reach().problem;
        if problem.wide || !is_plain(tree) {
            return None;
        }
        let all = problem.all();
        let next = |tree: &Node| self.with_one(tree, &all);
        std::iter::successors(Some(tree.clone()), next)
            .skip(1)
            .last()
    }

    /// The tree with one part smaller.
    fn with_one(&mut self, node: &Node, rows: &Bits) -> Option<Node> {
        let units = units(node)?;
        let reached = self.reach().of(&units, rows)?;
        for (at, (unit, (_, through))) in units.iter().zip(&reached.units).enumerate() {
            if let Some(body) = self.with_one(&unit.body, through) {
                let body = Unit::of(&body);
                let unit = guarded(and([unit.guard.clone(), body.guard]), body.body);
                return Some(replaced(&units, at, at + 1, vec![unit]));
            }
        }
        self.here(&units, &reached)
    }
}

/// Reads which rows reach a part, on one account.
#[derive(Clone, Copy)]
pub(super) struct Reach<'a, 'p> {
    pub(super) problem: &'a Problem<'p>,
    pub(super) account: &'a Account,
}

impl<'a, 'p> Reach<'a, 'p> {
    pub(super) fn new(problem: &'a Problem<'p>, account: &'a Account) -> Self {
        Self { problem, account }
    }

    /// What reaches these units of a selector to which these rows come; `None` if the account is spent.
    fn of(&self, units: &[Unit], rows: &Bits) -> Option<Reached> {
        let mut rest = rows.clone();
        let mut reached = Vec::new();
        for unit in units {
            if self.account.is_spent() {
                return None;
            }
            let through = self.holds(&unit.guard, &rest);
            let left = self.left(unit, &rest, &mut None);
            reached.push((std::mem::replace(&mut rest, left), through));
        }
        Some(Reached {
            units: reached,
            rest,
        })
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
    pub(super) fn left_by_all(
        &self,
        unit: &Unit,
        rows: &Bits,
        decided: &mut Option<Decided>,
    ) -> Bits {
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
    fn holds(&self, guard: &Guard, among: &Bits) -> Bits {
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
pub(super) fn push(decided: &mut Decided, node: Node, rows: Bits) {
    if rows.is_empty() {
        return;
    }
    match decided.iter_mut().find(|(known, _)| *known == node) {
        Some((_, own)) => own.unite(&rows),
        None => decided.push((node, rows)),
    }
}

/// The selector of these units.
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
