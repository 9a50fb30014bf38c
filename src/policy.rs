//! What learning hands to the tree: minterm → behaviour with its evidence, start minterms, greedy transitions.
//!
//! Three files hold it: the decisions in [`decisions`], the greedy process in [`transitions`], the evidence in
//! [`evidence`]. Decisions of any origin are read by [`reader`], those that ask truth values into a
//! [`table`], those that ask numbers and words into a [`valued`] one.

pub mod decisions;
pub mod error;
pub mod evidence;
mod names;
pub mod reader;
mod records;
mod sheet;
pub mod table;
pub mod transitions;
pub mod valued;

pub use crate::logic::Minterm;

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Status};
use crate::logic::minterm::agree;
use crate::logic::packed::Packed;
use std::collections::{BTreeMap, BTreeSet};

/// A policy with what is known of the process under it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Policy {
    /// What the bits of a minterm mean: observed predicates, then `done`, then `failed`.
    pub atoms: Vec<Atom>,
    /// The behaviours that could be chosen, in the order of `choose`.
    pub behaviors: Vec<Id<Behavior>>,
    /// The history window behind `done` and `failed`.
    pub history: History,
    /// The seen minterms, sorted.
    pub rows: Vec<Row>,
    /// Atoms that are free together in cubes, no two of these with an atom in common.
    pub fields: Vec<Field>,
    /// The minterms in which greedy episodes start, sorted; with how many did.
    pub starts: Vec<(Minterm, u64)>,
    /// What happened under the greedy policy, sorted.
    pub transitions: Vec<Transition>,
}

/// Atoms that a value decides which a row leaves open, and what they may be: they are free together.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// The atoms, as bits.
    pub atoms: Vec<u64>,
    /// Those of them that hold, for each value that they tell from others.
    pub values: Vec<Vec<u64>>,
}

/// One seen minterm, or a cube of a table that leaves atoms free.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The minterm; free atoms are 0 in it.
    pub minterm: Minterm,
    /// The atoms whose value does not matter, a 1 for each: the row stands for every minterm that agrees with it in the
    /// others. `None` for a row that stands for one minterm, as all do that were learned.
    pub free: Option<Minterm>,
    /// What the policy does in it.
    pub behavior: Id<Behavior>,
    /// How many decisions were completed in it.
    pub visits: u64,
    /// For each behaviour that could be chosen: decisions completed and value; `None` if never tried.
    pub values: Vec<Option<Value>>,
}

/// The evidence for one behaviour in one minterm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// Decisions completed.
    pub visits: u64,
    /// The action value.
    pub q: f64,
    /// The sum of the squares of the targets that it was moved towards.
    pub squares: f64,
}

/// A decision of the greedy policy with its outcome.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Transition {
    /// The minterm in which it was taken.
    pub from: Minterm,
    /// What was chosen.
    pub behavior: Id<Behavior>,
    /// How it ended: running if the minterm changed, an event fired or patience ended before it did.
    pub status: Status,
    /// The minterm found after it; `None` if the episode ended.
    pub to: Option<Minterm>,
    /// How often it happened.
    pub count: u64,
}

impl Policy {
    /// What the policy does in a minterm, if it was seen.
    pub fn choice(&self, minterm: &Minterm) -> Option<Id<Behavior>> {
        let at = self.rows.binary_search_by(|row| row.minterm.cmp(minterm));
        at.ok()
            .and_then(|i| self.rows.get(i))
            .map(|row| row.behavior)
    }

    /// Leaves out the minterms in which nothing was recorded, if anything was recorded in any.
    pub fn keep_recorded(&mut self) {
        let starts = self.starts.iter().map(|(minterm, _)| minterm);
        let from = self.transitions.iter().map(|transition| &transition.from);
        let to = self.transitions.iter().filter_map(|it| it.to.as_ref());
        let met: BTreeSet<&Minterm> = starts.chain(from).chain(to).collect();
        let recorded = |row: &Row| row.free.is_some() || met.contains(&row.minterm);
        if !met.is_empty() && self.rows.iter().any(recorded) {
            self.rows.retain(recorded);
        }
    }

    /// The rows with each minterm that they stand for in a row of its own, sorted. Where rows overlap the first decides.
    pub fn minterm_rows(&self) -> Vec<Row> {
        let mut rows: BTreeMap<Minterm, Row> = BTreeMap::new();
        for row in &self.rows {
            for minterm in row.minterms() {
                rows.entry(minterm).or_insert_with_key(|minterm| Row {
                    minterm: minterm.clone(),
                    free: None,
                    ..row.clone()
                });
            }
        }
        rows.into_values().collect()
    }
}

impl Row {
    /// The number of atoms that it leaves free.
    pub fn free_atoms(&self) -> usize {
        let free = self.free.iter().flat_map(Minterm::values);
        free.filter(|free| *free).count()
    }

    /// Whether some minterm is of both rows.
    pub fn meets(&self, other: &Self) -> bool {
        let free = |row: &Self, at: usize| {
            let words = row.free.as_ref().map(Minterm::words);
            words.and_then(|words| words.get(at).copied()).unwrap_or(0)
        };
        let words = self.minterm.words();
        let either = (0..words.len()).map(|at| free(self, at) | free(other, at));
        agree(words, other.minterm.words(), either)
    }

    /// The minterms that it stands for: two to the power of its free atoms.
    pub fn minterms(&self) -> impl Iterator<Item = Minterm> {
        let atoms = self.minterm.len();
        let free = self.free.as_ref().map_or(&[][..], Minterm::words);
        let minterms = Packed::new(atoms, self.minterm.words(), free).minterms(atoms);
        minterms.map(move |cube| Minterm::from_words(cube.values().iter().copied(), atoms))
    }

    /// Whether it stands for this minterm.
    pub fn speaks_of(&self, minterm: &Minterm) -> bool {
        let free = self.free.iter().flat_map(|free| free.words());
        agree(self.minterm.words(), minterm.words(), free.copied())
    }

    /// How much better the best behaviour looks than the second; `None` if only one was tried.
    pub fn q_gap(&self) -> Option<f64> {
        let mut values: Vec<f64> = self.values.iter().flatten().map(|value| value.q).collect();
        values.sort_by(|a, b| b.total_cmp(a));
        match values.as_slice() {
            [best, second, ..] => Some(best - second),
            _ => None,
        }
    }
}
