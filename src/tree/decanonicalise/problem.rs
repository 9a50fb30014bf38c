//! A policy as sets of rows.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use crate::logic::{Account, Bits, Columns};
use crate::policy::Policy;
use crate::tree::prove::Prover;
use rustc_hash::FxHashMap;

/// The work of an operation on a set of rows without any words, and what goes with it.
pub(super) const OPERATION: u64 = 24;

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

    /// The work of one operation on sets of rows.
    pub(super) fn words(&self) -> u64 {
        OPERATION + self.columns().rows() as u64 / 64
    }

    /// The rows by what these atoms are in them; `None` for too many kinds.
    pub(super) fn kinds(
        &self,
        rows: &Bits,
        asked: &[Atom],
        most: usize,
        account: &Account,
    ) -> Option<Vec<Bits>> {
        let mut kinds = vec![rows.clone()];
        for atom in asked {
            let column = self.column(*atom)?;
            account.spend(self.words() * 2 * kinds.len() as u64);
            let parts = kinds
                .iter()
                .flat_map(|kind| [kind.and(column), kind.minus(column)]);
            kinds = parts.filter(|kind| !kind.is_empty()).collect();
            if kinds.len() > most {
                return None;
            }
        }
        Some(kinds)
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
