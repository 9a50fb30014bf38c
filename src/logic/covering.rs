//! Sequential covering: the cheapest rule next, whatever its class (CN2: Clark and Niblett 1989; RIPPER: Cohen 1995).
//!
//! A rule is a cube with a class. It may stand next in a list if every row left that it meets is of its class. Of all such
//! rules that a search finds, the one that decides most rows for its price is taken, until the rows left are of one class.
//! Unlike a list of classes ([`list`](mod@super::list)), such a list may return to a class.

mod grouped;
mod pool;
mod rebuild;
mod regrouped;
mod rule;
mod table;
mod tidy;
mod top_down;

pub use grouped::{Grouped, Part, grouped, picked};
pub use rebuild::{Known, lists};
pub use regrouped::Regroup;
pub use top_down::{Sought, top_down};

use super::account::Account;
use super::bits::Bits;
use super::columns::Columns;
use super::cube::Cube;
use super::random::Random;
use pool::Pool;
use table::Table;

/// A class behind a cube.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rule {
    /// The class.
    pub class: usize,
    /// Where it is taken, if no rule before holds.
    pub cube: Cube,
}

/// Rules from the left, and the class of what they leave.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct List {
    /// The first that holds decides.
    pub rules: Vec<Rule>,
    /// The class where none holds.
    pub last: usize,
}

impl List {
    /// The nodes of the list as a tree: a sequence, a leaf and the literals for each rule, a leaf and a selector.
    pub fn nodes(&self) -> usize {
        let rules = self.rules.iter();
        2 + rules
            .map(|rule| 2 + rule.cube.literals().len())
            .sum::<usize>()
    }
}

/// What makes a rule worth taking next: the rows that it decides, by the weight of its class, for its nodes.
#[derive(Clone, Debug)]
pub struct Worth {
    /// The weight of each class. A class of no weight is left for the end.
    weights: Vec<u32>,
    /// Whether its nodes count twice, so that short rules come first.
    squared: bool,
    /// The words that may be read in the search for one rule of one class.
    reach: u64,
}

/// The usual weight of a class.
const WEIGHT: u32 = 256;

impl Worth {
    /// All classes alike.
    pub fn plain(classes: usize, reach: u64) -> Self {
        Self {
            weights: vec![WEIGHT; classes],
            squared: false,
            reach,
        }
    }

    fn weight(&self, class: usize) -> u32 {
        self.weights.get(class).copied().unwrap_or(WEIGHT)
    }

    fn of(&self, class: usize, decided: usize, literals: usize) -> u64 {
        let price = 2 + literals as u64;
        let decided = decided as u64 * u64::from(self.weight(class)) * (1 << 12);
        match self.squared {
            true => decided / (price * price),
            false => decided / price,
        }
    }
}

/// A list of rules for these classes among the rows `among`; a row may be of several classes, each of which is right.
/// `None` if the account is spent before there is a list, or the list has more than `limit` nodes.
pub fn covering(
    columns: &Columns,
    classes: &[Bits],
    among: &Bits,
    worth: &Worth,
    limit: usize,
    account: &Account,
) -> Option<List> {
    let table = Table::of(columns, classes, among, account);
    let all = Bits::full(table.columns.rows());
    Covering {
        table: &table,
        worth,
        limit,
        account,
    }
    .list(&all, &mut Pool::default(), None)
}

/// What one list is made of.
struct Covering<'a> {
    table: &'a Table,
    worth: &'a Worth,
    /// The most nodes.
    limit: usize,
    account: &'a Account,
}

impl Covering<'_> {
    /// A list for these rows by the best rules of the pool, or better ones, which join it. If `passing` is given, some rules of the pool
    /// are passed over at random, and others are sought only where none of the pool applies.
    fn list(&self, rows: &Bits, pool: &mut Pool, mut passing: Option<&mut Random>) -> Option<List> {
        let mut left = rows.clone();
        // What is left of the rows alone is read faster.
        let mut alone: Option<(Table, Bits)> = None;
        let mut list = List::default();
        loop {
            if let Some(class) = self.table.sole(&left) {
                list.last = class;
                return Some(list);
            }
            if self.account.is_spent() || list.nodes() > self.limit {
                return None;
            }
            let mut rule = pool.best(self.table, &left, self.worth, &mut passing, self.account);
            if rule.is_none() || passing.is_none() {
                let fits = alone
                    .as_ref()
                    .is_some_and(|(table, left)| 2 * left.count() >= table.columns.rows());
                if !fits {
                    let table = self.table.among(&left, self.account);
                    let all = Bits::full(table.columns.rows());
                    alone = Some((table, all));
                }
                let (table, left) = alone.as_ref()?;
                let floor = rule.as_ref().map_or(0, |(worth, _)| *worth);
                rule = table.best(left, self.worth, floor, self.account).or(rule);
            }
            let (_, rule) = rule?;
            pool.add(self.table, &rule.cube, self.account);
            left.subtract(&self.table.columns.cube_rows(&rule.cube, &left));
            if let Some((table, left)) = &mut alone {
                left.subtract(&table.columns.cube_rows(&rule.cube, left));
            }
            list.rules.push(rule);
        }
    }
}
