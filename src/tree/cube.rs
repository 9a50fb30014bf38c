//! What a tree selects in a cube: the atoms that are free are read together until one of them decides, and only there the cube
//! is split.

use super::guard::partial::{decided, value};
use super::reading::{After, Irreducible, May, Plan, Reading, Sets, plan, read};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Guard, Node};
use crate::logic::random::Random;
use crate::policy::{Field, Minterm};
use rustc_hash::FxHashMap;

/// The values of atoms, and which of them are free.
#[derive(Clone, Debug)]
pub struct Cube<'a> {
    positions: &'a FxHashMap<Atom, usize>,
    fields: &'a [Field],
    values: Vec<bool>,
    free: Vec<bool>,
    /// What was found to be selected in it.
    selected: Option<Id<Behavior>>,
}

fn has(words: &[u64], at: usize) -> bool {
    let word = words.get(at / 64).copied().unwrap_or(0);
    word >> (at % 64) & 1 == 1
}

/// There were more parts of cubes to look at than allowed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spent;

/// Says whether to go on, of a part of a cube in which one behaviour is selected, or none.
type Say<'s, 'a> = dyn FnMut(&Cube<'a>, Option<Id<Behavior>>) -> bool + 's;

/// Where each of these atoms stands.
pub fn positions(atoms: &[Atom]) -> FxHashMap<Atom, usize> {
    let atoms = atoms.iter().enumerate();
    atoms.map(|(at, atom)| (*atom, at)).collect()
}

impl<'a> Cube<'a> {
    /// The cube of a minterm in which these atoms are free; `positions` are those of the atoms. Atoms of a field are free
    /// together, each of the others for itself.
    pub fn new(
        minterm: &Minterm,
        free: Option<&Minterm>,
        positions: &'a FxHashMap<Atom, usize>,
        fields: &'a [Field],
    ) -> Self {
        let values: Vec<bool> = minterm.values().collect();
        let is_free = |atom| free.is_some_and(|free| free.get(atom));
        Self {
            positions,
            fields,
            free: (0..values.len()).map(is_free).collect(),
            values,
            selected: None,
        }
    }

    /// The cube of the atoms that hold in which those of the fields are free.
    pub fn of_fields(
        words: &[u64],
        positions: &'a FxHashMap<Atom, usize>,
        fields: &'a [Field],
    ) -> Self {
        let atoms = 0..positions.len();
        let is_free = |atom: &usize| fields.iter().any(|field| has(&field.atoms, *atom));
        Self {
            positions,
            fields,
            free: atoms.clone().map(|atom| is_free(&atom)).collect(),
            values: atoms.map(|atom| has(words, atom)).collect(),
            selected: None,
        }
    }

    /// A minterm of it, at random.
    pub fn any(&self, random: &mut Random) -> Minterm {
        let free = |atom: usize| self.free.get(atom) == Some(&true);
        let mut values: Vec<bool> = self.values.clone();
        for (atom, value) in values.iter_mut().enumerate() {
            *value = if free(atom) {
                random.below(2) == 1
            } else {
                *value
            };
        }
        for field in self.fields {
            let held = field.values.get(random.below(field.values.len()));
            let own = values.iter_mut().enumerate();
            for (atom, value) in own.filter(|(atom, _)| has(&field.atoms, *atom) && free(*atom)) {
                *value = held.is_some_and(|held| has(held, atom));
            }
        }
        Minterm::new(values)
    }

    /// The minterm in which no free atom holds.
    pub fn minterm(&self) -> Minterm {
        let held = self.values.iter().zip(&self.free);
        Minterm::new(held.map(|(value, free)| *value && !free))
    }

    /// Its free atoms; `None` if there are none.
    pub fn free(&self) -> Option<Minterm> {
        let any = self.free.contains(&true);
        any.then(|| Minterm::new(self.free.iter().copied()))
    }

    /// Goes through the parts in which a tree selects one thing; `left` is how many may be looked at. Whether it went through all.
    ///
    /// # Errors
    /// They were too many.
    pub(super) fn parts(
        &mut self,
        (plan, by): (&Plan, Reading),
        left: &mut usize,
        say: &mut Say<'_, 'a>,
    ) -> Result<bool, Spent> {
        *left = left.checked_sub(1).ok_or(Spent)?;
        self.selected = None;
        let Err(atom) = read(plan, by, true, self) else {
            return Ok(say(self, self.selected));
        };
        let together = self.fields.iter().find(|field| has(&field.atoms, atom));
        let Some(field) = together else {
            let goes_on = [false, true].into_iter().try_fold(true, |goes_on, value| {
                self.set(atom, value, false);
                Ok(goes_on && self.parts((plan, by), left, say)?)
            });
            self.set(atom, false, true);
            return goes_on;
        };
        let atoms = (0..self.values.len()).filter(|at| has(&field.atoms, *at));
        let atoms: Vec<usize> = atoms.collect();
        let goes_on = field.values.iter().try_fold(true, |goes_on, held| {
            atoms
                .iter()
                .for_each(|at| self.set(*at, has(held, *at), false));
            Ok(goes_on && self.parts((plan, by), left, say)?)
        });
        atoms.iter().for_each(|at| self.set(*at, false, true));
        goes_on
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
impl Sets for Cube<'_> {
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

/// A tree without memory, ready to be read in cubes.
pub struct Reader<'t>(Plan<'t>);

impl<'t> Reader<'t> {
    /// That of a tree.
    ///
    /// # Errors
    /// Why atoms do not say what it selects.
    pub fn new(root: &'t Node) -> Result<Self, Irreducible> {
        plan(root, After::Anything, &mut May).map(Self)
    }

    /// Goes through the parts of a cube in which the tree selects one thing; `left` is how many may be looked at. Whether it went
    /// through all.
    ///
    /// # Errors
    /// They were too many.
    pub fn parts<'a>(
        &self,
        cube: &mut Cube<'a>,
        left: &mut usize,
        say: &mut Say<'_, 'a>,
    ) -> Result<bool, Spent> {
        cube.parts((&self.0, Reading::Furthest), left, say)
    }
}
