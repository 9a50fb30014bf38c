//! The rows of a table in machine words.

use super::super::{Minterm, Row, Value};
use crate::ir::Id;
use crate::logic::minterm::{bit, order};
use std::cmp::Ordering;

/// What a cell says of an atom.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Truth {
    No,
    Yes,
    /// Either: the atom is free.
    Either,
}

/// The rows of a table, some words each as in a minterm: the first atom is the lowest bit of the first word.
#[derive(Clone, Debug, Default)]
pub(super) struct Rows {
    atoms: usize,
    width: usize,
    words: Vec<u64>,
    /// The free atoms of every row; empty as long as no row has any.
    free: Vec<u64>,
    /// What is done, by its number among the behaviours of the table.
    pub(super) behavior: Vec<u32>,
    /// Empty where the table does not say.
    pub(super) visits: Vec<u64>,
    /// As many for each row as the table has columns of values; not a number where it says nothing.
    values: Vec<f64>,
    /// How many values a row has.
    columns: usize,
    /// Where each row starts in its text.
    pub(super) start: Vec<u32>,
    /// Where each ends, if its text does not say.
    pub(super) end: Vec<u32>,
}

/// A row that is being read.
#[derive(Clone, Debug, Default)]
pub(super) struct Draft {
    words: Vec<u64>,
    free: Vec<u64>,
    leaves_free: bool,
    pub(super) behavior: Option<u32>,
    pub(super) visits: u64,
    values: Vec<f64>,
}

impl Draft {
    /// Forgets what was read.
    pub(super) fn clear(&mut self, rows: &Rows) {
        self.words.clear();
        self.words.resize(rows.width, 0);
        self.free.clear();
        self.free.resize(rows.width, 0);
        self.leaves_free = false;
        self.behavior = None;
        self.visits = 0;
        self.values.clear();
        self.values.resize(rows.columns, f64::NAN);
    }

    /// Says 64 atoms at once, the first of them in the lowest bit.
    pub(super) fn say_word(&mut self, number: usize, word: u64) {
        if let Some(slot) = self.words.get_mut(number) {
            *slot = word;
        }
    }

    /// Says all atoms at once, and which of them are free.
    pub(super) fn say_words(&mut self, words: &[u64], free: &[u64]) {
        self.words.clear();
        self.words.extend_from_slice(words);
        self.free.clear();
        self.free.extend_from_slice(free);
        self.leaves_free = free.iter().any(|word| *word != 0);
    }

    /// Gives the value in a column of values, or nothing.
    pub(super) fn value(&mut self, column: usize, q: Option<f64>) {
        if let (Some(slot), Some(q)) = (self.values.get_mut(column), q) {
            *slot = q;
        }
    }

    /// One more column of values.
    pub(super) fn another_value(&mut self) {
        self.values.push(f64::NAN);
    }

    /// Says something of an atom.
    pub(super) fn say(&mut self, atom: usize, truth: Truth) {
        let words = match truth {
            Truth::No => return,
            Truth::Yes => &mut self.words,
            Truth::Either => {
                self.leaves_free = true;
                &mut self.free
            }
        };
        if let Some(word) = words.get_mut(atom / 64) {
            *word |= 1 << (atom % 64);
        }
    }
}

impl Rows {
    /// No rows yet, over `atoms` atoms and with `values` values each.
    pub(super) fn new(atoms: usize, values: usize) -> Self {
        Self {
            atoms,
            width: atoms.div_ceil(64),
            columns: values,
            ..Self::default()
        }
    }

    /// Adds a row that says what is done; others are left out.
    pub(super) fn push(&mut self, draft: &Draft, start: usize) {
        let Some(behavior) = draft.behavior else {
            return;
        };
        if draft.leaves_free {
            self.free.resize(self.words.len(), 0);
        }
        if draft.leaves_free || !self.free.is_empty() {
            self.free.extend_from_slice(&draft.free);
        }
        self.words.extend_from_slice(&draft.words);
        self.behavior.push(behavior);
        if draft.visits > 0 || !self.visits.is_empty() {
            self.visits.resize(self.behavior.len() - 1, 0);
            self.visits.push(draft.visits);
        }
        self.values.extend_from_slice(&draft.values);
        self.start.push(u32::try_from(start).unwrap_or(u32::MAX));
    }

    /// One more column of values, of which the rows so far say nothing.
    pub(super) fn another_value(&mut self) {
        let wider = (0..self.len()).flat_map(|row| {
            let known = slice(&self.values, self.columns, row);
            known.iter().copied().chain([f64::NAN])
        });
        self.values = wider.collect();
        self.columns += 1;
    }

    pub(super) fn len(&self) -> usize {
        self.behavior.len()
    }

    /// How many atoms a row has.
    pub(super) fn atoms(&self) -> usize {
        self.atoms
    }

    /// Whether some row leaves atoms free.
    pub(super) fn has_cubes(&self) -> bool {
        !self.free.is_empty()
    }

    /// The values of a row's atoms.
    pub(super) fn words(&self, row: usize) -> &[u64] {
        slice(&self.words, self.width, row)
    }

    /// The free atoms of a row; without any words where no row has any.
    pub(super) fn free(&self, row: usize) -> &[u64] {
        slice(&self.free, self.width, row)
    }

    /// The order in which the rows stand in a policy; of equal ones the first in the text comes first.
    pub(super) fn compare(&self, a: usize, b: usize) -> Ordering {
        let words = order(self.words(a), self.words(b));
        words.then_with(|| order(self.free(a), self.free(b)))
    }

    /// A row of a policy; `order` gives for each behaviour of the policy the column of its value.
    pub(super) fn row(&self, row: usize, behavior: usize, order: &[Option<usize>]) -> Row {
        let minterm = |words: &[u64]| Minterm::from_words(words.iter().copied(), self.atoms);
        let free = self.free(row);
        let known = slice(&self.values, self.columns, row);
        let value = |column: &Option<usize>| {
            let q = column.and_then(|at| known.get(at)).copied()?;
            (!q.is_nan()).then_some(Value {
                visits: 0,
                q,
                squares: 0.0,
            })
        };
        Row {
            minterm: minterm(self.words(row)),
            free: free.iter().any(|word| *word != 0).then(|| minterm(free)),
            behavior: Id::new(behavior),
            visits: self.visits.get(row).copied().unwrap_or(0),
            values: match self.columns {
                0 => Vec::new(),
                _ => order.iter().map(value).collect(),
            },
        }
    }

    /// What a cell of the row says of an atom.
    pub(super) fn truth(&self, row: usize, atom: usize) -> Truth {
        match (bit(self.free(row), atom), bit(self.words(row), atom)) {
            (true, _) => Truth::Either,
            (false, true) => Truth::Yes,
            (false, false) => Truth::No,
        }
    }
}

/// The entries of a row in a list with `width` entries a row.
fn slice<T>(all: &[T], width: usize, row: usize) -> &[T] {
    let start = row * width;
    all.get(start..start + width).unwrap_or_default()
}
