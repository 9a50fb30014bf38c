//! Minterms: a value for every atom.

use std::cmp::Ordering;

/// A value for every atom, as tables hold it: bit i is the value of the i-th atom.
///
/// Ordered as the string of its values, first atom first, 0 before 1. The other form of a minterm is the simulator's: a
/// [key](Minterm::key).
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
    pub(crate) fn from_words(words: impl IntoIterator<Item = u64>, len: usize) -> Self {
        Self {
            words: words.into_iter().collect(),
            len,
        }
    }

    /// The minterm of the first `len` bits of a key, at most 128.
    pub fn of_key(key: u128, len: usize) -> Self {
        let words = [key as u64, (key >> 64) as u64];
        Self::from_words(words.into_iter().take(len.div_ceil(64)), len)
    }

    /// The minterm as the simulator keeps it: bit i is the value of the i-th of at most 128 atoms.
    pub fn key(&self) -> u128 {
        let words = self.words.iter().take(2).rev();
        words.fold(0, |key, word| key << 64 | u128::from(*word))
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
        bit(&self.words, i)
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

impl FromIterator<bool> for Minterm {
    fn from_iter<I: IntoIterator<Item = bool>>(values: I) -> Self {
        Self::new(values)
    }
}

impl Ord for Minterm {
    fn cmp(&self, other: &Self) -> Ordering {
        order(&self.words, &other.words).then(self.len.cmp(&other.len))
    }
}

impl PartialOrd for Minterm {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The order of minterms in words: that of the first atom in which they differ.
pub(crate) fn order(a: &[u64], b: &[u64]) -> Ordering {
    let mut pairs = a.iter().zip(b);
    let Some((a, b)) = pairs.find(|(a, b)| a != b) else {
        return Ordering::Equal;
    };
    let first = (a ^ b).trailing_zeros();
    (a >> first & 1).cmp(&(b >> first & 1))
}

/// Whether minterms in words have the same values in all atoms but those that are `free`; past its end none is.
pub(crate) fn agree(a: &[u64], b: &[u64], free: impl IntoIterator<Item = u64>) -> bool {
    let free = free.into_iter().chain(std::iter::repeat(0));
    let mut words = a.iter().zip(b).zip(free);
    words.all(|((a, b), free)| (a ^ b) & !free == 0)
}

/// The bit of an atom in words; false past the end.
pub(crate) fn bit(words: &[u64], atom: usize) -> bool {
    let word = words.get(atom / 64);
    word.is_some_and(|word| word >> (atom % 64) & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::Minterm;

    #[test]
    fn keys_and_minterms_are_two_forms_of_one_thing() {
        for len in [0, 1, 63, 64, 65, 127, 128] {
            let values: Vec<bool> = (0..len).map(|i| i % 3 == 0 || i == 64).collect();
            let minterm = Minterm::new(values.iter().copied());
            let key = (0..len).fold(0, |key, i| key | u128::from(values[i]) << i);
            assert_eq!(minterm.key(), key, "{len}");
            assert_eq!(Minterm::of_key(key, len), minterm, "{len}");
        }
    }

    #[test]
    fn minterms_stand_in_the_order_of_their_strings() {
        let minterms: Vec<Vec<bool>> = (0..1 << 6)
            .map(|bits| {
                (0..70)
                    .map(|i| i % 12 == 5 && bits >> (i / 12) & 1 == 1)
                    .collect()
            })
            .collect();
        for a in &minterms {
            for b in &minterms {
                let [x, y] = [a, b].map(|values| Minterm::new(values.iter().copied()));
                assert_eq!(x.cmp(&y), a.cmp(b));
            }
        }
    }
}
