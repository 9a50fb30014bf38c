//! Which comparisons of inputs tell rows apart that do different things.

use super::{Decimal, Kind, OPEN, Valued, cart};
use crate::logic::impurity::Impurity;
use std::collections::BTreeSet;

/// The most comparisons that are all made: with more, only those that a partition of the rows uses.
const ALL: usize = 192;

/// The most rows times comparisons where all are made.
const AREA: usize = 8_000_000;

/// Where more comparisons than this come of two partitions, one is enough.
const SEVERAL: usize = 512;

/// What is asked of one column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Asks {
    /// Whether its number is at most that of this code, and so below the next one.
    AtMost(u32),
    /// Whether it has the value of this code.
    Is(u32),
}

impl Asks {
    /// Whether it holds for a code.
    pub fn holds(self, code: u32) -> bool {
        match self {
            Self::AtMost(last) => code <= last,
            Self::Is(value) => code == value,
        }
    }
}

/// A question about one input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Comparison {
    /// The column.
    pub column: usize,
    /// What is asked of it.
    pub asks: Asks,
}

impl Valued {
    /// Comparisons that tell apart any two rows that do different things and differ in an input, by column.
    ///
    /// They are all values of a category that appear, and of a number all cuts between neighbouring values whose rows do
    /// different things. Where those are many they are the ones that partitions of the rows use (CART).
    pub fn comparisons(&self) -> Vec<Comparison> {
        let all: Vec<Comparison> = self
            .inputs()
            .flat_map(|(column, _)| {
                let asks = self.boundaries(column);
                asks.into_iter()
                    .map(move |asks| Comparison { column, asks })
            })
            .collect();
        if all.len() <= ALL && all.len().saturating_mul(self.len()) <= AREA {
            return all;
        }
        let partitions = [Impurity::Gini, Impurity::Entropy];
        let partitions = partitions.map(|impurity| cart::used(self, impurity));
        let used: Vec<BTreeSet<Comparison>> = partitions.into_iter().flatten().collect();
        let both: BTreeSet<Comparison> = used.iter().flatten().copied().collect();
        let fewest = used.into_iter().min_by_key(BTreeSet::len);
        match fewest {
            _ if !both.is_empty() && both.len() <= SEVERAL => both.into_iter().collect(),
            Some(fewest) => fewest.into_iter().collect(),
            None => all,
        }
    }

    /// Where a column tells rows apart that do different things.
    fn boundaries(&self, column: usize) -> Vec<Asks> {
        let Some(column) = self.columns.get(column) else {
            return Vec::new();
        };
        // What all rows with a value do, if they do the same.
        let mut does: Vec<Option<Option<u32>>> = vec![None; column.kind.values()];
        for (code, decided) in column.codes.iter().zip(&self.decided) {
            if let Some(does) = does.get_mut(*code as usize) {
                *does = match *does {
                    None => Some(Some(*decided)),
                    Some(same) => Some(same.filter(|same| same == decided)),
                };
            }
        }
        let met = does.iter().zip(0_u32..);
        let met = met.filter_map(|(does, code)| Some(((*does)?, code)));
        let met: Vec<(Option<u32>, u32)> = met.collect();
        match column.kind {
            Kind::Truth(_) => Vec::new(),
            Kind::Category(_) => match met.as_slice() {
                // A value that every row has says nothing.
                [_] if !column.codes.contains(&OPEN) => Vec::new(),
                _ => met.iter().map(|(_, code)| Asks::Is(*code)).collect(),
            },
            Kind::Number(..) => {
                let pairs = met.iter().zip(met.iter().skip(1));
                let differ = pairs.filter(|((a, _), (b, _))| a.is_none() || a != b);
                differ.map(|((_, code), _)| Asks::AtMost(*code)).collect()
            }
        }
    }

    /// The number that a cut compares with: the shortest between the two values.
    pub fn cut(&self, column: usize, last: u32) -> Option<Decimal> {
        let Kind::Number(measure, values) = &self.columns.get(column)?.kind else {
            return None;
        };
        let (low, from) = values.get(last as usize)?;
        let Some((high, to)) = values.get(last as usize + 1) else {
            return Some(low.clone());
        };
        let cut = low.up_to(high);
        let at = measure.unit.si(cut.value());
        Some(match *from <= at && at < *to {
            true => cut,
            false => low.clone(),
        })
    }
}
