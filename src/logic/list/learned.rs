//! The learned order: the cheapest first.

use super::exchange::exchange;
use super::{Class, Entry, cost, union};
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::cube::{Cover, Cube};
use crate::logic::minimise::Effort;
use crate::logic::minimise::core::Core;
use rayon::prelude::*;

/// The list that takes the class with the cheapest cover each time, with neighbours exchanged where that is cheaper; `None`
/// if the account is spent before there is a list.
pub(super) fn list<'a>(
    columns: &Columns,
    mut classes: Vec<Class<'a>>,
    effort: &Effort,
    account: &Account,
) -> Option<Vec<Entry<'a>>> {
    let mut list = Vec::new();
    let mut left = union(columns, classes.iter().map(|class| class.rows));
    while classes.len() > 1 {
        let (at, cover) = cheapest(columns, &classes, &left, effort, account)?;
        let class = classes.remove(at);
        left.subtract(class.rows);
        list.push(Entry { class, cover });
    }
    let last = classes.into_iter().map(|class| Entry {
        class,
        cover: Cover::new([Cube::default()]),
    });
    list.extend(last);
    exchange(columns, &mut list, effort, account);
    Some(list)
}

/// The class with the cheapest cover against all others, and this cover.
///
/// A cover of a core costs about as much as a cover of all rows, or less. So the class that seems cheapest is refined
/// until the cover that seems cheapest is right on all rows. The others are never minimised in full.
fn cheapest(
    columns: &Columns,
    classes: &[Class],
    left: &Bits,
    effort: &Effort,
    account: &Account,
) -> Option<(usize, Cover)> {
    let quick = effort.quick();
    let offs: Vec<Bits> = classes.par_iter().map(|c| left.minus(c.rows)).collect();
    let cores = classes.par_iter().zip(&offs).map(|(class, off)| {
        let mut core = Core::new(columns, class.rows, off, &quick);
        let part = account.part(classes.len());
        let holds = core.refine(&part);
        (core, holds, part)
    });
    let cores: Vec<(Core, Option<bool>, Account)> = cores.collect();
    cores.iter().for_each(|(.., part)| account.settle(part));
    let cores = cores.into_iter();
    let cores: Option<Vec<(Core, bool)>> =
        cores.map(|(core, holds, _)| Some((core, holds?))).collect();
    let mut cores = cores?;
    loop {
        let looks = |(_, (core, _)): &(usize, &mut (Core, bool))| cost(&core.solution().cover);
        match cores.iter_mut().enumerate().min_by_key(looks) {
            Some((_, (core, holds))) if !*holds => *holds = core.refine(account)?,
            Some((at, (core, _))) => return Some((at, core.finish(effort, account)?.cover)),
            None => return None,
        }
    }
}
