//! Which comparisons of inputs tell rows apart that do different things.

use super::{Decimal, Kind, OPEN, Valued, boxes, cart};
use crate::logic::impurity::Impurity;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::borrow::Cow;
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

/// Of the gaps between two values of a column, by their codes, the one in which the shortest number lies.
pub(super) fn shortest(valued: &Valued, column: usize, last: u32, next: u32) -> Asks {
    let values = valued.columns.get(column).map(|column| &column.kind);
    let Some(Kind::Number(_, values)) = values else {
        return Asks::AtMost(last);
    };
    let (Some((low, _)), Some((high, _))) = (values.get(last as usize), values.get(next as usize))
    else {
        return Asks::AtMost(last);
    };
    let cut = low.up_to(high).value();
    let gap = values.get(last as usize..next as usize).unwrap_or_default();
    let below = gap.partition_point(|(number, _)| number.value() <= cut);
    Asks::AtMost(last + (below.max(1) - 1) as u32)
}

impl Valued {
    /// Comparisons, by column, that tell apart any two rows that do different things and differ in an input, with the table over
    /// them.
    ///
    /// They are all values of a category that appear, and of a number all cuts between neighbouring values whose rows do
    /// different things. Where those are many they are the ones that a list of boxes or partitions of the rows (CART) use,
    /// whichever are fewer. Where rows allow several behaviours, those that have one in common need not be told apart: rows
    /// that are not, allow in the table what all of them do.
    pub fn compared(&self) -> (Vec<Comparison>, Cow<'_, Self>) {
        let all = self.inputs().flat_map(|(column, _)| {
            let asks = self.boundaries(column).into_iter();
            asks.map(move |asks| Comparison { column, asks })
        });
        let all: Vec<Comparison> = all.collect();
        let many = all.len() > ALL;
        if !many && all.len().saturating_mul(self.len()) <= AREA {
            return (all, Cow::Borrowed(self));
        }
        let several = (0..self.len()).any(|row| self.allowed(row).len() > 1);
        let apart = || self.partitioned(false).unwrap_or_else(|| all.clone());
        if several && !(many && self.leaves_choice()) {
            return (apart(), Cow::Borrowed(self));
        }
        let (partitioned, listed) = rayon::join(|| self.partitioned(several), || boxes::used(self));
        let listed = listed.map(|listed| listed.into_iter().collect());
        let both = [partitioned, listed].into_iter().flatten();
        let fewer = both.min_by_key(Vec::len);
        match fewer.and_then(|fewer| Some((self.narrowed(&fewer)?, fewer))) {
            Some((narrowed, fewer)) => (fewer, Cow::Owned(narrowed)),
            None => (apart(), Cow::Borrowed(self)),
        }
    }

    /// Whether no row leaves an input open, and no two say different things of one state.
    fn leaves_choice(&self) -> bool {
        let open = self
            .columns
            .iter()
            .any(|column| column.codes.contains(&OPEN));
        if open {
            return false;
        }
        let mut known: FxHashMap<Vec<u32>, u32> = FxHashMap::default();
        let mut rows = self.decided.iter().enumerate();
        rows.all(|(row, decided)| {
            let codes = (0..self.columns.len()).map(|column| self.code(column, row));
            *known.entry(codes.collect()).or_insert(*decided) == *decided
        })
    }

    /// The table in which rows that these comparisons do not tell apart allow what all of them do; `None` if that is nothing.
    fn narrowed(&self, comparisons: &[Comparison]) -> Option<Self> {
        let kinds = self.kinds(comparisons);
        let mut groups: FxHashMap<Vec<u32>, Vec<usize>> = FxHashMap::default();
        for row in 0..self.len() {
            let kinds = kinds.iter().enumerate().map(|(column, kinds)| {
                let code = self.code(column, row);
                kinds.get(code as usize).copied().unwrap_or(code)
            });
            groups.entry(kinds.collect()).or_default().push(row);
        }
        let mut narrowed = self.clone();
        let mut groups: Vec<Vec<usize>> = groups.into_values().collect();
        groups.sort_unstable();
        for rows in groups {
            let first = self.allowed(*rows.first()?).iter();
            let all = first
                .filter(|behavior| rows.iter().all(|row| self.allowed(*row).contains(behavior)));
            let all: Vec<u32> = all.copied().collect();
            if all.is_empty() {
                return None;
            }
            let decided = narrowed.behaviors.several(all);
            for row in rows {
                if let Some(slot) = narrowed.decided.get_mut(row) {
                    *slot = decided;
                }
            }
        }
        Some(narrowed)
    }

    /// The kind of each code of each column. Codes that no comparison tells apart are of one kind.
    fn kinds(&self, comparisons: &[Comparison]) -> Vec<Vec<u32>> {
        let columns = self.columns.iter().enumerate().map(|(column, of)| {
            let own = comparisons.iter().filter(|own| own.column == column);
            let mut own: Vec<Asks> = own.map(|own| own.asks).collect();
            own.sort_unstable();
            let codes = 0..of.kind.values() as u32;
            let kinds = codes.map(|code| match of.kind {
                Kind::Truth(_) => code,
                Kind::Number(..) => own.partition_point(|asks| !asks.holds(code)) as u32,
                Kind::Category(_) => match own.binary_search(&Asks::Is(code)) {
                    Ok(asked) => asked as u32,
                    Err(_) => own.len() as u32,
                },
            });
            kinds.collect()
        });
        columns.collect()
    }

    /// The comparisons that partitions of the rows use.
    fn partitioned(&self, shared: bool) -> Option<Vec<Comparison>> {
        let partitions = [Impurity::Gini, Impurity::Entropy];
        let partitions = partitions.into_par_iter();
        let partitions = partitions.map(|impurity| cart::used(self, impurity, shared));
        let used: Vec<BTreeSet<Comparison>> = partitions.flatten().collect();
        let both: BTreeSet<Comparison> = used.iter().flatten().copied().collect();
        let fewest = used.into_iter().min_by_key(BTreeSet::len);
        match fewest {
            _ if !both.is_empty() && both.len() <= SEVERAL => Some(both.into_iter().collect()),
            fewest => fewest.map(|fewest| fewest.into_iter().collect()),
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
