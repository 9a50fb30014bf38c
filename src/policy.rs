//! What learning hands to the tree: minterm → behaviour with its evidence, start minterms, greedy transitions.
//!
//! Three files hold it: the decisions in [`decisions`], the greedy process in [`transitions`], the evidence in
//! [`evidence`]. Decisions of any origin are read by [`table`].

pub mod decisions;
pub mod error;
pub mod evidence;
mod names;
mod records;
mod sheet;
pub mod table;
pub mod transitions;

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Status};

/// A value for every atom of a policy: bit i is the value of its i-th atom.
///
/// Ordered as the string of its values, first atom first, 0 before 1.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Minterm {
    words: Box<[u64]>,
    len: usize,
}

impl Minterm {
    /// The minterm of these values.
    pub fn new(values: impl IntoIterator<Item = bool>) -> Self {
        let mut words = Vec::new();
        let mut len = 0;
        for value in values {
            if len % 64 == 0 {
                words.push(0);
            }
            if let (true, Some(word)) = (value, words.last_mut()) {
                *word |= 1 << (len % 64);
            }
            len += 1;
        }
        Self {
            words: words.into(),
            len,
        }
    }

    /// The minterm of `len` atoms in these words, atom 0 in the lowest bit of the first.
    fn from_words(words: impl Iterator<Item = u64>, len: usize) -> Self {
        Self {
            words: words.collect(),
            len,
        }
    }

    /// The number of atoms.
    pub fn len(&self) -> usize {
        self.len
    }

    /// Whether there are no atoms.
    pub fn is_empty(&self) -> bool {
        self.len == 0
    }

    /// The value of the i-th atom; false past the end.
    pub fn get(&self, i: usize) -> bool {
        self.words
            .get(i / 64)
            .is_some_and(|word| word >> (i % 64) & 1 == 1)
    }

    /// The values, first atom first.
    pub fn values(&self) -> impl Iterator<Item = bool> {
        (0..self.len).map(|i| self.get(i))
    }

    /// The values in machine words, atom 0 in the lowest bit of the first.
    pub fn words(&self) -> &[u64] {
        &self.words
    }
}

impl Ord for Minterm {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        let mirrored = |word: &u64| word.reverse_bits();
        let words = self.words.iter().map(mirrored);
        words
            .cmp(other.words.iter().map(mirrored))
            .then(self.len.cmp(&other.len))
    }
}

impl PartialOrd for Minterm {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

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
    /// The minterms in which greedy episodes start, sorted; with how many did.
    pub starts: Vec<(Minterm, u64)>,
    /// What happened under the greedy policy, sorted.
    pub transitions: Vec<Transition>,
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
}

impl Row {
    /// Whether it stands for this minterm.
    pub fn speaks_of(&self, minterm: &Minterm) -> bool {
        let free = self.free.iter().flat_map(|free| free.words());
        let words = self.minterm.words().iter().zip(minterm.words());
        words
            .zip(free.copied().chain(std::iter::repeat(0)))
            .all(|((own, other), free)| (own ^ other) & !free == 0)
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
