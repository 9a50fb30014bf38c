//! Cubes in machine words, for operations on lists of them.

use super::cube::Cube;
use super::minterm::bit;

/// A cube: for each atom whether it is fixed to 1, and whether it is fixed to 0.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Packed {
    ones: Box<[u64]>,
    zeros: Box<[u64]>,
}

impl Packed {
    /// The cube of all minterms over `atoms` atoms.
    pub fn universe(atoms: usize) -> Self {
        let empty: Box<[u64]> = vec![0; atoms.div_ceil(64)].into();
        Self {
            ones: empty.clone(),
            zeros: empty,
        }
    }

    /// The cube over `atoms` atoms of these values, where those of `free` do not matter.
    pub fn new(atoms: usize, values: &[u64], free: &[u64]) -> Self {
        let mut cube = Self::universe(atoms);
        let words = cube.ones.iter_mut().zip(&mut cube.zeros).enumerate();
        for (i, (one, zero)) in words {
            let fixed = !free.get(i).copied().unwrap_or_default() & mask(atoms, i);
            let value = values.get(i).copied().unwrap_or_default();
            *one = value & fixed;
            *zero = !value & fixed;
        }
        cube
    }

    /// A cube over `atoms` atoms.
    pub fn of(atoms: usize, cube: &Cube) -> Self {
        let mut packed = Self::universe(atoms);
        for literal in cube.literals() {
            packed.set(literal.atom, Some(literal.positive));
        }
        packed
    }

    /// The values, with 0 for atoms that are free.
    pub fn values(&self) -> &[u64] {
        &self.ones
    }

    /// The free atoms, of `atoms`.
    pub fn free(&self, atoms: usize) -> Box<[u64]> {
        let words = self.ones.iter().zip(&self.zeros).enumerate();
        words.map(|(i, (a, b))| !(a | b) & mask(atoms, i)).collect()
    }

    /// The number of machine words that one of its two rows has; at least one.
    pub fn words(&self) -> usize {
        self.ones.len().max(1)
    }

    /// The number of atoms that are fixed.
    pub fn literals(&self) -> usize {
        let words = self.ones.iter().chain(&self.zeros);
        words.map(|word| word.count_ones() as usize).sum()
    }

    /// Whether no atom is fixed.
    pub fn is_universe(&self) -> bool {
        self.ones.iter().chain(&self.zeros).all(|word| *word == 0)
    }

    /// The value to which an atom is fixed.
    pub fn get(&self, atom: usize) -> Option<bool> {
        match (bit(&self.ones, atom), bit(&self.zeros, atom)) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    /// Fixes an atom, or frees it.
    pub fn set(&mut self, atom: usize, value: Option<bool>) {
        let bit = |words: &mut [u64], on: bool| {
            if let Some(word) = words.get_mut(atom / 64) {
                let bit = 1 << (atom % 64);
                *word = if on { *word | bit } else { *word & !bit };
            }
        };
        bit(&mut self.ones, value == Some(true));
        bit(&mut self.zeros, value == Some(false));
    }

    /// The atoms that are fixed, ascending, with their values.
    pub fn fixed(&self) -> impl Iterator<Item = (usize, bool)> {
        let words = self.ones.iter().zip(&self.zeros).enumerate();
        words.flat_map(|(i, (ones, zeros))| {
            let mut left = ones | zeros;
            std::iter::from_fn(move || {
                (left != 0).then(|| {
                    let bit = left.trailing_zeros() as usize;
                    left &= left - 1;
                    (i * 64 + bit, ones >> bit & 1 == 1)
                })
            })
        })
    }

    /// The cubes of its minterms over `atoms` atoms: 2^n for n free ones.
    pub fn minterms(self, atoms: usize) -> impl Iterator<Item = Self> {
        let free: Vec<usize> = (0..atoms).filter(|a| self.get(*a).is_none()).collect();
        (0..1_u64 << free.len()).map(move |bits| {
            let mut minterm = self.clone();
            for (i, atom) in free.iter().enumerate() {
                minterm.set(*atom, Some(bits >> i & 1 == 1));
            }
            minterm
        })
    }

    /// Whether the two have a minterm in common.
    pub fn meets(&self, other: &Self) -> bool {
        let conflict = |a: &[u64], b: &[u64]| a.iter().zip(b).any(|(a, b)| a & b != 0);
        !conflict(&self.ones, &other.zeros) && !conflict(&self.zeros, &other.ones)
    }

    /// Whether all minterms of the other lie in this one.
    pub fn contains(&self, other: &Self) -> bool {
        let within = |a: &[u64], b: &[u64]| a.iter().zip(b).all(|(a, b)| a & !b == 0);
        within(&self.ones, &other.ones) && within(&self.zeros, &other.zeros)
    }

    /// The minterms of both, which meet.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        let or = |a: &[u64], b: &[u64]| a.iter().zip(b).map(|(a, b)| a | b).collect();
        Self {
            ones: or(&self.ones, &other.ones),
            zeros: or(&self.zeros, &other.zeros),
        }
    }

    /// The number of atoms that are fixed here and not there.
    pub fn literals_beside(&self, other: &Self) -> usize {
        let mine = self.ones.iter().zip(&self.zeros);
        let theirs = other.ones.iter().zip(&other.zeros);
        let words = mine.zip(theirs).map(|((a, b), (c, d))| (a | b) & !(c | d));
        words.map(|word| word.count_ones() as usize).sum()
    }

    /// The cube without the literals of atoms that another one fixes.
    #[must_use]
    pub fn without(&self, other: &Self) -> Self {
        let free = |own: &[u64]| {
            let fixed = other.ones.iter().zip(&other.zeros);
            own.iter()
                .zip(fixed)
                .map(|(own, (a, b))| own & !(a | b))
                .collect()
        };
        Self {
            ones: free(&self.ones),
            zeros: free(&self.zeros),
        }
    }

    /// The part of the cube in which none of the others holds that have one literal beside it; `None` if they leave nothing.
    pub fn outside<'a>(&self, others: impl IntoIterator<Item = &'a Self>) -> Option<Self> {
        let mut part = self.clone();
        let others = others.into_iter();
        for other in others.filter(|other| other.literals_beside(self) == 1) {
            for (atom, value) in other.without(self).fixed() {
                if part.get(atom) == Some(value) {
                    return None;
                }
                part.set(atom, Some(!value));
            }
        }
        Some(part)
    }

    /// The number of literals that the smallest cube does not have that contains this one and another.
    pub fn lost(&self, other: &Self) -> usize {
        let lost = |a: &[u64], b: &[u64]| -> u32 {
            let words = a.iter().zip(b).map(|(a, b)| (a & !b).count_ones());
            words.sum()
        };
        (lost(&self.ones, &other.ones) + lost(&self.zeros, &other.zeros)) as usize
    }

    /// The smallest cube that contains both.
    #[must_use]
    pub fn supercube(&self, other: &Self) -> Self {
        let and = |a: &[u64], b: &[u64]| a.iter().zip(b).map(|(a, b)| a & b).collect();
        Self {
            ones: and(&self.ones, &other.ones),
            zeros: and(&self.zeros, &other.zeros),
        }
    }

    /// Its minterms that are not in the other, as disjoint cubes (the disjoint sharp of Hong, Cain and Ostapko 1974).
    pub fn minus(&self, other: &Self) -> Vec<Self> {
        if !self.meets(other) {
            return vec![self.clone()];
        }
        let mut rest = self.clone();
        let mut parts = Vec::new();
        for (atom, value) in other.fixed() {
            if rest.get(atom).is_none() {
                let mut part = rest.clone();
                part.set(atom, Some(!value));
                parts.push(part);
                rest.set(atom, Some(value));
            }
        }
        parts
    }
}

/// The atoms among `atoms` that stand in word `i`.
fn mask(atoms: usize, i: usize) -> u64 {
    match atoms.saturating_sub(i * 64) {
        0 => 0,
        left @ 1..64 => (1 << left) - 1,
        _ => u64::MAX,
    }
}
