//! Decision lists: classes of rows one after the other, each told from those after it.

use super::bits::Bits;
use super::columns::Columns;
use super::core::Core;
use super::cube::{Cover, Cube};
use super::minimise::{Effort, minimise_with};
use rayon::prelude::*;

/// The order of a decision list.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// Each time the class whose cover has the fewest literals, then the fewest cubes.
    #[default]
    Learned,
    /// As the classes are given.
    Given,
    /// The class with the fewest rows first.
    Rarest,
}

/// Covers of the classes from the left: each contains the rows of its class and meets none of a class to its right, so
/// that the first cover that holds tells the class. The last one holds everywhere. Classes without rows are left out.
///
/// The classes are disjoint sets of rows, and no row of one meets a row of another.
pub fn list(
    columns: &Columns,
    classes: &[Bits],
    order: Order,
    effort: &Effort,
) -> Vec<(usize, Cover)> {
    let mut classes: Vec<Class> = classes
        .iter()
        .enumerate()
        .filter(|(_, rows)| !rows.is_empty())
        .map(|(number, rows)| Class { number, rows })
        .collect();
    match order {
        Order::Learned => learned(columns, classes, effort),
        Order::Given => fixed(columns, &classes, effort),
        Order::Rarest => {
            classes.sort_by_key(|class| class.rows.count());
            fixed(columns, &classes, effort)
        }
    }
}

#[derive(Clone, Copy)]
struct Class<'a> {
    number: usize,
    rows: &'a Bits,
}

/// The list in this order.
fn fixed(columns: &Columns, classes: &[Class], effort: &Effort) -> Vec<(usize, Cover)> {
    let cover = |(i, class): (usize, &Class)| {
        let after = classes.iter().skip(i + 1);
        let off = union(columns, after.map(|class| class.rows));
        let solution = minimise_with(columns, class.rows, &off, effort);
        (class.number, solution.cover)
    };
    classes.par_iter().enumerate().map(cover).collect()
}

fn union<'a>(columns: &Columns, sets: impl Iterator<Item = &'a Bits>) -> Bits {
    sets.fold(Bits::empty(columns.rows()), |mut all, set| {
        all.unite(set);
        all
    })
}

/// The list that takes the class with the cheapest cover each time.
///
/// A cover of a core costs about what a cover of all rows costs, or less. So the class that looks cheapest is refined
/// until one that holds on all of its rows looks cheapest: the others are never minimised in full.
fn learned<'a>(
    columns: &'a Columns,
    mut classes: Vec<Class<'a>>,
    effort: &'a Effort,
) -> Vec<(usize, Cover)> {
    let mut list = Vec::new();
    let mut left = union(columns, classes.iter().map(|class| class.rows));
    while classes.len() > 1 {
        let offs: Vec<Bits> = classes.par_iter().map(|c| left.minus(c.rows)).collect();
        let cores = classes.par_iter().zip(&offs);
        let mut cores: Vec<(Core, bool)> = cores
            .map(|(class, off)| {
                let mut core = Core::new(columns, class.rows, off, effort);
                let done = core.refine();
                (core, done)
            })
            .collect();
        let chosen = loop {
            let cost = |(core, _): &(Core, bool)| {
                let cover = &core.solution().cover;
                (cover.literals(), cover.cubes().len())
            };
            let cheapest = (0..).zip(&mut cores).min_by_key(|(_, core)| cost(core));
            match cheapest {
                Some((_, (core, done))) if !*done => *done = core.refine(),
                Some((i, (core, _))) => break Some((i, core.solution().cover.clone())),
                None => break None,
            }
        };
        let Some((at, cover)) = chosen else { break };
        let class = classes.remove(at);
        left.subtract(class.rows);
        list.push((class.number, cover));
    }
    let last = classes.first().map(|class| class.number);
    list.extend(last.map(|number| (number, Cover::new([Cube::default()]))));
    list
}
