//! The search for a small list: lists by many tastes, then the best with its end built anew behind a part of its beginning.

use super::tidy::tidy;
use super::{List, WEIGHT, Worth, covering};
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::minimise::random::Random;

/// Lists that are made before one of them is built anew.
const STARTS: usize = 6;
/// The weights of classes that are tried at random, in 256ths.
const WEIGHTS: [u32; 5] = [128, 180, 256, 360, 512];
/// Attempts without a list as small as the present one after which the search goes on from the best.
const STALE: usize = 60;
/// Attempts without a smaller list after which the search ends.
const ENOUGH: usize = 600;
/// A list may be this much larger than the present one before its end is given up.
const SLACK: usize = 8;
/// Lists that are kept.
const KEPT: usize = 6;

/// The smallest lists that were found within the account, the best last.
pub fn lists(columns: &Columns, classes: &[Bits], reach: u64, account: &Account) -> Vec<List> {
    let mut search = Search {
        columns,
        classes,
        reach,
        account,
        random: Random::new(0),
        kept: Vec::new(),
    };
    search.run();
    search.kept
}

struct Search<'a> {
    columns: &'a Columns,
    classes: &'a [Bits],
    reach: u64,
    account: &'a Account,
    random: Random,
    kept: Vec<List>,
}

impl Search<'_> {
    fn run(&mut self) {
        let all = Bits::full(self.columns.rows());
        let mut present: Option<List> = None;
        let (mut stale, mut idle) = (0, 0);
        for attempt in 0.. {
            if self.account.is_spent() || idle > ENOUGH {
                return;
            }
            idle += 1;
            let worth = self.taste(attempt);
            let (mut list, left, limit) = match &present {
                Some(present) if attempt >= STARTS => {
                    let (list, left) = self.beginning(present);
                    let limit = (present.nodes() + SLACK).saturating_sub(list.nodes());
                    (list, left, limit)
                }
                _ => (List::default(), all.clone(), usize::MAX),
            };
            let (columns, classes) = (self.columns, self.classes);
            let end = covering(columns, classes, &left, &worth, limit, self.account);
            stale += 1;
            if let Some(end) = end {
                list.rules.extend(end.rules);
                list.last = end.last;
                tidy(columns, classes, &mut list, self.account);
                let least = self.kept.last().map_or(usize::MAX, List::nodes);
                if list.nodes() < least {
                    self.kept.push(list.clone());
                    idle = 0;
                }
                let now = present.as_ref().map_or(usize::MAX, List::nodes);
                if list.nodes() <= now {
                    if list.nodes() < now {
                        stale = 0;
                    }
                    present = Some(list);
                }
            }
            if stale > STALE {
                stale = 0;
                present = self.kept.last().cloned();
            }
            if self.kept.len() > KEPT {
                self.kept.remove(0);
            }
        }
    }

    /// The first tastes are the same for every table, the others are drawn.
    fn taste(&mut self, attempt: usize) -> Worth {
        let mut worth = Worth::plain(self.classes.len(), self.reach);
        let largest = self.classes.iter().map(Bits::count).max().unwrap_or(0);
        let mut spared = false;
        match attempt {
            0 => {}
            1 => spared = true,
            2 => worth.squared = true,
            3 => {
                let counts = self.classes.iter().map(Bits::count);
                let share = |count: usize| (WEIGHT as usize * largest / (8 + count)).max(1);
                worth.weights = counts
                    .map(|count| u32::try_from(share(count)).unwrap_or(u32::MAX))
                    .collect();
            }
            _ => {
                for weight in &mut worth.weights {
                    *weight = WEIGHTS
                        .get(self.random.below(WEIGHTS.len()))
                        .copied()
                        .unwrap_or(*weight);
                }
                worth.squared = self.random.below(2) == 0;
                spared = self.random.below(3) == 0;
            }
        }
        if spared {
            let at = self.classes.iter().position(|own| own.count() == largest);
            if let Some(weight) = at.and_then(|at| worth.weights.get_mut(at)) {
                *weight = 0;
            }
        }
        worth
    }

    /// Some rules from the beginning of a list, perhaps all but one of them, as far as they still decide rightly; and the rows that
    /// they leave.
    fn beginning(&mut self, list: &List) -> (List, Bits) {
        let count = self.random.below(list.rules.len().max(1));
        let out = match self.random.below(2) {
            0 => self.random.below(count.max(1)),
            _ => usize::MAX,
        };
        let mut left = Bits::full(self.columns.rows());
        let mut kept = List::default();
        for (at, rule) in list.rules.iter().enumerate().take(count) {
            let words = 8 + self.columns.rows().div_ceil(64) * rule.cube.literals().len();
            self.account.spend(4 * words as u64);
            let met = self.columns.cube_meets(&rule.cube, &left);
            let own = self.classes.get(rule.class);
            let decided = self.columns.cube_rows(&rule.cube, &left);
            let pure = own.is_some_and(|own| met.is_subset(own));
            if at != out && pure && !decided.is_empty() {
                left.subtract(&decided);
                kept.rules.push(rule.clone());
            }
        }
        (kept, left)
    }
}
