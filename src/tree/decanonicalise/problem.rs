//! A policy as sets of rows.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use crate::logic::{Bits, Columns};
use crate::policy::Policy;
use crate::tree::prove::Prover;
use rustc_hash::FxHashMap;

/// A policy with its care minterms as rows of a table.
pub(super) struct Problem<'a> {
    pub(super) policy: &'a Policy,
    /// minterms(B) of every behaviour that is chosen somewhere, in the order of `choose`.
    pub(super) on: Vec<(Id<Behavior>, Bits)>,
    /// Whether some rows stand for more than one minterm.
    pub(super) wide: bool,
    prover: Prover<'a>,
}

impl<'a> Problem<'a> {
    pub(super) fn new(policy: &'a Policy) -> Self {
        let mut on: Vec<(Id<Behavior>, Bits)> = Vec::new();
        let mut numbers: FxHashMap<Id<Behavior>, usize> = FxHashMap::default();
        let chosen = policy.rows.iter().map(|row| row.behavior);
        for behavior in policy.behaviors.iter().copied().chain(chosen) {
            numbers.entry(behavior).or_insert_with(|| {
                on.push((behavior, Bits::empty(policy.rows.len())));
                on.len() - 1
            });
        }
        for (i, row) in policy.rows.iter().enumerate() {
            let at = numbers.get(&row.behavior);
            if let Some((_, rows)) = at.and_then(|at| on.get_mut(*at)) {
                rows.insert(i);
            }
        }
        on.retain(|(_, rows)| !rows.is_empty());
        Self {
            policy,
            on,
            wide: policy.rows.iter().any(|row| row.free.is_some()),
            prover: Prover::new(policy),
        }
    }

    /// The rows, transposed.
    pub(super) fn columns(&self) -> &Columns {
        self.prover.columns()
    }

    /// No rows.
    pub(super) fn none(&self) -> Bits {
        Bits::empty(self.columns().rows())
    }

    /// All rows.
    pub(super) fn all(&self) -> Bits {
        Bits::full(self.columns().rows())
    }

    /// The rows in which an atom holds; `None` if the policy does not observe it.
    pub(super) fn column(&self, atom: Atom) -> Option<&Bits> {
        self.prover.column(atom)
    }

    /// The rows of each behaviour.
    pub(super) fn classes(&self) -> Vec<Bits> {
        self.on.iter().map(|(_, rows)| rows.clone()).collect()
    }

    /// The rows in which a tree without memory does not decide as the policy; `None` for no such tree.
    pub(super) fn wrong(&self, root: &Node) -> Option<Bits> {
        self.prover.wrong(root).ok()
    }

    /// Whether the tree is proved to take the policy's decisions.
    pub(super) fn proves(&self, root: &Node) -> bool {
        self.prover.proves(root)
    }

    pub(super) fn prover(&self) -> &Prover<'a> {
        &self.prover
    }
}
