//! Lists of boxes that decide as the rows of a table do, for the comparisons that they use.
//!
//! A partition has to go round whatever it has cut off, and so cuts again and again; a list goes over it. Of what the boxes
//! before it leave, each box has rows alone that allow one behaviour (separate and conquer: Fürnkranz 1999).

use super::cuts::shortest;
use super::ordered::Ordered;
use super::{Asks, Comparison, Kind, OPEN, Valued};
use crate::logic::Bits;
use crate::logic::impurity::information;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::borrow::Cow;
use std::collections::BTreeSet;

/// The most cells that are looked at.
const WORK: usize = 200_000_000;

/// The cells of rows on which boxes are compared, where there are more, and how many of the best are compared on all rows.
const GLANCE: usize = 60_000;
const FINALISTS: usize = 2;

/// The most boxes of a list, and how many of the last say how many there are to be.
const BOXES: usize = 200;
const LAST: usize = 8;

/// The rows from which boxes grow, of which the best is taken.
const SEEDS: u64 = 24;

/// How far apart they are, counted round and round.
const STRIDE: u64 = 7919;

/// The most behaviours of a row for which one grows.
const TRIED: usize = 2;

/// What a box costs besides its sides.
const RULE: usize = 1;

/// The comparisons of a list; `None` if that would be too much work, or too many boxes, or rows leave inputs open.
pub(super) fn used(valued: &Valued) -> Option<BTreeSet<Comparison>> {
    let open = |column: &super::Column| column.codes.contains(&OPEN);
    if valued.columns.iter().any(open) {
        return None;
    }
    let mut left: Vec<u32> = (0..u32::try_from(valued.len()).ok()?).collect();
    let mut found = Vec::new();
    let mut work = 0_usize;
    let mut ordered = Ordered::new(valued, &left);
    while !valued.agree(&left) {
        let seeds = seeds(valued, &left, found.len() as u64);
        let best = best(valued, (&left, &ordered), seeds, &mut work)?;
        left.retain(|row| !best.loose.contains(valued, *row));
        ordered.retain(&set(valued, &left));
        found.push(best);
        let last = found.iter().rev().take(LAST);
        let (few, rows) = (last.clone().count(), last.map(|it| it.rows).sum::<usize>());
        let most = (BOXES.saturating_sub(found.len()) * rows).checked_div(few);
        if work > WORK || few == LAST && most.is_some_and(|most| left.len() > most) {
            return None;
        }
    }
    Some(comparisons(valued, &found))
}

/// The box that decides most rows for its price, of those that grow from these seeds. Of many rows some tell which grow on all.
fn best(
    valued: &Valued,
    (left, ordered): (&[u32], &Ordered),
    mut seeds: Vec<Seed>,
    work: &mut usize,
) -> Option<Covering> {
    let cells = left.len() * valued.columns.len();
    if cells > GLANCE {
        *work += cells;
        let step = cells.div_ceil(GLANCE);
        let mut some: Vec<u32> = left.iter().copied().step_by(step).collect();
        some.extend(seeds.iter().map(|(row, _)| *row));
        some.sort_unstable();
        some.dedup();
        let ordered = ordered.only(&set(valued, &some));
        let grown = grown(valued, (&some, &ordered), seeds, work);
        seeds = grown.into_iter().map(|(seed, _)| seed).collect();
        seeds.truncate(FINALISTS);
    }
    let grown = grown(valued, (left, ordered), seeds, work);
    grown.into_iter().map(|(_, grown)| grown).next()
}

/// The boxes that grow from these seeds among some rows, the best first.
fn grown(
    valued: &Valued,
    rows: (&[u32], &Ordered),
    seeds: Vec<Seed>,
    work: &mut usize,
) -> Vec<(Seed, Covering)> {
    let grown = seeds.into_par_iter().map(|(seed, behavior)| {
        let mut growth = Growth::new(valued, rows, behavior);
        let grown = growth.grow(seed);
        (growth.work, grown.map(|grown| ((seed, behavior), grown)))
    });
    let grown: Vec<(usize, Option<(Seed, Covering)>)> = grown.collect();
    *work += grown.iter().map(|(work, _)| work).sum::<usize>();
    let mut grown: Vec<(Seed, Covering)> = grown.into_iter().filter_map(|(_, it)| it).collect();
    grown.sort_by(|(_, a), (_, b)| b.pays().total_cmp(&a.pays()));
    grown
}

/// Rows as a set.
fn set(valued: &Valued, rows: &[u32]) -> Bits {
    Bits::collect(valued.len(), rows.iter().map(|row| *row as usize))
}

/// A row from which a box grows, and the behaviour that its rows are to allow.
type Seed = (u32, u32);

/// The rows from which boxes grow, each with a behaviour that it allows.
fn seeds(valued: &Valued, left: &[u32], number: u64) -> Vec<Seed> {
    // Here and there, and elsewhere each time.
    let rows = (0..SEEDS).filter_map(|seed| {
        let at = (seed * SEEDS + number) * STRIDE % left.len().max(1) as u64;
        left.get(at as usize).copied()
    });
    let rows: BTreeSet<u32> = rows.collect();
    let mut counts: FxHashMap<u32, usize> = FxHashMap::default();
    let allowed = left.iter().flat_map(|row| valued.allowed(*row as usize));
    allowed.for_each(|behavior| *counts.entry(*behavior).or_default() += 1);
    let behaviors = |row: u32| {
        let mut allowed = valued.allowed(row as usize).to_vec();
        allowed
            .sort_by_key(|behavior| std::cmp::Reverse(counts.get(behavior).copied().unwrap_or(0)));
        let tried = allowed.into_iter().take(TRIED);
        tried.map(move |behavior| (row, behavior))
    };
    rows.into_iter().flat_map(behaviors).collect()
}

/// The values that a column may have in a box.
#[derive(Clone, Debug, PartialEq)]
enum Side {
    /// Numbers from a code to another.
    Range(u32, u32),
    /// Those words, or truth values, whose codes are set.
    Values(Vec<bool>),
}

impl Side {
    fn all(kind: &Kind) -> Self {
        match kind {
            Kind::Number(_, values) => Self::Range(0, (values.len().max(1) - 1) as u32),
            kind => Self::Values(vec![true; kind.values()]),
        }
    }

    fn contains(&self, code: u32) -> bool {
        match self {
            Self::Range(low, high) => (*low..=*high).contains(&code),
            Self::Values(values) => values.get(code as usize).copied().unwrap_or(false),
        }
    }
}

/// A box.
#[derive(Clone, Debug, PartialEq)]
struct Bounds(Vec<Side>);

impl Bounds {
    fn contains(&self, valued: &Valued, row: u32) -> bool {
        let mut sides = self.0.iter().enumerate();
        sides.all(|(column, side)| side.contains(valued.code(column, row as usize)))
    }
}

/// A box as large as may be, and as small as may be, around the same rows.
#[derive(Clone, Debug)]
struct Covering {
    loose: Bounds,
    tight: Bounds,
    rows: usize,
    sides: usize,
}

impl Covering {
    /// The rows for what it costs.
    fn pays(&self) -> f64 {
        self.rows as f64 / (self.sides + RULE) as f64
    }
}

/// What narrows a box.
#[derive(Clone, Copy, Debug)]
enum Cut {
    AtMost(u32),
    Above(u32),
    Is(u32),
    IsNot(u32),
}

/// A box that grows around a row, of rows that allow a behaviour.
struct Growth<'v> {
    valued: &'v Valued,
    left: &'v [u32],
    ordered: &'v Ordered,
    /// The rows that allow the behaviour.
    own: Bits,
    work: usize,
}

impl<'v> Growth<'v> {
    fn new(valued: &'v Valued, (left, ordered): (&'v [u32], &'v Ordered), behavior: u32) -> Self {
        let allows = |row: &&u32| valued.allowed(**row as usize).contains(&behavior);
        let own = left.iter().filter(allows).map(|row| *row as usize);
        let own = Bits::collect(valued.len(), own);
        Self {
            valued,
            left,
            ordered,
            own,
            work: 0,
        }
    }

    fn allows(&self, row: u32) -> bool {
        self.own.contains(row as usize)
    }

    /// The box around a row; `None` if no box divides it from all others.
    fn grow(&mut self, seed: u32) -> Option<Covering> {
        let columns = &self.valued.columns;
        let mut bounds = Bounds(columns.iter().map(|it| Side::all(&it.kind)).collect());
        let mut inside: Vec<u32> = self.left.to_vec();
        let mut ordered = Cow::Borrowed(self.ordered);
        let mut cuts: Vec<(usize, Cut)> = Vec::new();
        while inside.iter().any(|row| !self.allows(*row)) {
            let (column, cut) = self.best(seed, &inside, &ordered)?;
            narrow(bounds.0.get_mut(column)?, cut);
            cuts.push((column, cut));
            let side = bounds.0.get(column)?;
            inside.retain(|row| side.contains(self.valued.code(column, *row as usize)));
            let stay = set(self.valued, &inside);
            match &mut ordered {
                Cow::Borrowed(all) => ordered = Cow::Owned(all.only(&stay)),
                Cow::Owned(some) => some.retain(&stay),
            }
        }
        self.widen(&mut bounds, &cuts, seed);
        let rows = self.left.iter().copied();
        let rows: Vec<u32> = rows
            .filter(|row| bounds.contains(self.valued, *row))
            .collect();
        let sides = bounds.0.iter().zip(columns);
        let sides = sides.map(|(side, column)| asked(side, &column.kind));
        Some(Covering {
            sides: sides.sum(),
            tight: self.tight(&rows),
            loose: bounds,
            rows: rows.len(),
        })
    }

    /// The cut that leaves out most of the other rows for what it leaves out of its own (FOIL: Quinlan 1990).
    fn best(&mut self, seed: u32, inside: &[u32], ordered: &Ordered) -> Option<(usize, Cut)> {
        self.work += inside.len() * self.valued.columns.len();
        let all = inside.iter().filter(|row| self.allows(**row)).count() as u32;
        let total = [all, inside.len() as u32 - all];
        let before = information(all, inside.len() as u32);
        let mut best: Option<(f64, usize, Cut)> = None;
        let mut offer = |column: usize, cut: Cut, [kept, others]: [u32; 2]| {
            if kept == 0 || others == total[1] {
                return;
            }
            let gain = f64::from(kept) * (before - information(kept, kept + others));
            if best.is_none_or(|(most, ..)| gain > most + 1e-9) {
                best = Some((gain, column, cut));
            }
        };
        let columns = self.valued.columns.iter().zip(ordered.columns());
        for (column, (of, cells)) in columns.enumerate() {
            let here = self.valued.code(column, seed as usize);
            let groups: Vec<(u32, [u32; 2])> = cells
                .chunk_by(|a, b| a.code == b.code)
                .map(|group| {
                    let own = group.iter().filter(|cell| self.allows(cell.row)).count() as u32;
                    let code = group.first().map_or(0, |cell| cell.code);
                    (code, [own, group.len() as u32 - own])
                })
                .collect();
            let rest = |[own, others]: [u32; 2]| [total[0] - own, total[1] - others];
            if matches!(of.kind, Kind::Number(..)) {
                let mut so_far = [0, 0];
                for (at, (code, [own, others])) in groups.iter().enumerate() {
                    so_far = [so_far[0] + own, so_far[1] + others];
                    if at + 1 == groups.len() {
                        continue;
                    }
                    match *code >= here {
                        true => offer(column, Cut::AtMost(*code), so_far),
                        false => offer(column, Cut::Above(*code), rest(so_far)),
                    }
                }
            } else {
                for (code, counts) in &groups {
                    match *code == here {
                        true => offer(column, Cut::Is(*code), *counts),
                        false => offer(column, Cut::IsNot(*code), rest(*counts)),
                    }
                }
            }
        }
        best.map(|(_, column, cut)| (column, cut))
    }

    /// Takes cuts back without which no other row comes in, and moves those that stay as far out as may be.
    fn widen(&mut self, bounds: &mut Bounds, cuts: &[(usize, Cut)], seed: u32) {
        let others = self.left.iter().copied().filter(|row| !self.allows(*row));
        let others: Vec<u32> = others.collect();
        let mut widened = BTreeSet::new();
        for column in cuts.iter().map(|(column, _)| *column) {
            if !widened.insert(column) {
                continue;
            }
            self.work += others.len() * self.valued.columns.len();
            // The other rows that this column alone keeps out.
            let Some(of) = self.valued.columns.get(column) else {
                continue;
            };
            let whole = Side::all(&of.kind);
            let mut without = bounds.clone();
            if let Some(side) = without.0.get_mut(column) {
                side.clone_from(&whole);
            }
            let held = others.iter().copied();
            let held = held.filter(|row| without.contains(self.valued, *row));
            let held = held.map(|row| self.valued.code(column, row as usize));
            let held: Vec<u32> = held.collect();
            let here = self.valued.code(column, seed as usize);
            let side = match whole {
                Side::Range(low, high) => {
                    let below = held.iter().filter(|code| **code < here).max();
                    let above = held.iter().filter(|code| **code > here).min();
                    Side::Range(
                        below.map_or(low, |code| code + 1),
                        above.map_or(high, |code| code - 1),
                    )
                }
                Side::Values(values) => {
                    let out: BTreeSet<u32> = held.into_iter().collect();
                    let kept = (0_u32..).zip(values.iter());
                    let kept: Vec<bool> = kept.map(|(code, _)| !out.contains(&code)).collect();
                    // To be one value is one question, to be none of several is as many.
                    let only = (0_u32..).zip(values.iter());
                    match out.len() > 1 {
                        true => Side::Values(only.map(|(code, _)| code == here).collect()),
                        false => Side::Values(kept),
                    }
                }
            };
            if let Some(slot) = bounds.0.get_mut(column) {
                *slot = side;
            }
        }
    }

    /// The smallest box around rows.
    fn tight(&self, rows: &[u32]) -> Bounds {
        let columns = self.valued.columns.iter().enumerate();
        let sides = columns.map(|(column, of)| {
            let codes = rows
                .iter()
                .map(|row| self.valued.code(column, *row as usize));
            match Side::all(&of.kind) {
                Side::Range(low, high) => Side::Range(
                    codes.clone().min().unwrap_or(low),
                    codes.max().unwrap_or(high),
                ),
                values @ Side::Values(_) => values,
            }
        });
        Bounds(sides.collect())
    }
}

fn narrow(side: &mut Side, cut: Cut) {
    match (side, cut) {
        (Side::Range(_, high), Cut::AtMost(code)) => *high = (*high).min(code),
        (Side::Range(low, _), Cut::Above(code)) => *low = (*low).max(code + 1),
        (Side::Values(values), Cut::Is(code)) => {
            for (at, value) in (0_u32..).zip(values) {
                *value = at == code;
            }
        }
        (Side::Values(values), Cut::IsNot(code)) => {
            if let Some(value) = values.get_mut(code as usize) {
                *value = false;
            }
        }
        _ => {}
    }
}

/// How many questions a side asks.
fn asked(side: &Side, kind: &Kind) -> usize {
    match (side, Side::all(kind)) {
        (Side::Range(low, high), Side::Range(first, last)) => {
            usize::from(*low > first) + usize::from(*high < last)
        }
        (Side::Values(values), _) => {
            let out = values.iter().filter(|value| !**value).count();
            out.min(1)
        }
        _ => 0,
    }
}

/// The comparisons of these boxes: as few as let each be anything between its largest and its smallest form.
fn comparisons(valued: &Valued, found: &[Covering]) -> BTreeSet<Comparison> {
    let mut all = BTreeSet::new();
    for (column, of) in valued.columns.iter().enumerate() {
        let sides = found
            .iter()
            .filter_map(|it| Some((it.loose.0.get(column)?, it.tight.0.get(column)?)));
        let mut cuts: Vec<(u32, u32)> = Vec::new();
        let mut asks: BTreeSet<Asks> = BTreeSet::new();
        for (loose, tight) in sides {
            match (loose, tight, Side::all(&of.kind)) {
                (Side::Range(low, high), Side::Range(first, last), Side::Range(least, most)) => {
                    if *low > least {
                        cuts.push((first - 1, low - 1));
                    }
                    if *high < most {
                        cuts.push((*high, *last));
                    }
                }
                (Side::Values(values), ..) if !matches!(of.kind, Kind::Truth(_)) => {
                    let codes = |wanted: bool| {
                        let codes = (0_u32..).zip(values);
                        let codes = codes.filter(move |(_, value)| **value == wanted);
                        codes.map(|(code, _)| Asks::Is(code))
                    };
                    match codes(true).count() {
                        1 => asks.extend(codes(true)),
                        _ => asks.extend(codes(false)),
                    }
                }
                _ => {}
            }
        }
        // Of intervals by their upper ends, each that meets the one before shares its cut.
        cuts.sort_unstable();
        let mut shared: Option<(u32, u32)> = None;
        for (upper, lower) in cuts {
            shared = match shared {
                Some((top, from)) if lower <= top => Some((top, from.max(lower))),
                before => {
                    asks.extend(before.map(|(top, from)| shortest(valued, column, from, top + 1)));
                    Some((upper, lower))
                }
            };
        }
        asks.extend(shared.map(|(top, from)| shortest(valued, column, from, top + 1)));
        all.extend(asks.into_iter().map(|asks| Comparison { column, asks }));
    }
    all
}
