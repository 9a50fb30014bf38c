//! Partitions of rows by their values (CART: Breiman, Friedman, Olshen and Stone 1984), for the comparisons that they use.

use super::cuts::shortest;
use super::ordered::Ordered;
use super::{Asks, Comparison, Kind, OPEN, Valued};
use crate::logic::Bits;
use crate::logic::impurity::{self, Impurity, Mixture};
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
    let rows: Vec<u32> = (0..rows).collect();
    let mut classes = Classes(vec![0; rows.len()]);
    let mut open = vec![(Ordered::new(valued, &rows), rows, 0)];
    while let Some((ordered, rows, depth)) = open.pop() {
        work = work.saturating_add(rows.len() * valued.columns.len());
        if work > WORK {
            return None;
        }
        let count = match shared {
            true => classes.favoured(valued, &rows),
            false => classes.decided(valued, &rows),
        };
        let evenly = impurity::evenly(count, rows.len(), depth);
        let best = || best(valued, &ordered, (&classes, count), (impurity, evenly));
        let best = (count > 1).then(best);
        let Some(best) = best.flatten() else {
            continue;
        };
        let best = moved(valued, best, &found);
        if !matches!(kind(valued, best.column), Some(Kind::Truth(_))) {
            found.insert(best);
        }
        open.extend([true, false].map(|wanted| {
            let is_on = |row: &u32| match code(valued, best.column, *row) {
                OPEN => true,
                code => best.asks.holds(code) == wanted,
            };
            let on: Vec<u32> = rows.iter().copied().filter(is_on).collect();
            let numbers = on.iter().map(|row| *row as usize);
            let part = Bits::collect(valued.len(), numbers);
            (ordered.only(&part), on, depth + 1)
        }));
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

/// What each row of a part is to do, numbered from 0.
struct Classes(Vec<usize>);

impl Classes {
    /// What the rows of a part do; gives how many things that are.
    fn decided(&mut self, valued: &Valued, part: &[u32]) -> usize {
        self.number(part, |row| {
            valued.decided.get(row as usize).copied().unwrap_or(0)
        })
    }

    /// Of what each row of a part allows, what most of its rows allow; gives how many things that are.
    fn favoured(&mut self, valued: &Valued, part: &[u32]) -> usize {
        let mut counts: FxHashMap<u32, usize> = FxHashMap::default();
        for row in part {
            for behavior in valued.allowed(*row as usize) {
                *counts.entry(*behavior).or_default() += 1;
            }
        }
        let count = |behavior: &u32| counts.get(behavior).copied().unwrap_or(0);
        self.number(part, |row| {
            let all = valued.allowed(row as usize).iter();
            let most = all.max_by_key(|behavior| (count(behavior), std::cmp::Reverse(**behavior)));
            most.copied().unwrap_or(0)
        })
    }

    fn number(&mut self, part: &[u32], class: impl Fn(u32) -> u32) -> usize {
        let mut numbers: FxHashMap<u32, usize> = FxHashMap::default();
        for row in part {
            let next = numbers.len();
            let number = *numbers.entry(class(*row)).or_insert(next);
            if let Some(slot) = self.0.get_mut(*row as usize) {
                *slot = number;
            }
        }
        numbers.len()
    }

    fn of(&self, row: u32) -> usize {
        self.0.get(row as usize).copied().unwrap_or(0)
    }
}

/// The comparison that makes the two sides least mixed by their classes, or most even; `None` where nothing divides them.
fn best(
    valued: &Valued,
    ordered: &Ordered,
    (classes, count): (&Classes, usize),
    (impurity, evenly): (Impurity, bool),
) -> Option<Split> {
    let none = Mixture::new(impurity, count);
    let mut best: Option<(f64, Split)> = None;
    for (column, (of, cells)) in valued.columns.iter().zip(ordered.columns()).enumerate() {
        let (cells, open) = cells.split_at(cells.partition_point(|cell| cell.code != OPEN));
        let mut left_open = none.clone();
        for cell in open {
            left_open.change(classes.of(cell.row), 1);
        }
        let mut all = left_open.clone();
        for cell in cells {
            all.change(classes.of(cell.row), 1);
        }
        let (mut rest, mut taken) = (all, left_open);
        let ordered = matches!(of.kind, Kind::Number(..));
        let mut groups = cells.chunk_by(|a, b| a.code == b.code).peekable();
        let mut divided = false;
        while let Some(group) = groups.next() {
            let Some(code) = group.first().map(|cell| cell.code) else {
                continue;
            };
            for cell in group {
                let class = classes.of(cell.row);
                taken.change(class, 1);
                rest.change(class, -1);
            }
            let next = groups.peek().and_then(|group| group.first());
            divided = next.is_some() || divided && !ordered;
            let mixed = impurity::of_division([&taken, &rest], evenly);
            let better = |(least, _): &(f64, Split)| Impurity::better(mixed, *least);
            if divided && best.as_ref().is_none_or(better) {
                let asks = if ordered {
                    Asks::AtMost(code)
                } else {
                    Asks::Is(code)
                };
                let split = Split {
                    best: Comparison { column, asks },
                    next: next.map(|cell| cell.code),
                };
                best = Some((mixed, split));
            }
            // Words stand alone.
            for cell in group.iter().filter(|_| !ordered) {
                let class = classes.of(cell.row);
                taken.change(class, -1);
                rest.change(class, 1);
            }
        }
    }
    best.map(|(_, split)| split)
}
