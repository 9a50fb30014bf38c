//! A canonical tree as a policy table.

use super::Canonical;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use crate::policy::{Minterm, Policy, Row};
use crate::tree::atoms::atoms;
use crate::tree::guard::partial::value;
use std::collections::BTreeSet;

/// A cube of a table, a value for each atom or nothing, and what is done in it.
pub type Decided = (Vec<Option<bool>>, Id<Behavior>);

/// The most parts into which the minterms are divided for a table.
const PARTS: usize = 200_000;

/// What a canonical tree does, as cubes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Divided {
    /// Cubes, no two of which overlap, that together hold every minterm in which something is selected.
    pub cubes: Vec<Decided>,
    /// Whether something is selected in every minterm.
    pub is_total: bool,
}

impl Divided {
    /// The cubes as a policy over the atoms of their columns.
    pub fn policy(self, atoms: Vec<Atom>) -> Policy {
        let rows = self.cubes.into_iter().map(|(cube, behavior)| {
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
}

impl Canonical {
    /// The atoms that the guards ask.
    pub fn atoms(&self) -> Vec<Atom> {
        let guards = self.units.iter();
        let asked = guards.flat_map(|unit| atoms(&Node::Condition(unit.guard.clone())));
        asked.collect::<BTreeSet<Atom>>().into_iter().collect()
    }

    /// What the tree does as cubes over `atoms`. Of the atoms that ask the history at most `window` hold together, if it
    /// is given; of other minterms nothing is said. `None` if there would be too many cubes.
    pub fn divided(&self, atoms: &[Atom], window: Option<usize>) -> Option<Divided> {
        let mut split = Split {
            canonical: self,
            atoms,
            window,
            values: vec![None; atoms.len()],
            parts: 0,
            is_total: true,
        };
        let cubes = split.below().ok()?.unwrap_or_default();
        Some(Divided {
            cubes,
            is_total: split.is_total,
        })
    }
}

/// The division of all minterms by the values of one atom after the other.
struct Split<'a> {
    canonical: &'a Canonical,
    atoms: &'a [Atom],
    window: Option<usize>,
    /// What is known here.
    values: Vec<Option<bool>>,
    /// The parts that were looked at.
    parts: usize,
    /// Whether something was selected in all of them.
    is_total: bool,
}

/// There are too many parts.
struct TooMany;

impl Split<'_> {
    /// The cubes of what is known here, without it; `None` if the history cannot be so.
    fn below(&mut self) -> Result<Option<Vec<Decided>>, TooMany> {
        if self.is_beyond_the_window() {
            return Ok(None);
        }
        self.parts += 1;
        if self.parts > PARTS {
            return Err(TooMany);
        }
        let mut open = None;
        for unit in &self.canonical.units {
            match value(&unit.guard, &|atom| self.atom(atom)) {
                Ok(true) => return Ok(Some(vec![(vec![None; self.atoms.len()], unit.behavior)])),
                Ok(false) => {}
                Err(atom) => open = open.or(Some(atom)),
            }
        }
        let Some(atom) = open else {
            self.is_total = false;
            return Ok(Some(Vec::new()));
        };
        let mut side = |value| {
            self.know(atom, Some(value));
            self.below()
        };
        let (no, yes) = (side(false)?, side(true)?);
        self.know(atom, None);
        Ok(match (no, yes) {
            (Some(no), Some(yes)) if no == yes => Some(yes),
            (Some(no), Some(yes)) => {
                let no = no.into_iter().map(|cube| (cube, false));
                let both = no.chain(yes.into_iter().map(|cube| (cube, true)));
                Some(both.map(|(cube, value)| with(cube, atom, value)).collect())
            }
            (one, other) => one.or(other),
        })
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
