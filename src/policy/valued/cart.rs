//! Partitions of rows by their values (CART: Breiman, Friedman, Olshen and Stone 1984), for the comparisons that they use.

use super::cuts::shortest;
use super::{Asks, Comparison, Kind, OPEN, Valued};
use crate::logic::impurity::{Impurity, Mixture};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// The most cells that are looked at: rows which leave inputs open are on both sides of what asks them.
const WORK: usize = 500_000_000;

/// The comparisons that a partition uses which ends where all rows of a part do the same, or cannot be told apart; `None` if
/// that would be too much work.
///
/// Where rows allow several behaviours, `shared` says that a part ends where all of its rows allow one.
pub(super) fn used(
    valued: &Valued,
    impurity: Impurity,
    shared: bool,
) -> Option<BTreeSet<Comparison>> {
    let mut found = BTreeSet::new();
    let mut work = 0_usize;
    let rows = u32::try_from(valued.len()).unwrap_or(u32::MAX);
    let mut open: Vec<Vec<u32>> = vec![(0..rows).collect()];
    while let Some(part) = open.pop() {
        work = work.saturating_add(part.len() * valued.columns.len());
        if work > WORK {
            return None;
        }
        let classes = match shared {
            true => favoured(valued, &part),
            false => decided(valued, &part),
        };
        let Some(best) = classes.and_then(|classes| best(valued, &part, &classes, impurity)) else {
            continue;
        };
        let best = moved(valued, best, &found);
        if !matches!(kind(valued, best.column), Some(Kind::Truth(_))) {
            found.insert(best);
        }
        let side = |wanted: bool| {
            let rows = part.iter().copied();
            let on = rows.filter(|row| match code(valued, best.column, *row) {
                OPEN => true,
                code => best.asks.holds(code) == wanted,
            });
            on.collect::<Vec<u32>>()
        };
        open.extend([side(true), side(false)]);
    }
    Some(found)
}

fn kind(valued: &Valued, column: usize) -> Option<&Kind> {
    valued.columns.get(column).map(|column| &column.kind)
}

fn code(valued: &Valued, column: usize, row: u32) -> u32 {
    let column = valued.columns.get(column);
    let code = column.and_then(|column| column.codes.get(row as usize));
    code.copied().unwrap_or(OPEN)
}

/// A split between two values of a part, moved to where a comparison is used already, if one divides the part alike.
fn moved(valued: &Valued, split: Split, used: &BTreeSet<Comparison>) -> Comparison {
    let Split { best, next } = split;
    let (Asks::AtMost(last), Some(next)) = (best.asks, next) else {
        return best;
    };
    let at = |last: u32| Comparison {
        column: best.column,
        asks: Asks::AtMost(last),
    };
    if let Some(known) = used.range(at(last)..at(next)).next() {
        return *known;
    }
    Comparison {
        column: best.column,
        asks: shortest(valued, best.column, last, next),
    }
}

/// A comparison that divides a part, with the next greater code of the part.
struct Split {
    best: Comparison,
    next: Option<u32>,
}

/// What the rows of a part do, numbered from 0; `None` where all do the same.
fn decided(valued: &Valued, part: &[u32]) -> Option<Vec<usize>> {
    let decided = |row: &u32| valued.decided.get(*row as usize).copied().unwrap_or(0);
    numbered(part.iter().map(decided))
}

/// Of what each row of a part allows, what most of its rows allow, numbered from 0; `None` where all allow one.
fn favoured(valued: &Valued, part: &[u32]) -> Option<Vec<usize>> {
    let mut counts: FxHashMap<u32, usize> = FxHashMap::default();
    for row in part {
        for behavior in valued.allowed(*row as usize) {
            *counts.entry(*behavior).or_default() += 1;
        }
    }
    let count = |behavior: &u32| counts.get(behavior).copied().unwrap_or(0);
    let favourite = |row: &u32| {
        let all = valued.allowed(*row as usize).iter();
        let most = all.max_by_key(|behavior| (count(behavior), std::cmp::Reverse(**behavior)));
        most.copied().unwrap_or(0)
    };
    numbered(part.iter().map(favourite))
}

fn numbered(classes: impl Iterator<Item = u32>) -> Option<Vec<usize>> {
    let mut numbers: FxHashMap<u32, usize> = FxHashMap::default();
    let local = classes.map(|class| {
        let next = numbers.len();
        *numbers.entry(class).or_insert(next)
    });
    let local: Vec<usize> = local.collect();
    (numbers.len() > 1).then_some(local)
}

/// The comparison that makes the two sides least mixed by their classes; `None` where nothing divides them.
fn best(valued: &Valued, part: &[u32], local: &[usize], impurity: Impurity) -> Option<Split> {
    let classes = local.iter().max().map_or(0, |most| most + 1);
    let none = Mixture::new(impurity, classes);
    let mut best: Option<(f64, Split)> = None;
    for (column, of) in valued.columns.iter().enumerate() {
        let mut left_open = none.clone();
        let mut cells: Vec<u64> = Vec::with_capacity(part.len());
        for (row, class) in part.iter().zip(local) {
            match of.codes.get(*row as usize).copied().unwrap_or(OPEN) {
                OPEN => left_open.change(*class, 1),
                code => cells.push(u64::from(code) << 32 | *class as u64),
            }
        }
        cells.sort_unstable();
        let same = |a: &u64, b: &u64| a >> 32 == b >> 32;
        let groups: Vec<&[u64]> = cells.chunk_by(same).collect();
        let mut all = left_open.clone();
        for cell in &cells {
            all.change((cell & 0xffff_ffff) as usize, 1);
        }
        let mut rest = all.clone();
        let mut taken = left_open.clone();
        let ordered = matches!(of.kind, Kind::Number(..));
        for (at, group) in groups.iter().enumerate() {
            if !ordered {
                (rest, taken) = (all.clone(), left_open.clone());
            }
            let Some(code) = group.first().map(|cell| (cell >> 32) as u32) else {
                continue;
            };
            for cell in *group {
                let class = (cell & 0xffff_ffff) as usize;
                taken.change(class, 1);
                rest.change(class, -1);
            }
            let next = groups.get(at + 1).and_then(|group| group.first());
            let divides = if ordered {
                next.is_some()
            } else {
                groups.len() > 1
            };
            let mixed = taken.mixed() + rest.mixed();
            let better = |(least, _): &(f64, Split)| Impurity::better(mixed, *least);
            if divides && best.as_ref().is_none_or(better) {
                let asks = if ordered {
                    Asks::AtMost(code)
                } else {
                    Asks::Is(code)
                };
                let split = Split {
                    best: Comparison { column, asks },
                    next: next.map(|cell| (cell >> 32) as u32),
                };
                best = Some((mixed, split));
            }
        }
    }
    best.map(|(_, split)| split)
}
