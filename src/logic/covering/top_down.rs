//! A list with groups, from the top: next stands the cube that leaves both sides of it easiest to tell apart.
//!
//! How hard rows are to tell apart is counted: the leaves of a decision tree for a sample of them. Where a group is taken out in the right
//! order, its rows need few leaves and so do the others; in the wrong order, exceptions are needed on both sides. Cubes are tried
//! whose literals say together what none of them says alone.

mod cubes;
mod leaves;

use super::Rule;
use super::grouped::{Grouped, Part};
use super::table::Table;
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::cube::Cube;
use crate::logic::random::{Random, sample};
use cubes::cubes;
use leaves::leaves;

/// The rows of a sample, of one at which all cubes are looked, and the fewest of each class, where it has so many.
const SAMPLE: usize = 1024;
const GLANCE: usize = 320;
const FEWEST: usize = 8;
/// Cubes that are looked at in the larger sample.
const LOOKED_AT: usize = 6;
/// A sample with more leaves than one for so many rows has no structure that this finds.
const RARE: usize = 4;
/// What a leaf costs in literals: a sequence, a behaviour, and a literal at least.
const LEAF: usize = 3;
/// The seed of the first sample.
const FIRST: u64 = 2;
/// Groups within groups.
const DEPTH: usize = 16;

/// By how much classes are told apart by fewer leaves than if they fell by chance, where there is structure.
const BY_CHANCE: f64 = 0.85;

/// Which tables a list is sought for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sought {
    /// Those of which a decision tree has few leaves.
    Plain,
    /// Those of which it has fewer than if the classes fell by chance, too: long lists ask much of a tree.
    Any,
}

/// A list with groups that decides every row rightly; `None` where the table has too little structure for it, or the account is spent.
/// Rows are minterms. Another number, another sample.
pub fn top_down(
    columns: &Columns,
    classes: &[Bits],
    (number, sought): (u64, Sought),
    account: &Account,
) -> Option<Grouped> {
    let all = Bits::full(columns.rows());
    let mut search = Search {
        columns,
        classes,
        account,
        random: Random::new(FIRST + number),
    };
    let table = search.sample(&all, SAMPLE);
    let rows = table.columns.rows();
    let whole = Bits::full(rows);
    if leaves(&table, &whole, rows / RARE, account).is_none() {
        // No tree has fewer leaves than there are classes.
        let classes = table.classes.len() as f64;
        let may_be = sought == Sought::Any && classes <= BY_CHANCE * rows as f64;
        let shuffled = may_be.then(|| table.shuffled(&mut search.random))?;
        let own = leaves(&table, &whole, rows, account)? as f64;
        let by_chance = leaves(&shuffled, &whole, rows, account)? as f64;
        if own > BY_CHANCE * by_chance {
            return None;
        }
    }
    search.list(&all, DEPTH)
}

struct Search<'a> {
    columns: &'a Columns,
    classes: &'a [Bits],
    account: &'a Account,
    random: Random,
}

impl Search<'_> {
    /// A list for these rows.
    fn list(&mut self, rows: &Bits, depth: usize) -> Option<Grouped> {
        let mut left = rows.clone();
        let mut parts = Vec::new();
        loop {
            let sole = |own: &Bits| left.is_subset(own);
            if let Some(last) = self.classes.iter().position(sole) {
                return Some(Grouped { parts, last });
            }
            if depth == 0 || self.account.is_spent() {
                return None;
            }
            let cube = self.next(&left)?;
            let inside = self.columns.cube_rows(&cube, &left);
            left.subtract(&inside);
            let inner = self.list(&inside, depth - 1)?;
            parts.push(match inner.parts.is_empty() {
                true => Part::Rule(Rule {
                    class: inner.last,
                    cube,
                }),
                false => Part::Group(cube, inner),
            });
        }
    }

    /// The cube that stands next among these rows: the best of those that look good on a small sample.
    fn next(&mut self, left: &Bits) -> Option<Cube> {
        let table = self.sample(left, SAMPLE);
        let mut cubes = cubes(&table, self.account);
        if table.columns.rows() > 2 * GLANCE {
            let small = self.sample(left, GLANCE);
            let costs = cubes.into_iter().filter_map(|cube| {
                let cost = self.cost(&small, &cube, usize::MAX)?;
                Some((cost, cube))
            });
            let mut costs: Vec<([usize; 2], Cube)> = costs.collect();
            costs.sort_by_key(|(cost, _)| *cost);
            costs.truncate(LOOKED_AT);
            cubes = costs.into_iter().map(|(_, cube)| cube).collect();
        }
        let mut best: Option<([usize; 2], Cube)> = None;
        for cube in cubes {
            let least = best.as_ref().map_or([usize::MAX; 2], |(cost, _)| *cost);
            let [most, _] = least;
            let cost = self.cost(&table, &cube, most);
            if let Some(cost) = cost.filter(|cost| *cost < least) {
                best = Some((cost, cube));
            }
        }
        best.map(|(_, cube)| cube)
    }

    /// What it costs to tell rows apart inside and outside of a cube, and of that, the leaves inside; `None` for more than `most`, and
    /// for a cube that divides nothing.
    fn cost(&self, table: &Table, cube: &Cube, most: usize) -> Option<[usize; 2]> {
        let all = Bits::full(table.columns.rows());
        let inside = table.columns.cube_rows(cube, &all);
        let outside = all.minus(&inside);
        if inside.is_empty() || outside.is_empty() {
            return None;
        }
        let literals = cube.literals().len();
        let most = most.saturating_sub(literals) / LEAF;
        let inner = leaves(table, &inside, most, self.account)?;
        let outer = leaves(table, &outside, most - inner, self.account)?;
        Some([LEAF * (inner + outer) + literals, inner])
    }

    /// Some of these rows, of every class that has any.
    fn sample(&mut self, rows: &Bits, size: usize) -> Table {
        // A row of several classes counts for each.
        let count: usize = self.classes.iter().map(|own| own.count_both(rows)).sum();
        let mut chosen = Bits::empty(rows.bound());
        for own in self.classes {
            let own = own.and(rows);
            let its = own.count();
            let wanted = (size * its).div_ceil(count.max(1)).max(FEWEST);
            for row in sample(own.iter(), its, wanted, &mut self.random) {
                chosen.insert(row);
            }
        }
        Table::of(self.columns, self.classes, &chosen, self.account)
    }
}
