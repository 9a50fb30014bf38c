//! Sets of row numbers.

/// A set of numbers below a fixed bound, a bit each.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Bits {
    words: Vec<u64>,
    len: usize,
}

impl Bits {
    /// The empty set of numbers below `len`.
    pub fn empty(len: usize) -> Self {
        Self {
            words: vec![0; len.div_ceil(64)],
            len,
        }
    }

    /// Every number below `len`.
    pub fn full(len: usize) -> Self {
        let mut words = vec![u64::MAX; len.div_ceil(64)];
        if let (Some(last), 1..) = (words.last_mut(), len % 64) {
            *last = (1 << (len % 64)) - 1;
        }
        Self { words, len }
    }

    /// The set whose words these are, the number 0 in the lowest bit of the first.
    pub(super) fn from_words(len: usize, words: Vec<u64>) -> Self {
        Self { words, len }
    }

    /// The words, the number 0 in the lowest bit of the first; bits past the bound are 0.
    pub(super) fn words(&self) -> &[u64] {
        &self.words
    }

    /// These numbers below `len`; others are ignored.
    pub fn collect(len: usize, numbers: impl IntoIterator<Item = usize>) -> Self {
        let mut bits = Self::empty(len);
        for number in numbers {
            bits.insert(number);
        }
        bits
    }

    /// One more than the greatest number that it can hold.
    pub fn bound(&self) -> usize {
        self.len
    }

    /// Adds a number.
    pub fn insert(&mut self, number: usize) {
        if number < self.len
            && let Some(word) = self.words.get_mut(number / 64)
        {
            *word |= 1 << (number % 64);
        }
    }

    /// Takes a number out.
    pub fn remove(&mut self, number: usize) {
        if let Some(word) = self.words.get_mut(number / 64) {
            *word &= !(1 << (number % 64));
        }
    }

    /// Whether it holds the number.
    pub fn contains(&self, number: usize) -> bool {
        self.words
            .get(number / 64)
            .is_some_and(|word| word >> (number % 64) & 1 == 1)
    }

    /// How many it holds.
    pub fn count(&self) -> usize {
        self.words.iter().map(|w| w.count_ones() as usize).sum()
    }

    /// Whether it holds none.
    pub fn is_empty(&self) -> bool {
        self.words.iter().all(|word| *word == 0)
    }

    /// The least number.
    pub fn first(&self) -> Option<usize> {
        self.iter().next()
    }

    /// The numbers, ascending.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        self.words.iter().enumerate().flat_map(|(i, word)| {
            let mut left = *word;
            std::iter::from_fn(move || {
                (left != 0).then(|| {
                    let bit = left.trailing_zeros() as usize;
                    left &= left - 1;
                    i * 64 + bit
                })
            })
        })
    }

    /// Whether all of its numbers are in the other.
    pub fn is_subset(&self, other: &Self) -> bool {
        self.zip(other).all(|(a, b)| a & !b == 0)
    }

    /// Whether the two have no number in common.
    pub fn is_disjoint(&self, other: &Self) -> bool {
        self.zip(other).all(|(a, b)| a & b == 0)
    }

    /// The least number that the two have in common.
    pub fn first_of_both(&self, other: &Self) -> Option<usize> {
        let mut words = self.zip(other).enumerate();
        words.find_map(|(i, (a, b))| {
            let both = a & b;
            (both != 0).then(|| i * 64 + both.trailing_zeros() as usize)
        })
    }

    /// Whether all numbers that the two have in common are in the third.
    pub fn both_within(&self, other: &Self, third: &Self) -> bool {
        let mut words = self.zip(other).zip(&third.words);
        words.all(|((a, b), c)| a & b & !c == 0)
    }

    /// How many numbers the two have in common.
    pub fn count_both(&self, other: &Self) -> usize {
        self.zip(other)
            .map(|(a, b)| (a & b).count_ones() as usize)
            .sum()
    }

    /// The numbers of both.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a & b)
    }

    /// The numbers of either.
    #[must_use]
    pub fn or(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a | b)
    }

    /// Its numbers that are not in the other.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a & !b)
    }

    /// The numbers of one, but not of both.
    #[must_use]
    pub fn differing(&self, other: &Self) -> Self {
        self.combine(other, |a, b| a ^ b)
    }

    /// Adds the numbers of the other.
    pub fn unite(&mut self, other: &Self) {
        for (a, b) in self.words.iter_mut().zip(&other.words) {
            *a |= b;
        }
    }

    /// Drops the numbers of the other.
    pub fn subtract(&mut self, other: &Self) {
        for (a, b) in self.words.iter_mut().zip(&other.words) {
            *a &= !b;
        }
    }

    /// Keeps the numbers that are in `column` if `inside`, the others if not.
    pub fn keep(&mut self, column: &Self, inside: bool) {
        let flip = if inside { 0 } else { u64::MAX };
        for (a, b) in self.words.iter_mut().zip(&column.words) {
            *a &= b ^ flip;
        }
    }

    fn zip(&self, other: &Self) -> impl Iterator<Item = (u64, u64)> {
        self.words.iter().copied().zip(other.words.iter().copied())
    }

    fn combine(&self, other: &Self, op: impl Fn(u64, u64) -> u64) -> Self {
        Self {
            words: self.zip(other).map(|(a, b)| op(a, b)).collect(),
            len: self.len,
        }
    }
}
