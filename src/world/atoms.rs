//! Which bit of a minterm means what.

use super::error::BuildError;
use crate::ir::law::Behavior;
use crate::ir::program::Predicate;
use crate::ir::task::Task;
use crate::ir::tree::{Atom, Status};
use crate::ir::{Id, Program};

/// The atoms that a simulation keeps: the task's, in the order of [`Program::atoms`] from bit 0, then others.
#[derive(Clone, Debug)]
pub(super) struct Atoms {
    pub(super) list: Vec<Atom>,
    /// The bits of the task's own atoms.
    pub(super) observed: u128,
    /// For each behaviour, the bits of `done` and of `failed`.
    terminations: Vec<[u128; 2]>,
}

impl Atoms {
    pub(super) fn new(
        program: &Program,
        task: Id<Task>,
        extra: &[Atom],
    ) -> Result<Self, BuildError> {
        let mut list = program.atoms(task);
        let own = list.len();
        for atom in extra {
            if !list.contains(atom) {
                list.push(*atom);
            }
        }
        if list.len() > 128 {
            return Err(BuildError::TooManyAtoms(list.len()));
        }
        let bit = |atom: Atom| {
            let at = list.iter().position(|&a| a == atom);
            at.map_or(0, |i| 1u128 << i)
        };
        let terminations = program
            .behaviors
            .ids()
            .map(|id| [bit(Atom::Done(id)), bit(Atom::Failed(id))])
            .collect();
        Ok(Self {
            observed: 1u128
                .checked_shl(own as u32)
                .map_or(u128::MAX, |bit| bit - 1),
            terminations,
            list,
        })
    }

    /// The predicates with their bits.
    pub(super) fn predicates(&self) -> impl Iterator<Item = (u16, Id<Predicate>)> {
        self.list
            .iter()
            .zip(0..)
            .filter_map(|(atom, bit)| match atom {
                Atom::Predicate(id) => Some((bit, *id)),
                Atom::Done(_) | Atom::Failed(_) => None,
            })
    }

    /// The bit of the atom that a termination in the window makes true.
    pub(super) fn of(&self, behavior: Id<Behavior>, status: Status) -> u128 {
        let [done, failed] = self
            .terminations
            .get(behavior.index())
            .copied()
            .unwrap_or_default();
        match status {
            Status::Success => done,
            Status::Failure => failed,
            Status::Running => 0,
        }
    }
}
