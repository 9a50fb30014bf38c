//! The history window.

use super::atoms::Atoms;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task;
use crate::ir::tree::Status;

/// The last terminations of the kinds that the task remembers.
#[derive(Clone, Debug)]
pub(super) struct History {
    kind: task::History,
    /// The newest first; never longer than the window.
    entries: Vec<(Id<Behavior>, Status)>,
    /// The bits of `done` and `failed`.
    pub(super) bits: u128,
}

impl History {
    pub(super) fn new(kind: task::History) -> Self {
        Self {
            kind,
            entries: Vec::with_capacity(kind.window + 1),
            bits: 0,
        }
    }

    pub(super) fn entries(&self) -> &[(Id<Behavior>, Status)] {
        &self.entries
    }

    pub(super) fn clear(&mut self) {
        self.entries.clear();
        self.bits = 0;
    }

    /// Takes in a termination, if it is of a kind that is remembered.
    pub(super) fn record(&mut self, behavior: Id<Behavior>, status: Status, atoms: &Atoms) {
        let remembered = match status {
            Status::Success => self.kind.success,
            Status::Failure => self.kind.failure,
            Status::Running => false,
        };
        if remembered && self.kind.window > 0 {
            self.entries.truncate(self.kind.window - 1);
            self.entries.insert(0, (behavior, status));
            self.bits = self.entries.iter().fold(0, |bits, &(behavior, status)| {
                bits | atoms.of(behavior, status)
            });
        }
    }
}
