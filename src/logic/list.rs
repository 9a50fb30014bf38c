//! Decision lists: classes of rows from the left, each with a cover against those that follow.

mod exchange;
mod learned;

use super::account::Account;
use super::bits::Bits;
use super::columns::Columns;
use super::cube::Cover;
use super::minimise::core::Core;
use super::minimise::{Effort, minimise_within};
use rayon::prelude::*;

/// The order of a decision list.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Order {
    /// As makes the result smallest.
    ///
    /// Each time the class whose cover has the fewest literals, then the fewest cubes; neighbours change places where
    /// that saves literals.
    #[default]
    Learned,
    /// As given.
    Given,
    /// Those with the fewest rows first.
    Rarest,
}

/// Covers of the classes from the left. Each contains the rows of its class and meets none of a class to its right, so
/// the first cover that holds gives the class. The last one holds everywhere. Classes without rows are left out.
///
/// The classes are disjoint sets of rows, and no row of one meets a row of another.
pub fn list(
    columns: &Columns,
    classes: &[Bits],
    order: Order,
    effort: &Effort,
) -> Vec<(usize, Cover)> {
    list_within(columns, classes, order, effort, &Account::unlimited()).unwrap_or_default()
}

/// As [`list`]; `None` if the account is spent before there is a list.
pub fn list_within(
    columns: &Columns,
    classes: &[Bits],
    order: Order,
    effort: &Effort,
    account: &Account,
) -> Option<Vec<(usize, Cover)>> {
    let there = classes
        .iter()
        .enumerate()
        .filter(|(_, rows)| !rows.is_empty());
    let mut classes: Vec<Class> = there.map(|(number, rows)| Class { number, rows }).collect();
    let list = match order {
        Order::Learned => learned::list(columns, classes, effort, account)?,
        Order::Given => fixed(columns, &classes, effort, account)?,
        Order::Rarest => {
            classes.sort_by_key(|class| class.rows.count());
            fixed(columns, &classes, effort, account)?
        }
    };
    let entry = |entry: Entry| (entry.class.number, entry.cover);
    Some(list.into_iter().map(entry).collect())
}

/// A class by its number.
#[derive(Clone, Copy, Debug)]
struct Class<'a> {
    number: usize,
    rows: &'a Bits,
}

/// A class with its cover.
#[derive(Clone, Debug)]
struct Entry<'a> {
    class: Class<'a>,
    cover: Cover,
}

impl Entry<'_> {
    fn cost(&self) -> Cost {
        cost(&self.cover)
    }
}

/// What the order is chosen by: literals, then cubes.
type Cost = (usize, usize);

fn cost(cover: &Cover) -> Cost {
    (cover.literals(), cover.cubes().len())
}

/// The list in this order.
fn fixed<'a>(
    columns: &Columns,
    classes: &[Class<'a>],
    effort: &Effort,
    account: &Account,
) -> Option<Vec<Entry<'a>>> {
    let entry = |(i, class): (usize, &Class<'a>)| {
        let part = account.part(classes.len());
        let after = classes.iter().skip(i + 1);
        let off = union(columns, after.map(|class| class.rows));
        let found = minimise_within(columns, class.rows, &off, effort, &part);
        (part, found)
    };
    let found: Vec<_> = classes.par_iter().enumerate().map(entry).collect();
    found.iter().for_each(|(part, _)| account.settle(part));
    let entries = classes.iter().zip(found).map(|(class, (_, found))| {
        Some(Entry {
            class: *class,
            cover: found?.cover,
        })
    });
    entries.collect()
}

fn union<'a>(columns: &Columns, sets: impl Iterator<Item = &'a Bits>) -> Bits {
    sets.fold(Bits::empty(columns.rows()), |mut all, set| {
        all.unite(set);
        all
    })
}

/// The cover of a class against the rows of those that follow; `None` as soon as it seems to cost more than `limit`, or the
/// account is spent.
fn within(
    columns: &Columns,
    class: Class,
    off: &Bits,
    limit: Cost,
    effort: &Effort,
    account: &Account,
) -> Option<Cover> {
    let quick = effort.quick();
    let mut core = Core::new(columns, class.rows, off, &quick);
    loop {
        let holds = core.refine(account)?;
        if cost(&core.solution().cover) > limit {
            return None;
        }
        if holds {
            return core.finish(effort, account).map(|found| found.cover);
        }
    }
}
