//! The search for a smaller list with groups: the end of one of its lists is sought anew, in the list itself or in a group of it.
//!
//! Where one part of a large list is too large, nearly all lists that are made from nothing are too large in another. So one is kept,
//! and now this part of it is made anew, now that. An attempt looks at few rows and costs little.

use super::grouped::{Bounds, DEPTH, Grouped, Part, Search, picked};
use super::rebuild::{Known, lists};
use super::tidy::tidy;
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::cube::Cube;
use crate::logic::random::Random;

/// Of a hundred attempts so many go into a group where there is one, and so many look for a flat list first.
const DEEPER: usize = 60;
const FLAT: usize = 20;
/// Of a hundred lists that are larger than the present one, so many take its place, if by no more than this.
const WORSE: usize = 20;
const LARGER: usize = 2;
/// Attempts without a list smaller than the present one after which the search goes on from the best.
const STALE: usize = 30;
/// Cubes that an attempt may use beside those of the list.
const OTHERS: usize = 100;
/// Attempts at a list for rows that a list which is to be right on them does not decide rightly.
const ANEW: usize = 6;
/// What an attempt may look at.
const BOUNDS: Bounds = Bounds {
    reach: 8000,
    patience: 3,
    sought: 2,
    passes: true,
};

/// A search among the rows of a table, which are minterms.
#[derive(Debug)]
pub struct Regroup<'a> {
    columns: &'a Columns,
    classes: &'a [Bits],
    account: &'a Account,
    random: Random,
    /// What the present attempt knows.
    known: Known,
}

impl<'a> Regroup<'a> {
    /// A search within an account.
    pub fn new(columns: &'a Columns, classes: &'a [Bits], account: &'a Account) -> Self {
        Self {
            columns,
            classes,
            account,
            random: Random::new(1),
            known: Known::default(),
        }
    }

    /// The smallest list that is found from this one before `patience` attempts find no smaller one. The list may be wrong on some rows,
    /// the result is not; `None` where the account does not go so far. Cubes that turn up join those that are known.
    pub fn smaller(
        &mut self,
        list: &Grouped,
        patience: usize,
        known: &mut Known,
    ) -> Option<Grouped> {
        let all = Bits::full(self.columns.rows());
        self.know(list, known);
        let mut best = self.repaired(&all, list)?;
        let mut present = best.clone();
        let (mut vain, mut stale) = (0, 0);
        while vain < patience && !self.account.is_spent() {
            self.know(&present, known);
            let found = self.changed(&all, &present);
            let more = match self.random.below(100) < WORSE {
                true => 1 + self.random.below(LARGER),
                false => 0,
            };
            let smaller = found.nodes() < present.nodes();
            stale = if smaller { 0 } else { stale + 1 };
            vain += 1;
            if stale > STALE {
                stale = 0;
                present = best.clone();
            } else if found.nodes() <= present.nodes() + more {
                present = found;
                for cube in present.cubes() {
                    if !known.cubes.contains(cube) {
                        known.cubes.push(cube.clone());
                    }
                }
            }
            if present.nodes() < best.nodes() {
                best = present.clone();
                vain = 0;
            }
        }
        Some(best)
    }

    /// The next attempt knows the cubes of the list, and some others.
    fn know(&mut self, list: &Grouped, known: &Known) {
        let mut cubes: Vec<Cube> = list.cubes().into_iter().cloned().collect();
        let count = known.cubes.len();
        let others = (0..OTHERS).filter_map(|_| known.cubes.get(self.random.below(count)));
        cubes.extend(others.cloned());
        self.known = Known { cubes, list: None };
    }

    /// A list that decides these rows as this one does, a part of it sought anew.
    fn changed(&mut self, rows: &Bits, list: &Grouped) -> Grouped {
        let parts = list.parts.iter().enumerate();
        let groups = parts.filter(|(_, part)| matches!(part, Part::Group(..)));
        let groups: Vec<usize> = groups.map(|(at, _)| at).collect();
        if groups.is_empty() || self.random.below(100) >= DEEPER {
            return self.ended(rows, list);
        }
        let chosen = groups.get(self.random.below(groups.len()));
        let mut list = list.clone();
        let mut left = rows.clone();
        for (at, part) in list.parts.iter_mut().enumerate() {
            let through = self.through(part, &left);
            match part {
                Part::Group(_, inner) if Some(&at) == chosen => {
                    *inner = self.changed(&through, inner);
                    break;
                }
                _ => left.subtract(&through),
            }
        }
        list
    }

    /// The list with some of its last parts sought anew, and at times one before them.
    fn ended(&mut self, rows: &Bits, list: &Grouped) -> Grouped {
        let from = self.random.below(list.parts.len());
        let out = match self.random.below(2) {
            0 => self.random.below(from.max(1)),
            _ => usize::MAX,
        };
        let mut left = rows.clone();
        let mut front = Vec::new();
        let mut rest = Grouped {
            parts: Vec::new(),
            last: list.last,
        };
        for (at, part) in list.parts.iter().enumerate() {
            let through = self.through(part, &left);
            let stays = at < from && at != out && !through.is_empty();
            if stays && self.is_right(part, &through) {
                left.subtract(&through);
                front.push(part.clone());
            } else {
                rest.parts.push(part.clone());
            }
        }
        let end = self.sought(&left, &rest);
        front.extend(end.parts);
        Grouped {
            parts: front,
            last: end.last,
        }
    }

    /// A new list for these rows, which this one decides rightly.
    fn sought(&mut self, rows: &Bits, list: &Grouped) -> Grouped {
        let (columns, classes) = picked(self.columns, self.classes, rows, self.account);
        let all = Bits::full(columns.rows());
        let mut flat = list.flat();
        tidy(&columns, &classes, &all, &mut flat, self.account);
        let mut flat = (all, flat);
        let seed = self.random.below(1 << 40) as u64;
        let flat_first = self.random.below(100) < FLAT;
        let known = &mut self.known;
        let mut search = Search::new(&columns, &classes, known, self.account, seed, BOUNDS);
        if flat_first {
            search.sought(&mut flat);
        }
        search.divided(&flat.0, flat.1, DEPTH)
    }

    /// A list that decides these rows rightly, made of what one that may not do so can keep.
    fn repaired(&mut self, rows: &Bits, list: &Grouped) -> Option<Grouped> {
        let mut left = rows.clone();
        let mut parts = Vec::new();
        for part in &list.parts {
            let through = self.through(part, &left);
            match part {
                _ if through.is_empty() => continue,
                Part::Rule(rule) if !self.has(rule.class, &through) => continue,
                Part::Rule(_) => parts.push(part.clone()),
                Part::Group(cube, inner) => {
                    let inner = self.repaired(&through, inner)?;
                    parts.push(Part::Group(cube.clone(), inner));
                }
            }
            left.subtract(&through);
        }
        if self.has(list.last, &left) {
            let last = list.last;
            return Some(Grouped { parts, last });
        }
        let (columns, classes) = picked(self.columns, self.classes, &left, self.account);
        self.known.list = None;
        let (reach, known) = (BOUNDS.reach, &mut self.known);
        let found = lists(&columns, &classes, reach, ANEW, known, self.account);
        let end = Grouped::from(found.into_iter().last()?);
        parts.extend(end.parts);
        let last = end.last;
        Some(Grouped { parts, last })
    }

    /// Whether a part decides all of these rows rightly.
    fn is_right(&self, part: &Part, rows: &Bits) -> bool {
        match part {
            Part::Rule(rule) => self.has(rule.class, rows),
            Part::Group(_, inner) => {
                let mut left = rows.clone();
                let right = inner.parts.iter().all(|part| {
                    let through = self.through(part, &left);
                    left.subtract(&through);
                    self.is_right(part, &through)
                });
                right && self.has(inner.last, &left)
            }
        }
    }

    /// The rows among these that a part decides.
    fn through(&self, part: &Part, among: &Bits) -> Bits {
        let words = 8 + self.columns.rows().div_ceil(64);
        let literals = part.cube().literals().len();
        self.account.spend(((2 + literals) * words) as u64);
        self.columns.cube_rows(part.cube(), among)
    }

    /// Whether all of these rows are of a class.
    fn has(&self, class: usize, rows: &Bits) -> bool {
        let own = self.classes.get(class);
        own.is_some_and(|own| rows.is_subset(own))
    }
}
