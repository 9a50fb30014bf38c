//! The minterms of one row that leaves atoms free: they are read together until a free atom decides, and only there the
//! cube is split.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Guard};
use crate::policy::{Minterm, Row};
use crate::tree::guard::partial::{decided, value};
use crate::tree::reading::{Plan, Reading, Sets, read};
use rustc_hash::FxHashMap;

/// A row as a cube: the values of its atoms, and which of them are free.
pub(super) struct WideRow<'a> {
    positions: &'a FxHashMap<Atom, usize>,
    values: Vec<bool>,
    free: Vec<bool>,
    /// What was found to be selected in it.
    selected: Option<Id<Behavior>>,
}

/// A tree does not select a behaviour in the whole of a cube.
pub(super) enum Fault {
    /// It does this here.
    Decides(Minterm, Option<Id<Behavior>>),
    /// There were more parts to look at than allowed.
    Spent,
}

impl<'a> WideRow<'a> {
    /// The cube that a row stands for; `positions` are those of the policy's atoms.
    pub(super) fn new(row: &Row, positions: &'a FxHashMap<Atom, usize>) -> Self {
        let atoms = row.minterm.len();
        let free = row.free.as_ref();
        Self {
            positions,
            values: row.minterm.values().collect(),
            free: (0..atoms)
                .map(|i| free.is_some_and(|free| free.get(i)))
                .collect(),
            selected: None,
        }
    }

    /// Whether a tree selects the behaviour in every minterm of the cube; `left` is how many parts may be looked at.
    pub(super) fn selects(
        &mut self,
        behavior: Id<Behavior>,
        plan: &Plan,
        by: Reading,
        left: &mut usize,
    ) -> Result<(), Fault> {
        *left = left.checked_sub(1).ok_or(Fault::Spent)?;
        self.selected = None;
        if let Err(atom) = read(plan, by, true, self) {
            for value in [false, true] {
                self.set(atom, value, false);
                self.selects(behavior, plan, by, left)?;
            }
            self.set(atom, false, true);
        } else if self.selected != Some(behavior) {
            let minterm = Minterm::new(self.values.iter().copied());
            return Err(Fault::Decides(minterm, self.selected));
        }
        Ok(())
    }

    fn set(&mut self, atom: usize, value: bool, free: bool) {
        if let (Some(v), Some(f)) = (self.values.get_mut(atom), self.free.get_mut(atom)) {
            (*v, *f) = (value, free);
        }
    }

    fn atom(&self, atom: Atom) -> Result<bool, usize> {
        let Some(at) = self.positions.get(&atom) else {
            return Ok(false);
        };
        match (self.values.get(*at), self.free.get(*at)) {
            (_, Some(true)) => Err(*at),
            (value, _) => Ok(value.copied().unwrap_or(false)),
        }
    }
}

/// The cube is one set and nothing the other; a question that hangs on a free atom is open.
impl Sets for WideRow<'_> {
    type Set = bool;
    type Open = usize;

    fn none(&self) -> bool {
        false
    }

    fn is_none(&self, set: &bool) -> bool {
        !set
    }

    fn both(&mut self, a: &bool, b: &bool) -> bool {
        *a && *b
    }

    fn either(&mut self, a: bool, b: &bool) -> bool {
        a || *b
    }

    fn minus(&mut self, a: bool, b: &bool) -> bool {
        a && !b
    }

    fn holds(&mut self, guard: &Guard, among: &bool) -> Result<bool, usize> {
        value(guard, &|atom| self.atom(atom)).map(|holds| *among && holds)
    }

    fn any(&mut self, atoms: &[Atom], among: &bool) -> Result<bool, usize> {
        let any = decided(atoms.iter().map(|atom| self.atom(*atom)), true);
        any.map(|holds| *among && holds)
    }

    fn select(&mut self, behavior: Id<Behavior>, among: bool) {
        self.selected = self.selected.or(among.then_some(behavior));
    }
}
