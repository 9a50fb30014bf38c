//! Which values are in registers at a point of the code.

use super::code::Register;
use crate::ir::ExprId;
use rustc_hash::FxHashMap;

/// What has been computed on every path to this point, and where it is.
///
/// Entries are logged in order, so that the values known where a branch left the code are a prefix of the log.
#[derive(Debug, Default)]
pub(super) struct Memo {
    values: FxHashMap<ExprId, Register>,
    looked: u128,
    log: Vec<Entry>,
}

#[derive(Clone, Copy, Debug)]
enum Entry {
    Value(ExprId),
    Look(u16),
}

/// A length of the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Mark(usize);

impl Memo {
    pub(super) fn get(&self, id: ExprId) -> Option<Register> {
        self.values.get(&id).copied()
    }

    pub(super) fn insert(&mut self, id: ExprId, register: Register) {
        self.values.insert(id, register);
        self.log.push(Entry::Value(id));
    }

    /// A known value is somewhere else now.
    pub(super) fn relocate(&mut self, id: ExprId, register: Register) {
        if let Some(known) = self.values.get_mut(&id) {
            *known = register;
        }
    }

    /// Whether an echo source must be looked at; from now on it has been. Sources past 127 are always looked at.
    pub(super) fn look(&mut self, source: u16) -> bool {
        let bit = 1u128.checked_shl(u32::from(source)).unwrap_or(0);
        if self.looked & bit != 0 {
            return false;
        }
        self.looked |= bit;
        self.log.push(Entry::Look(source));
        true
    }

    pub(super) fn has_looked(&self, source: u16) -> bool {
        1u128
            .checked_shl(u32::from(source))
            .is_some_and(|bit| self.looked & bit != 0)
    }

    pub(super) fn mark(&self) -> Mark {
        Mark(self.log.len())
    }

    /// Forgets everything since the mark.
    pub(super) fn forget(&mut self, mark: Mark) {
        for entry in self.log.drain(mark.0.min(self.log.len())..) {
            match entry {
                Entry::Value(id) => {
                    self.values.remove(&id);
                }
                Entry::Look(source) => {
                    self.looked &= !1u128.checked_shl(u32::from(source)).unwrap_or(0);
                }
            }
        }
    }

    /// Forgets the values that `stale` names.
    pub(super) fn invalidate(&mut self, mut stale: impl FnMut(ExprId) -> bool) {
        self.values.retain(|&id, _| !stale(id));
    }
}
