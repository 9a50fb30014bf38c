//! The search for the best rule, by branch and bound.

use super::table::Table;
use super::{Rule, Worth};
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::cube::{Cube, Literal};

impl Table {
    /// The rule that is worth most among the rows left, if that is more than `floor`. Classes of no weight have rules only where
    /// all others have none.
    pub(super) fn best(
        &self,
        left: &Bits,
        worth: &Worth,
        floor: u64,
        account: &Account,
    ) -> Option<(u64, Rule)> {
        let found = self.by_worth(left, worth, floor, account);
        if found.is_some() || floor > 0 {
            return found;
        }
        let plain = Worth::plain(worth.weights.len(), worth.reach);
        self.by_worth(left, &plain, floor, account)
    }

    fn by_worth(
        &self,
        left: &Bits,
        worth: &Worth,
        floor: u64,
        account: &Account,
    ) -> Option<(u64, Rule)> {
        let mut best: Option<(u64, Rule)> = None;
        let open: Vec<Literal> = (0..self.columns.atoms())
            .flat_map(|atom| [true, false].map(|positive| Literal { atom, positive }))
            .collect();
        for (class, own) in &self.classes {
            let on = own.and(left);
            if worth.weight(*class) == 0 || on.is_empty() {
                continue;
            }
            let mut search = Search {
                table: self,
                worth,
                class: *class,
                chosen: Vec::new(),
                best: best.as_ref().map_or(floor, |(worth, _)| *worth),
                found: None,
                left: worth.reach,
            };
            search.extend(&on, &left.minus(own), &open);
            account.spend(worth.reach - search.left);
            if let Some(literals) = search.found {
                let rule = Rule {
                    class: *class,
                    cube: Cube::new(literals),
                };
                best = Some((search.best, rule));
            }
        }
        best
    }
}

/// A literal that may be added to a cube: the rows of the class that stay in it, and others that it still meets.
#[derive(Clone, Copy)]
struct Step {
    literal: Literal,
    kept: usize,
    met: usize,
}

/// The search for the best rule of one class.
struct Search<'a> {
    table: &'a Table,
    worth: &'a Worth,
    class: usize,
    chosen: Vec<Literal>,
    /// The worth of the best rule so far, of any class.
    best: u64,
    found: Option<Vec<Literal>>,
    left: u64,
}

impl Search<'_> {
    fn worth(&self, decided: usize, literals: usize) -> u64 {
        self.worth.of(self.class, decided, literals)
    }

    /// What the literals of `open` come to that exclude something and keep enough. Of those that exclude all, the best is the
    /// best rule so far.
    fn steps(&mut self, on: &Bits, off: &Bits, open: &[Literal]) -> Vec<Step> {
        let words = 2 + on.bound().div_ceil(64) as u64;
        let (own, others) = (on.count(), off.count());
        let literals = self.chosen.len() + 1;
        let count = |rows: &Bits, all: usize, (column, inside): (Option<&Bits>, bool)| {
            let both = column.map_or(0, |column| rows.count_both(column));
            if inside { both } else { all - both }
        };
        let mut work = open.len() as u64 * words;
        let mut steps = Vec::new();
        for literal in open.iter().copied() {
            let columns = &self.table.columns;
            let kept = count(on, own, columns.inside(literal));
            let worth = self.worth(kept, literals);
            if worth <= self.best {
                continue;
            }
            work += words;
            let met = count(off, others, columns.meeting(literal));
            if met == 0 {
                self.best = worth;
                let chosen = self.chosen.iter().copied().chain([literal]);
                self.found = Some(chosen.collect());
            } else if met < others {
                steps.push(Step { literal, kept, met });
            }
        }
        self.left = self.left.saturating_sub(work);
        steps
    }

    /// Every rule that may be worth more than the best, within the work.
    fn extend(&mut self, on: &Bits, off: &Bits, open: &[Literal]) {
        let mut steps = self.steps(on, off, open);
        let others = off.count();
        let excludes = steps.iter().map(|step| others - step.met).max();
        let excludes = excludes.unwrap_or(0).max(1);
        let literals = self.chosen.len() + 1;
        // The most that a cube with this step can be worth: no literal excludes more than one here.
        let bound = |step: &Step| literals + step.met.div_ceil(excludes);
        steps.retain(|step| self.worth(step.kept, bound(step)) > self.best);
        // Those that keep most for what they leave are tried first, and none before it is tried with it again.
        steps.sort_by_cached_key(|step| {
            let ratio = (step.kept << 16) / (1 + step.met);
            (std::cmp::Reverse(ratio), step.literal)
        });
        let mut rest = steps.as_slice();
        while let [step, others @ ..] = rest {
            rest = others;
            if self.left == 0 || others.is_empty() {
                return;
            }
            if self.worth(step.kept, bound(step)) <= self.best {
                continue;
            }
            let open: Vec<Literal> = others.iter().map(|step| step.literal).collect();
            let columns = &self.table.columns;
            let mut kept = on.clone();
            columns.restrict(&mut kept, step.literal);
            let met = columns.cube_meets(&Cube::new([step.literal]), off);
            self.chosen.push(step.literal);
            self.extend(&kept, &met, &open);
            self.chosen.pop();
        }
    }
}
