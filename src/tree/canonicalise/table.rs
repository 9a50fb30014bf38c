//! A canonical tree as a policy table.

use super::{Canonical, CanonicalUnit};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use crate::policy::{Minterm, Policy, Row};
use crate::tree::atoms::atoms;
use crate::tree::guard::partial::value;
use crate::tree::guard::{not, or};
use std::collections::BTreeSet;

/// A cube of a table, a value for each atom or nothing, and what is done in it.
pub type Decided = (Vec<Option<bool>>, Id<Behavior>);

impl Canonical {
    /// The table of the tree as a policy over the atoms that it asks; see [`Canonical::table`].
    pub fn policy(&self, window: Option<usize>) -> Policy {
        let guards = self.units.iter();
        let asked = guards.flat_map(|unit| atoms(&Node::Condition(unit.guard.clone())));
        let atoms: Vec<Atom> = asked.collect::<BTreeSet<Atom>>().into_iter().collect();
        let rows = self
            .table(&atoms, window)
            .into_iter()
            .map(|(cube, behavior)| {
                let free = cube.iter().any(Option::is_none);
                Row {
                    minterm: Minterm::new(cube.iter().map(|value| *value == Some(true))),
                    free: free.then(|| Minterm::new(cube.iter().map(Option::is_none))),
                    behavior,
                    visits: 0,
                    values: Vec::new(),
                }
            });
        Policy {
            rows: rows.collect(),
            atoms,
            ..Policy::default()
        }
    }

    /// Cubes over `atoms`, no two of which overlap, that together hold every minterm in which something is selected. Of
    /// the atoms that ask the history at most `window` hold together, if it is given; of other minterms nothing is said.
    pub fn table(&self, atoms: &[Atom], window: Option<usize>) -> Vec<Decided> {
        let mut split = Split {
            canonical: self,
            atoms,
            window,
            values: vec![None; atoms.len()],
        };
        split.below().unwrap_or_default()
    }

    /// Whether something is selected in every minterm that [`Canonical::table`] speaks of.
    pub fn is_total(&self, atoms: &[Atom], window: Option<usize>) -> bool {
        let any = or(self.units.iter().map(|unit| unit.guard.clone()));
        let Some(unit) = self.units.first() else {
            return false;
        };
        let whole = Self {
            units: vec![CanonicalUnit {
                guard: not(any),
                behavior: unit.behavior,
            }],
        };
        whole.table(atoms, window).is_empty()
    }
}

/// The division of all minterms by the values of one atom after the other.
struct Split<'a> {
    canonical: &'a Canonical,
    atoms: &'a [Atom],
    window: Option<usize>,
    /// What is known here.
    values: Vec<Option<bool>>,
}

impl Split<'_> {
    /// The cubes of what is known here, without it; `None` if the history cannot be so.
    fn below(&mut self) -> Option<Vec<Decided>> {
        if self.is_beyond_the_window() {
            return None;
        }
        let mut open = None;
        for unit in &self.canonical.units {
            match value(&unit.guard, &|atom| self.atom(atom)) {
                Ok(true) => return Some(vec![(vec![None; self.atoms.len()], unit.behavior)]),
                Ok(false) => {}
                Err(atom) => open = open.or(Some(atom)),
            }
        }
        let Some(atom) = open else {
            return Some(Vec::new());
        };
        let mut side = |value| {
            self.know(atom, Some(value));
            self.below()
        };
        let (no, yes) = (side(false), side(true));
        self.know(atom, None);
        match (no, yes) {
            (Some(no), Some(yes)) if no == yes => Some(yes),
            (Some(no), Some(yes)) => {
                let no = no.into_iter().map(|cube| (cube, false));
                let both = no.chain(yes.into_iter().map(|cube| (cube, true)));
                Some(both.map(|(cube, value)| with(cube, atom, value)).collect())
            }
            (one, other) => one.or(other),
        }
    }

    fn know(&mut self, atom: usize, value: Option<bool>) {
        if let Some(slot) = self.values.get_mut(atom) {
            *slot = value;
        }
    }

    fn is_beyond_the_window(&self) -> bool {
        let held = self.atoms.iter().zip(&self.values);
        let held = held
            .filter(|(atom, value)| !matches!(atom, Atom::Predicate(_)) && **value == Some(true));
        self.window.is_some_and(|window| held.count() > window)
    }

    /// The value of an atom, or its number where that is open. An atom that is not asked for holds nowhere.
    fn atom(&self, atom: Atom) -> Result<bool, usize> {
        let at = self.atoms.iter().position(|known| *known == atom);
        match at.map(|at| (at, self.values.get(at).copied().flatten())) {
            Some((at, value)) => value.ok_or(at),
            None => Ok(false),
        }
    }
}

/// A cube in which an atom has a value.
fn with((mut cube, behavior): Decided, atom: usize, value: bool) -> Decided {
    if let Some(slot) = cube.get_mut(atom) {
        *slot = Some(value);
    }
    (cube, behavior)
}
