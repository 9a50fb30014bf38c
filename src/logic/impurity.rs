//! How mixed the parts of a division are (CART: Breiman, Friedman, Olshen and Stone 1984).

use crate::math;
use std::sync::LazyLock;

/// A measure of how mixed a part is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Impurity {
    /// The chance that two of its rows are of different classes.
    Gini,
    /// The entropy of the classes of its rows.
    Entropy,
    /// The rows that are not of its most frequent class.
    Error,
}

impl Impurity {
    /// Every measure.
    pub const ALL: [Self; 3] = [Self::Gini, Self::Entropy, Self::Error];

    /// Whether a division with parts as mixed as `mixed` is better than one with `least`, by more than rounding.
    pub fn better(mixed: f64, least: f64) -> bool {
        mixed < least - 1e-9 * (1.0 + least)
    }
}

/// The depth from which parts are divided evenly. Two classes in turns along one number would be taken off row by row.
pub const DEPTH: usize = 128;

/// Whether a part of so many classes and rows is divided evenly: deep down, and where all rows are of classes of their own. There no
/// division tells more than another, and an even one is shallow.
pub fn evenly(classes: usize, rows: usize, depth: usize) -> bool {
    classes == rows || depth >= DEPTH
}

/// What a division into these parts is measured by, the less the better: how mixed they are or, if it is to be even, by how many rows
/// one of them is larger.
pub fn of_division([one, other]: [&Mixture; 2], evenly: bool) -> f64 {
    match evenly {
        true => f64::from(one.total().abs_diff(other.total())),
        false => one.mixed() + other.mixed(),
    }
}

/// The logarithms of small numbers, and of those that count the rows of a large table.
static SMALL: LazyLock<Vec<f64>> = LazyLock::new(|| (0..1 << 12).map(calculated).collect());
static LARGE: LazyLock<Vec<f64>> = LazyLock::new(|| (0..1 << 17).map(calculated).collect());

fn calculated(n: u32) -> f64 {
    if n > 1 { math::log2(f64::from(n)) } else { 0.0 }
}

/// log n to the base of 2; of 0 it is 0.
fn log2(n: u32) -> f64 {
    let known = SMALL.get(n as usize).or_else(|| LARGE.get(n as usize));
    known.copied().unwrap_or_else(|| calculated(n))
}

/// n log n.
pub(super) fn n_log_n(n: u32) -> f64 {
    f64::from(n) * log2(n)
}

/// The information of knowing that a row is one of so many of these, in bits (the gain of FOIL: Quinlan 1990).
pub fn information(own: u32, all: u32) -> f64 {
    log2(all) - log2(own)
}

/// The rows of a part by their class, as they come and go.
#[derive(Clone, Debug)]
pub struct Mixture {
    impurity: Impurity,
    counts: Vec<u32>,
    total: u32,
    /// The sum of a term for each class from which the impurity is calculated.
    sum: f64,
    /// The rows of the most frequent class, if the impurity asks for them.
    most: Most,
}

impl Mixture {
    /// A part without rows.
    pub fn new(impurity: Impurity, classes: usize) -> Self {
        Self {
            impurity,
            counts: vec![0; classes],
            total: 0,
            sum: 0.0,
            most: Most::default(),
        }
    }

    fn term(&self, count: u32) -> f64 {
        match self.impurity {
            Impurity::Gini => f64::from(count) * f64::from(count),
            Impurity::Entropy => n_log_n(count),
            Impurity::Error => 0.0,
        }
    }

    /// So many more rows of a class, or fewer.
    pub fn change(&mut self, class: usize, by: i32) {
        let Some(count) = self.counts.get(class).copied() else {
            return;
        };
        let new = count.saturating_add_signed(by);
        self.sum += self.term(new) - self.term(count);
        self.total = self.total.saturating_add_signed(by);
        if self.impurity == Impurity::Error {
            self.most.change(count, new);
        }
        if let Some(slot) = self.counts.get_mut(class) {
            *slot = new;
        }
    }

    /// How many rows there are.
    pub fn total(&self) -> u32 {
        self.total
    }

    /// The impurity of the part, times the number of its rows.
    pub fn mixed(&self) -> f64 {
        let total = f64::from(self.total);
        match self.impurity {
            _ if self.total == 0 => 0.0,
            Impurity::Gini => total - self.sum / total,
            Impurity::Entropy => n_log_n(self.total) - self.sum,
            Impurity::Error => total - f64::from(self.most.count),
        }
    }
}

/// The greatest of some counts that change one by one. It moves no further than they do, so that many classes cost no more than few.
#[derive(Clone, Debug, Default)]
struct Most {
    count: u32,
    /// How many classes have each count, from 1.
    classes: Vec<u32>,
}

impl Most {
    fn change(&mut self, old: u32, new: u32) {
        if self.classes.len() < new as usize {
            self.classes.resize(new as usize, 0);
        }
        for (count, change) in [(old, -1), (new, 1)] {
            if let Some(classes) = self.classes_of(count) {
                *classes = classes.saturating_add_signed(change);
            }
        }
        self.count = self.count.max(new);
        while self
            .classes_of(self.count)
            .is_some_and(|classes| *classes == 0)
        {
            self.count -= 1;
        }
    }

    fn classes_of(&mut self, count: u32) -> Option<&mut u32> {
        self.classes.get_mut((count as usize).checked_sub(1)?)
    }
}

#[cfg(test)]
mod tests {
    use super::{Impurity, Mixture};
    use proptest::prelude::*;

    /// The impurity of these rows at once.
    fn mixed(impurity: Impurity, counts: &[u32]) -> f64 {
        let total = counts.iter().map(|n| f64::from(*n)).sum::<f64>().max(1.0);
        let shares = counts.iter().map(|n| f64::from(*n) / total);
        let shares: Vec<f64> = shares.filter(|share| *share > 0.0).collect();
        if shares.is_empty() {
            return 0.0;
        }
        total
            * match impurity {
                Impurity::Gini => 1.0 - shares.iter().map(|p| p * p).sum::<f64>(),
                Impurity::Entropy => shares.iter().map(|p| -p * p.log2()).sum(),
                Impurity::Error => 1.0 - shares.iter().copied().fold(0.0, f64::max),
            }
    }

    proptest! {
        /// However rows come and go, a part is as mixed as its rows are.
        #[test]
        fn a_part_is_as_mixed_as_its_rows(changes in prop::collection::vec((0_usize..4, -9_i32..40), 0..60)) {
            for impurity in Impurity::ALL {
                let mut part = Mixture::new(impurity, 4);
                let mut counts = [0_u32; 4];
                for (class, by) in &changes {
                    let by = (*by).max(-(counts[*class] as i32));
                    part.change(*class, by);
                    counts[*class] = counts[*class].saturating_add_signed(by);
                }
                let expected = mixed(impurity, &counts);
                prop_assert_eq!(part.total(), counts.iter().sum::<u32>());
                prop_assert!((part.mixed() - expected).abs() < 1e-6, "{:?}: {} {}", impurity, part.mixed(), expected);
            }
        }
    }
}
