//! A policy as sets of rows.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Guard, Node};
use crate::logic::{Bits, Columns, Cover, minimise};
use crate::policy::Policy;
use crate::tree::formula;
use crate::tree::prove::prove;
use rustc_hash::FxHashMap;
use std::cell::{Cell, RefCell};

/// A policy with its care minterms as rows of a table.
pub(super) struct Problem<'a> {
    pub(super) policy: &'a Policy,
    pub(super) columns: Columns,
    /// minterms(B) of every behaviour that is chosen somewhere, in the order of `choose`.
    pub(super) on: Vec<(Id<Behavior>, Bits)>,
    known: RefCell<FxHashMap<(Bits, Bits), Cover>>,
    /// Work that minimisation has taken: seeds × atoms × words of rows.
    pub(super) effort: Cell<usize>,
}

impl<'a> Problem<'a> {
    pub(super) fn new(policy: &'a Policy) -> Self {
        let rows = policy.rows.iter().map(|row| row.minterm.words());
        let mut order = policy.behaviors.clone();
        for row in &policy.rows {
            if !order.contains(&row.behavior) {
                order.push(row.behavior);
            }
        }
        let count = policy.rows.len();
        let on = order.into_iter().map(|behavior| {
            let chosen = policy.rows.iter().enumerate();
            let chosen = chosen.filter(|(_, row)| row.behavior == behavior);
            (behavior, Bits::collect(count, chosen.map(|(i, _)| i)))
        });
        Self {
            policy,
            columns: Columns::new(policy.atoms.len(), rows),
            on: on.filter(|(_, rows)| !rows.is_empty()).collect(),
            known: RefCell::default(),
            effort: Cell::new(0),
        }
    }

    /// All rows.
    pub(super) fn all(&self) -> Bits {
        Bits::full(self.columns.rows())
    }

    /// A smallest guard for `on` against `off`.
    pub(super) fn cover(&self, on: &Bits, off: &Bits) -> Cover {
        let key = (on.clone(), off.clone());
        if let Some(cover) = self.known.borrow().get(&key) {
            return cover.clone();
        }
        self.effort
            .set(self.effort.get() + on.count() + off.count());
        let cover = minimise(&self.columns, on, off);
        self.known.borrow_mut().insert(key, cover.clone());
        cover
    }

    /// A cover as a guard.
    pub(super) fn guard(&self, cover: &Cover) -> Guard {
        formula::cover(cover, &self.policy.atoms)
    }

    /// The rows in which an atom holds; `None` if the policy does not observe it.
    pub(super) fn column(&self, atom: Atom) -> Option<&Bits> {
        let at = self.policy.atoms.iter().position(|a| *a == atom)?;
        self.columns.iter().nth(at).map(|(_, column)| column)
    }

    /// Whether the tree is proved to take the policy's decisions.
    pub(super) fn proves(&self, root: &Node) -> bool {
        prove(root, self.policy).is_ok()
    }
}
