//! The rows of a table as sets of minterms.

use super::Prover;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Guard};
use crate::logic::Bits;
use crate::tree::reading::Sets;
use std::convert::Infallible;

/// Sets of rows; `selected` hears of every behaviour with the rows in which it is selected.
pub(super) struct RowSets<'a, F> {
    pub(super) table: &'a Prover<'a>,
    pub(super) selected: F,
}

impl<F: FnMut(Id<Behavior>, &Bits)> Sets for RowSets<'_, F> {
    type Set = Bits;
    type Open = Infallible;

    fn none(&self) -> Bits {
        Bits::empty(self.table.columns.rows())
    }

    fn is_none(&self, set: &Bits) -> bool {
        set.is_empty()
    }

    fn both(&mut self, a: &Bits, b: &Bits) -> Bits {
        a.and(b)
    }

    fn either(&mut self, mut a: Bits, b: &Bits) -> Bits {
        a.unite(b);
        a
    }

    fn minus(&mut self, mut a: Bits, b: &Bits) -> Bits {
        a.subtract(b);
        a
    }

    fn holds(&mut self, guard: &Guard, among: &Bits) -> Result<Bits, Infallible> {
        Ok(self.value(guard, among))
    }

    fn any(&mut self, atoms: &[Atom], among: &Bits) -> Result<Bits, Infallible> {
        let mut found = self.none();
        for atom in atoms {
            found.unite(&self.atom(*atom, among));
        }
        Ok(found)
    }

    fn select(&mut self, behavior: Id<Behavior>, among: Bits) {
        (self.selected)(behavior, &among);
    }
}

impl<F> RowSets<'_, F> {
    /// The rows among these in which an atom holds; one that is not observed holds in none.
    fn atom(&self, atom: Atom, among: &Bits) -> Bits {
        match self.table.column(atom) {
            Some(column) => among.and(column),
            None => Bits::empty(among.bound()),
        }
    }

    /// The rows among these in which a guard holds.
    fn value(&self, guard: &Guard, among: &Bits) -> Bits {
        match guard {
            Guard::Const(true) => among.clone(),
            Guard::Const(false) => Bits::empty(among.bound()),
            Guard::Atom(atom) => self.atom(*atom, among),
            Guard::Not(guard) => among.minus(&self.value(guard, among)),
            Guard::And(guards) => guards
                .iter()
                .fold(among.clone(), |left, guard| self.value(guard, &left)),
            Guard::Or(guards) => {
                let mut left = among.clone();
                for guard in guards {
                    left.subtract(&self.value(guard, &left));
                }
                among.minus(&left)
            }
        }
    }
}
