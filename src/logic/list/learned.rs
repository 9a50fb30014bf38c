//! The learned order: the cheapest first.

use super::exchange::exchange;
use super::{Class, Entry, cost, union};
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::cube::{Cover, Cube};
use crate::logic::minimise::Effort;
use crate::logic::minimise::core::Core;
use rayon::prelude::*;

/// The list that takes the class with the cheapest cover each time, with neighbours exchanged where that is cheaper.
pub(super) fn list<'a>(
    columns: &Columns,
    mut classes: Vec<Class<'a>>,
    effort: &Effort,
) -> Vec<Entry<'a>> {
    let mut list = Vec::new();
    let mut left = union(columns, classes.iter().map(|class| class.rows));
    while classes.len() > 1 {
        let (at, cover) = cheapest(columns, &classes, &left, effort);
        let class = classes.remove(at);
        left.subtract(class.rows);
        list.push(Entry { class, cover });
    }
    let last = classes.into_iter().map(|class| Entry {
        class,
        cover: Cover::new([Cube::default()]),
    });
    list.extend(last);
    exchange(columns, &mut list, effort);
    list
}

/// The class with the cheapest cover against all others, and this cover.
///
/// A cover of a core costs about as much as a cover of all rows, or less. So the class that seems cheapest is refined
/// until the cover that seems cheapest is right on all rows. The others are never minimised in full.
fn cheapest(columns: &Columns, classes: &[Class], left: &Bits, effort: &Effort) -> (usize, Cover) {
    let quick = effort.quick();
    let offs: Vec<Bits> = classes.par_iter().map(|c| left.minus(c.rows)).collect();
    let cores = classes.par_iter().zip(&offs).map(|(class, off)| {
        let mut core = Core::new(columns, class.rows, off, &quick);
        let holds = core.refine();
        (core, holds)
    });
    let mut cores: Vec<(Core, bool)> = cores.collect();
    loop {
        let looks = |(_, (core, _)): &(usize, &mut (Core, bool))| cost(&core.solution().cover);
        match cores.iter_mut().enumerate().min_by_key(looks) {
            Some((_, (core, holds))) if !*holds => *holds = core.refine(),
            Some((at, (core, _))) => return (at, core.finish(effort).cover),
            None => return (0, Cover::default()),
        }
    }
}
