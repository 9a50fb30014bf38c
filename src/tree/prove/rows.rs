//! What a tree selects in all rows of a table at once.

use super::plan::{Plan, Reading};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Guard};
use crate::logic::Bits;

/// The rows in which an atom holds; `None` for an atom that holds in none.
pub(super) trait Held {
    fn held(&self, atom: Atom) -> Option<&Bits>;
}

/// Ticks a tree in sets of rows.
pub(super) struct Rows<'a, T, F> {
    pub(super) table: &'a T,
    pub(super) reading: Reading,
    /// Is told every behaviour with the rows in which it is selected.
    pub(super) selected: F,
}

/// The rows in which a node answers without a behaviour.
struct Answered {
    success: Bits,
    failure: Bits,
}

impl Answered {
    /// A selector is a sequence with success and failure exchanged.
    fn seen_from(self, kind: Composite) -> Self {
        match kind {
            Composite::Sequence => self,
            Composite::Selector => self.inverted(),
        }
    }

    fn inverted(self) -> Self {
        Self {
            success: self.failure,
            failure: self.success,
        }
    }
}

impl<T: Held, F: FnMut(Id<Behavior>, &Bits)> Rows<'_, T, F> {
    /// Reads a tree in these rows; the rows in which nothing is selected.
    pub(super) fn read(&mut self, plan: &Plan, rows: &Bits) -> Bits {
        let answered = self.node(plan, rows.clone());
        answered.success.or(&answered.failure)
    }

    fn node(&mut self, plan: &Plan, rows: Bits) -> Answered {
        if rows.is_empty() {
            return Answered {
                success: rows.clone(),
                failure: rows,
            };
        }
        let none = || Bits::empty(rows.bound());
        match plan {
            Plan::Condition(guard) => {
                let success = self.holds(guard, &rows);
                let failure = rows.minus(&success);
                Answered { success, failure }
            }
            Plan::Behavior(behavior) => {
                (self.selected)(*behavior, &rows);
                Answered {
                    success: none(),
                    failure: none(),
                }
            }
            Plan::Reactive(kind, children) => {
                let mut failure = none();
                let mut reached = rows;
                for child in children {
                    let answered = self.node(child, reached).seen_from(*kind);
                    failure = failure.or(&answered.failure);
                    reached = answered.success;
                }
                let success = reached;
                Answered { success, failure }.seen_from(*kind)
            }
            Plan::Resuming(kind, children) => {
                let mut answered = Answered {
                    success: none(),
                    failure: none(),
                };
                for ((child, _), here) in children.iter().zip(self.stands(children, rows)) {
                    let part = self.node(child, here).seen_from(*kind);
                    answered.success = answered.success.or(&part.success);
                    answered.failure = answered.failure.or(&part.failure);
                }
                answered.seen_from(*kind)
            }
            Plan::Decorated(kind, child) => {
                let answered = self.node(child, rows);
                let either = || answered.success.or(&answered.failure);
                match kind {
                    Decorator::Succeed => Answered {
                        success: either(),
                        failure: Bits::empty(answered.success.bound()),
                    },
                    Decorator::Fail => Answered {
                        failure: either(),
                        success: Bits::empty(answered.success.bound()),
                    },
                    _ => answered.inverted(),
                }
            }
        }
    }

    /// The rows in which a memory node stands at each of its children.
    fn stands(&self, children: &[(Plan, Vec<Atom>)], mut rows: Bits) -> Vec<Bits> {
        let ended = |i: usize, rows: &Bits| match children.get(i) {
            Some((_, ended)) => self.any(ended, rows),
            None => Bits::empty(rows.bound()),
        };
        let mut stands = vec![Bits::empty(rows.bound()); children.len()];
        let mut take = |i: usize, rows: &mut Bits| {
            let mut here = ended(i - 1, rows);
            if self.reading == Reading::Unfinished {
                here.subtract(&ended(i, &here));
            }
            rows.subtract(&here);
            if let Some(slot) = stands.get_mut(i) {
                *slot = here;
            }
        };
        // What ends the last child ends the whole.
        match self.reading {
            Reading::Furthest => (1..children.len()).rev().for_each(|i| take(i, &mut rows)),
            Reading::Unfinished => (1..children.len()).for_each(|i| take(i, &mut rows)),
        }
        if let Some(first) = stands.first_mut() {
            *first = rows;
        }
        stands
    }

    /// The rows among these in which one of the atoms holds.
    fn any(&self, atoms: &[Atom], rows: &Bits) -> Bits {
        let held = atoms.iter().filter_map(|atom| self.table.held(*atom));
        held.fold(Bits::empty(rows.bound()), |found, column| {
            found.or(&rows.and(column))
        })
    }

    /// The rows among these in which a guard holds.
    fn holds(&self, guard: &Guard, rows: &Bits) -> Bits {
        match guard {
            Guard::Const(true) => rows.clone(),
            Guard::Const(false) => Bits::empty(rows.bound()),
            Guard::Atom(atom) => self.any(&[*atom], rows),
            Guard::Not(guard) => rows.minus(&self.holds(guard, rows)),
            Guard::And(guards) => guards
                .iter()
                .fold(rows.clone(), |left, guard| self.holds(guard, &left)),
            Guard::Or(guards) => {
                let mut left = rows.clone();
                for guard in guards {
                    left.subtract(&self.holds(guard, &left));
                }
                rows.minus(&left)
            }
        }
    }
}
