//! The history window, with what it makes true as bits.

use super::atoms::Atoms;
use crate::ir::Id;
use crate::ir::history::{Termination, Window};
use crate::ir::law::Behavior;
use crate::ir::task;
use crate::ir::tree::Status;

/// The window of a simulation.
#[derive(Clone, Debug)]
pub(super) struct History {
    window: Window,
    /// The bits of `done` and `failed`.
    pub(super) bits: u128,
}

impl History {
    pub(super) fn new(kind: task::History) -> Self {
        Self {
            window: Window::new(kind),
            bits: 0,
        }
    }

    /// The terminations, the newest first.
    pub(super) fn entries(&self) -> &[Termination] {
        self.window.entries()
    }

    pub(super) fn clear(&mut self) {
        self.window.clear();
        self.bits = 0;
    }

    /// Takes in a termination, if it is of a kind that is remembered.
    pub(super) fn record(&mut self, behavior: Id<Behavior>, status: Status, atoms: &Atoms) {
        if self.window.record(behavior, status) {
            let entries = self.window.entries().iter();
            self.bits = entries.fold(0, |bits, &(behavior, status)| {
                bits | atoms.of(behavior, status)
            });
        }
    }
}
