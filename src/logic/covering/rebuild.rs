//! The search for a small list: lists by many tastes, then one of them with its end built anew behind a part of its beginning.

use super::pool::Pool;
use super::table::Table;
use super::tidy::tidy;
use super::{Covering, List, WEIGHT, Worth};
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::cube::Cube;
use crate::logic::random::Random;

/// Lists that are made before one of them is built anew.
const STARTS: usize = 6;
/// The weights of classes that are tried at random, in 256ths.
const WEIGHTS: [u32; 5] = [128, 180, 256, 360, 512];
/// Attempts without a list as small as the present one after which the search goes on from the best.
const STALE: usize = 60;
/// Attempts without a smaller list than the present one after which a list is made from nothing.
const AFRESH: usize = 600;
/// One of so many attempts searches for rules that are not known yet.
const SEEKS: usize = 8;
/// Of a hundred lists that are larger than the present one, so many take its place, if by no more than this.
const WORSE: usize = 30;
const LARGER: usize = 3;
/// A list may be this much larger than the present one before its end is given up.
const SLACK: usize = 8;
/// Lists that are kept.
const KEPT: usize = 6;

/// What is known from searches among fewer of the rows.
#[derive(Debug, Default)]
pub struct Known {
    /// Cubes that rules were made of.
    pub cubes: Vec<Cube>,
    /// The best list.
    pub list: Option<List>,
}

/// The smallest lists that are found within the account before `patience` attempts find no smaller one, the best last.
pub fn lists(
    columns: &Columns,
    classes: &[Bits],
    reach: u64,
    patience: usize,
    known: &mut Known,
    account: &Account,
) -> Vec<List> {
    let all = Bits::full(columns.rows());
    let table = Table::of(columns, classes, &all, account);
    let mut search = Search {
        table: &table,
        classes,
        sizes: classes.iter().map(Bits::count).collect(),
        reach,
        account,
        random: Random::new(0),
        pool: Pool::default(),
        kept: Vec::new(),
    };
    for cube in &known.cubes {
        search.pool.add(&table, cube, account);
    }
    let list = known.list.take();
    search.run(list.clone(), patience);
    *known = Known {
        cubes: search.pool.cubes(),
        list: search.kept.last().cloned().or(list),
    };
    search.kept
}

struct Search<'a> {
    table: &'a Table,
    classes: &'a [Bits],
    /// The number of rows of each class.
    sizes: Vec<usize>,
    reach: u64,
    account: &'a Account,
    random: Random,
    pool: Pool,
    kept: Vec<List>,
}

impl Search<'_> {
    fn run(&mut self, mut present: Option<List>, patience: usize) {
        let starts = match present {
            Some(_) => 0,
            None => STARTS,
        };
        let (mut stale, mut idle) = (0, 0);
        for attempt in 0.. {
            if self.account.is_spent() || idle > patience {
                return;
            }
            idle += 1;
            stale += 1;
            let worth = self.taste(attempt);
            // A list for fewer rows may be much smaller than any for these.
            let whole = attempt < starts
                || idle % AFRESH == 0
                || self.kept.is_empty() && attempt % SEEKS == 0;
            let (begun, left, limit) = match &present {
                Some(present) if !whole => {
                    let (list, left) = self.beginning(present);
                    let limit = (present.nodes() + SLACK).saturating_sub(list.nodes());
                    (list, left, limit)
                }
                _ => {
                    let all = Bits::full(self.table.columns.rows());
                    (List::default(), all, usize::MAX)
                }
            };
            if let Some(list) = self.ended(begun, &left, &worth, limit, attempt < starts) {
                if self.keep(&list) {
                    idle = 0;
                }
                let now = present.as_ref().map_or(usize::MAX, List::nodes);
                let more = match self.random.below(100) < WORSE {
                    true => 1 + self.random.below(LARGER),
                    false => 0,
                };
                if list.nodes() < now {
                    stale = 0;
                }
                let anew = whole && attempt >= starts;
                if anew || list.nodes() <= now.saturating_add(more) {
                    present = Some(list);
                }
            }
            if stale > STALE {
                stale = 0;
                present = self.kept.last().cloned();
            }
        }
    }

    /// A list with a beginning and a new end for the rows that it leaves.
    fn ended(
        &mut self,
        mut list: List,
        left: &Bits,
        worth: &Worth,
        limit: usize,
        seeks: bool,
    ) -> Option<List> {
        let seeks = seeks || self.random.below(SEEKS) == 0;
        let covering = Covering {
            table: self.table,
            worth,
            limit,
            account: self.account,
        };
        let passing = (!seeks).then_some(&mut self.random);
        let end = covering.list(left, &mut self.pool, passing)?;
        list.rules.extend(end.rules);
        list.last = end.last;
        let columns = &self.table.columns;
        let all = Bits::full(columns.rows());
        tidy(columns, self.classes, &all, &mut list, self.account);
        for rule in &list.rules {
            self.pool.add(self.table, &rule.cube, self.account);
        }
        Some(list)
    }

    /// Keeps a list that is smaller than all before.
    fn keep(&mut self, list: &List) -> bool {
        let least = self.kept.last().map_or(usize::MAX, List::nodes);
        let smaller = list.nodes() < least;
        if smaller {
            self.kept.push(list.clone());
            if self.kept.len() > KEPT {
                self.kept.remove(0);
            }
        }
        smaller
    }

    /// The first tastes are the same for every table, the others are drawn.
    fn taste(&mut self, attempt: usize) -> Worth {
        let classes = self.sizes.len();
        let mut worth = Worth::plain(classes, self.reach);
        let largest = self.sizes.iter().copied().max().unwrap_or(0);
        let mut spared = None;
        match attempt {
            0 => {}
            1 => spared = self.sizes.iter().position(|size| *size == largest),
            2 => worth.squared = true,
            3 => {
                let share = |count: &usize| (WEIGHT as usize * largest / (8 + count)).max(1);
                let shares = self.sizes.iter().map(share);
                worth.weights = shares
                    .map(|share| u32::try_from(share).unwrap_or(u32::MAX))
                    .collect();
            }
            _ => {
                for weight in &mut worth.weights {
                    let drawn = WEIGHTS.get(self.random.below(WEIGHTS.len()));
                    *weight = drawn.copied().unwrap_or(*weight);
                }
                worth.squared = self.random.below(2) == 0;
                spared = (self.random.below(2) == 0).then(|| self.random.below(classes));
            }
        }
        // What is left for the end needs no rules.
        if let Some(weight) = spared.and_then(|at| worth.weights.get_mut(at)) {
            *weight = 0;
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
        let columns = &self.table.columns;
        let mut left = Bits::full(columns.rows());
        let mut kept = List::default();
        for (at, rule) in list.rules.iter().enumerate().take(count) {
            let words = 8 + columns.rows().div_ceil(64) * rule.cube.literals().len();
            self.account.spend(4 * words as u64);
            let met = columns.cube_meets(&rule.cube, &left);
            let own = self.classes.get(rule.class);
            let decided = columns.cube_rows(&rule.cube, &left);
            let pure = own.is_some_and(|own| met.is_subset(own));
            if at != out && pure && !decided.is_empty() {
                left.subtract(&decided);
                kept.rules.push(rule.clone());
            }
        }
        (kept, left)
    }
}
