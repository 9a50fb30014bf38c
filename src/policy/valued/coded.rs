//! The atoms that hold by the code of each column, in words.

use super::rows::{Columns, Holds, Test};
use super::{Asks, OPEN, Valued};
use crate::policy::Field;
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// What the codes of each column say of the atoms.
pub(super) struct Coded {
    pub(super) width: usize,
    pub(super) columns: Vec<Masks>,
}

/// The atoms that one column decides.
#[derive(Default)]
pub(super) struct Masks {
    width: usize,
    /// All of them.
    atoms: Vec<u64>,
    /// The stretch in which each code is: the same atoms hold for all codes of one.
    stretches: Vec<u32>,
    /// Those that hold, by stretch.
    holds: Vec<u64>,
    /// The different ones of these, in the order of the codes.
    different: Vec<Vec<u64>>,
}

impl Masks {
    /// The masks of atoms over so many codes.
    fn new(atoms: &[(usize, &Holds)], codes: usize, width: usize) -> Self {
        let mut begins = vec![false; codes];
        for (_, holds) in atoms {
            let mut begin =
                |code: usize| begins.get_mut(code).into_iter().for_each(|at| *at = true);
            match holds {
                Holds::Asked(Asks::AtMost(last)) => begin(*last as usize + 1),
                Holds::Asked(Asks::Is(value)) => {
                    begin(*value as usize);
                    begin(*value as usize + 1);
                }
                Holds::Listed(holds) => {
                    let neighbors = (1..).zip(holds.windows(2));
                    let turns = neighbors.filter(|(_, pair)| pair.first() != pair.last());
                    turns.for_each(|(code, _)| begin(code));
                    begin(holds.len());
                }
            }
        }
        let mut masks = Self {
            width,
            atoms: vec![0; width],
            ..Self::default()
        };
        for (atom, _) in atoms {
            set(&mut masks.atoms, *atom);
        }
        for (code, begins) in (0..).zip(begins) {
            if begins || code == 0 {
                let start = masks.holds.len();
                masks.holds.resize(start + width, 0);
                let held = atoms.iter().filter(|(_, holds)| holds.at(code));
                held.for_each(|(atom, _)| set(&mut masks.holds, start * 64 + atom));
            }
            let stretch = (masks.holds.len() / width.max(1)).saturating_sub(1);
            masks.stretches.push(stretch as u32);
        }
        masks
    }

    /// The atoms that hold for a code.
    pub(super) fn of(&self, code: u32) -> &[u64] {
        let stretch = self.stretches.get(code as usize);
        let held = stretch.and_then(|at| {
            let start = *at as usize * self.width;
            self.holds.get(start..start + self.width)
        });
        held.unwrap_or_default()
    }
}

impl Coded {
    pub(super) fn new(valued: &Valued, tests: &[Test]) -> Self {
        let width = tests.len().div_ceil(64);
        let mut of: FxHashMap<usize, Vec<(usize, &Holds)>> = FxHashMap::default();
        for (atom, test) in tests.iter().enumerate() {
            if let Columns::One(column, holds) = &test.of {
                of.entry(*column).or_default().push((atom, holds));
            }
        }
        let columns = valued.columns.iter().enumerate().map(|(at, column)| {
            let Some(own) = of.get(&at) else {
                return Masks::default();
            };
            let listed = own.iter().map(|(_, holds)| match holds {
                Holds::Asked(_) => column.kind.values(),
                Holds::Listed(holds) => holds.len(),
            });
            let mut masks = Masks::new(own, listed.max().unwrap_or(0), width);
            if column.codes.contains(&OPEN) {
                let mut known: BTreeSet<&[u64]> = BTreeSet::new();
                let all = masks.holds.chunks(width.max(1));
                let different = all.filter(|mask| known.insert(mask));
                masks.different = different.map(<[u64]>::to_vec).collect();
            }
            masks
        });
        let columns = columns.collect();
        Self { width, columns }
    }

    /// Whether a test asks a column.
    pub(super) fn asks(&self, column: usize) -> bool {
        let masks = self.columns.get(column);
        masks.is_some_and(|masks| masks.width > 0)
    }

    /// A row once for each value of these columns that their atoms tell from others.
    pub(super) fn written_out(&self, words: &[u64], columns: &[usize]) -> Vec<Vec<u64>> {
        let mut all = vec![words.to_vec()];
        for column in columns {
            let each = all.iter().flat_map(|words| {
                self.different(*column).iter().map(|mask| {
                    let mut words = words.clone();
                    join(&mut words, mask);
                    words
                })
            });
            all = each.collect();
        }
        all
    }

    /// The atoms that these columns decide where rows leave them open.
    pub(super) fn fields(&self, columns: &[usize]) -> Vec<Field> {
        let fields = columns.iter().map(|column| Field {
            atoms: self.atoms(*column).to_vec(),
            values: self.different(*column).to_vec(),
        });
        fields.collect()
    }

    /// The atoms that a column decides.
    pub(super) fn atoms(&self, column: usize) -> &[u64] {
        let masks = self.columns.get(column);
        masks.map_or(&[], |masks| &masks.atoms)
    }

    /// Those of them that hold, for each value that they tell from others, where rows leave the column open.
    pub(super) fn different(&self, column: usize) -> &[Vec<u64>] {
        let masks = self.columns.get(column);
        masks.map_or(&[], |masks| &masks.different)
    }
}

/// Sets a bit.
pub(super) fn set(words: &mut [u64], at: usize) {
    if let Some(word) = words.get_mut(at / 64) {
        *word |= 1 << (at % 64);
    }
}

/// Adds the bits of a mask.
pub(super) fn join(words: &mut [u64], mask: &[u64]) {
    for (word, mask) in words.iter_mut().zip(mask) {
        *word |= mask;
    }
}
