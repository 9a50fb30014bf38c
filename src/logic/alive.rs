//! A set of rows that shrinks: only the words that still have rows are read.

use super::bits::Bits;

/// The words of a set that are not zero, with their places in the columns.
#[derive(Clone, Debug)]
pub(super) struct Alive {
    words: Vec<u64>,
    places: Vec<u32>,
}

#[allow(
    clippy::indexing_slicing,
    reason = "places are below the number of words of a column of the same table"
)]
impl Alive {
    /// All rows of a set.
    pub(super) fn new(rows: &Bits) -> Self {
        let words = rows.words().iter().zip(0..).filter(|(word, _)| **word != 0);
        let (words, places) = words.unzip();
        Self { words, places }
    }

    /// How many rows there are.
    pub(super) fn count(&self) -> usize {
        self.words.iter().map(|w| w.count_ones() as usize).sum()
    }

    /// How many words still have rows.
    pub(super) fn words(&self) -> usize {
        self.words.len()
    }

    /// Whether there are none.
    pub(super) fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// The least row.
    pub(super) fn first(&self) -> Option<usize> {
        let (word, place) = self.words.first().zip(self.places.first())?;
        Some(*place as usize * 64 + word.trailing_zeros() as usize)
    }

    /// How many of the rows do not have the bit `value` in a column, counted in every `stride`-th word.
    pub(super) fn count_out(&self, (column, value): (&Bits, bool), stride: usize) -> usize {
        let flip = if value { u64::MAX } else { 0 };
        let column = column.words();
        if stride == 1 && self.words.len() == column.len() {
            let both = self.words.iter().zip(column);
            return both
                .map(|(a, b)| (a & (b ^ flip)).count_ones() as usize)
                .sum();
        }
        let both = self.words.iter().zip(&self.places).step_by(stride);
        both.map(|(a, at)| (a & (column[*at as usize] ^ flip)).count_ones() as usize)
            .sum()
    }

    /// Keeps the rows that have the bit `value` in a column.
    pub(super) fn keep(&mut self, (column, value): (&Bits, bool)) {
        let flip = if value { 0 } else { u64::MAX };
        let column = column.words();
        let mut kept = 0;
        for i in 0..self.words.len() {
            let place = self.places[i];
            let word = self.words[i] & (column[place as usize] ^ flip);
            if word != 0 {
                self.words[kept] = word;
                self.places[kept] = place;
                kept += 1;
            }
        }
        self.words.truncate(kept);
        self.places.truncate(kept);
    }
}
