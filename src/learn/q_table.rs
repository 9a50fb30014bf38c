//! The table of action values; only visited minterms take memory.

use super::process::Key;
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

/// The evidence for one behaviour in one minterm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cell {
    /// The decisions that its value rests on, see [`QTable::admits`].
    pub visits: u64,
    /// The action value.
    pub q: f64,
    /// The sum of the squares of the targets.
    pub squares: f64,
    /// Whether the tick limit cut every one of these decisions.
    pub cut: bool,
}

/// Whether a decision is to be learned from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Admission {
    /// It is not.
    Refused,
    /// It is.
    Granted,
    /// It is, and all that was learned of this choice in this minterm before is to be forgotten.
    Anew,
}

/// Q(minterm, choice).
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct QTable {
    /// The average reward a tick that the values are relative to; 0 for discounted ones.
    pub gain: f64,
    choices: usize,
    initial: f64,
    rows: FxHashMap<Key, usize>,
    keys: Vec<Key>,
    cells: Vec<Cell>,
}

impl QTable {
    /// An empty table over `choices` choices, whose cells start at `initial`.
    pub fn new(choices: usize, initial: f64) -> Self {
        Self {
            gain: 0.0,
            choices,
            initial,
            rows: FxHashMap::default(),
            keys: Vec::new(),
            cells: Vec::new(),
        }
    }

    /// The row of a minterm, a new one if there is none.
    pub fn row(&mut self, key: Key) -> usize {
        let next = self.keys.len();
        let row = *self.rows.entry(key).or_insert(next);
        if row == next {
            self.keys.push(key);
            self.cells
                .extend(std::iter::repeat_n(fresh(self.initial), self.choices));
        }
        row
    }

    /// The row of a minterm, if there is one.
    pub fn find(&self, key: Key) -> Option<usize> {
        self.rows.get(&key).copied()
    }

    /// The cells of a row, a choice each.
    pub fn cells(&self, row: usize) -> &[Cell] {
        let start = row * self.choices;
        self.cells.get(start..start + self.choices).unwrap_or(&[])
    }

    /// A cell to change.
    pub fn cell_mut(&mut self, row: usize, choice: usize) -> Option<&mut Cell> {
        if choice < self.choices {
            self.cells.get_mut(row * self.choices + choice)
        } else {
            None
        }
    }

    /// Whether a decision that is complete, or that the tick limit cut, is to be learned from.
    ///
    /// A decision that was cut shows nothing of what it would have led to. To learn it as a whole one would add a
    /// transition to the same minterm that never happens, with its reward and its discount, so it is dropped. Where
    /// every decision of a choice in a minterm was cut there is nothing else to go by: these are learned as if a decision
    /// had been due at the limit, which says that for so long nothing happened and nothing was gained. The first
    /// decision that is completed there takes their place.
    pub fn admits(&mut self, row: usize, choice: usize, cut: bool) -> Admission {
        let Some(cell) = self.cell_mut(row, choice) else {
            return Admission::Refused;
        };
        match (cut, cell.cut) {
            (true, false) if cell.visits > 0 => Admission::Refused,
            (false, true) => {
                self.forget(row, choice);
                Admission::Anew
            }
            _ => {
                cell.cut = cut;
                Admission::Granted
            }
        }
    }

    /// Forgets what is known of a choice.
    pub fn forget(&mut self, row: usize, choice: usize) {
        let initial = self.initial;
        if let Some(cell) = self.cell_mut(row, choice) {
            *cell = fresh(initial);
        }
    }

    /// The greatest value of a row over all choices, tried or not: the value of arriving here.
    pub fn best_value(&self, row: usize) -> f64 {
        self.cells(row)
            .iter()
            .map(|cell| cell.q)
            .reduce(f64::max)
            .unwrap_or(0.0)
    }

    /// The choice of the greatest value over all, tried or not, the first of equals.
    pub fn best(&self, row: usize) -> usize {
        let cells = self.cells(row).iter().enumerate();
        let first = (0, f64::NEG_INFINITY);
        let better = |best: (usize, f64), (choice, cell): (usize, &Cell)| {
            if cell.q > best.1 {
                (choice, cell.q)
            } else {
                best
            }
        };
        cells.fold(first, better).0
    }

    /// The number of decisions that the values of a row rest on.
    pub fn visits(&self, row: usize) -> u64 {
        self.cells(row).iter().map(|cell| cell.visits).sum()
    }

    /// The best of the choices that were tried in a row, the first of equals; `None` if none was.
    pub fn greedy(&self, row: usize) -> Option<usize> {
        let mut best: Option<(usize, f64)> = None;
        for (choice, cell) in self.cells(row).iter().enumerate() {
            if cell.visits > 0 && best.is_none_or(|(_, q)| cell.q > q) {
                best = Some((choice, cell.q));
            }
        }
        best.map(|(choice, _)| choice)
    }

    /// The minterms with their rows, sorted by their bits.
    pub fn sorted(&self) -> Vec<(Key, usize)> {
        let mut rows: Vec<(Key, usize)> = self
            .keys
            .iter()
            .enumerate()
            .map(|(row, key)| (*key, row))
            .collect();
        rows.sort_unstable();
        rows
    }
}

/// A cell of which nothing is known.
fn fresh(initial: f64) -> Cell {
    Cell {
        visits: 0,
        q: initial,
        squares: 0.0,
        cut: false,
    }
}
