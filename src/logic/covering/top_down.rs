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
/// The most atoms by which leaves are counted.
const ASKED: usize = 192;
/// Cubes that are looked at in the larger sample.
const LOOKED_AT: usize = 6;
/// A sample with more leaves than one for so many rows has no structure that this finds.
const RARE: usize = 4;
/// What a leaf costs in literals: a sequence, a behaviour, and a literal at least.
const LEAF: usize = 3;
/// The seed of the first sample.
const FIRST: u64 = 2;
/// One part in so many of the rows says how long a list will be, and with so many times more nodes than are wanted it is sought in
/// vain. So it is where half of the work has not come so far.
const SHOWN: usize = 8;
const FAR: usize = 8;
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

/// A list with groups that decides every row rightly; `None` where the table has too little structure for it, the account is spent, or
/// it is on the way to far more than `most` nodes. Rows are minterms. Another number, another sample.
pub fn top_down(
    columns: &Columns,
    classes: &[Bits],
    (number, sought): (u64, Sought),
    most: usize,
    account: &Account,
) -> Option<Grouped> {
    let all = Bits::full(columns.rows());
    let mut search = Search {
        columns,
        classes,
        account,
        random: Random::new(FIRST + number),
        most,
        half: account.spent() + account.left() / 2,
        nodes: 0,
        decided: 0,
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
    /// The nodes that are wanted at most.
    most: usize,
    /// What is spent of the account when half of the work is done.
    half: u64,
    /// The nodes of what stands, and the rows that it decides.
    nodes: usize,
    decided: usize,
}

impl Search<'_> {
    /// A list for these rows.
    fn list(&mut self, rows: &Bits, depth: usize) -> Option<Grouped> {
        let mut left = rows.clone();
        let mut parts = Vec::new();
        loop {
            let sole = |own: &Bits| left.is_subset(own);
            if let Some(last) = self.classes.iter().position(sole) {
                self.nodes += 1;
                self.decided += left.count();
                return Some(Grouped { parts, last });
            }
            if depth == 0 || self.account.is_spent() || self.is_vain() {
                return None;
            }
            let cube = self.next(&left)?;
            let inside = self.columns.cube_rows(&cube, &left);
            left.subtract(&inside);
            self.nodes += 1 + cube.literals().len();
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

    /// Whether the list will be far too long if what it leaves takes as many nodes a row as what it has, or takes far too much work.
    fn is_vain(&self) -> bool {
        let rows = self.columns.rows();
        match SHOWN * self.decided >= rows {
            true => self.nodes.saturating_mul(rows) / self.decided.max(1) / FAR > self.most,
            false => self.account.spent() > self.half,
        }
    }

    /// The cube that stands next among these rows: the best of those that look good on a small sample.
    fn next(&mut self, left: &Bits) -> Option<Cube> {
        let table = self.sample(left, SAMPLE);
        let mut cubes = cubes(&table, self.account);
        if table.columns.rows() > 2 * GLANCE {
            let small = self.sample(left, GLANCE);
            let few = small.clone().dividing(ASKED);
            let costs = cubes.into_iter().filter_map(|cube| {
                let cost = self.cost(&small, &few, &cube, usize::MAX)?;
                Some((cost, cube))
            });
            let mut costs: Vec<([usize; 2], Cube)> = costs.collect();
            costs.sort_by_key(|(cost, _)| *cost);
            costs.truncate(LOOKED_AT);
            cubes = costs.into_iter().map(|(_, cube)| cube).collect();
        }
        let few = table.clone().dividing(ASKED);
        let mut best: Option<([usize; 2], Cube)> = None;
        for cube in cubes {
            let least = best.as_ref().map_or([usize::MAX; 2], |(cost, _)| *cost);
            let [most, _] = least;
            let cost = self.cost(&table, &few, &cube, most);
            if let Some(cost) = cost.filter(|cost| *cost < least) {
                best = Some((cost, cube));
            }
        }
        best.map(|(_, cube)| cube)
    }

    /// What it costs to tell rows apart inside and outside of a cube by few of their atoms, and of that, the leaves inside; `None` for
    /// more than `most`, and for a cube that divides nothing.
    fn cost(&self, table: &Table, few: &Table, cube: &Cube, most: usize) -> Option<[usize; 2]> {
        let all = Bits::full(table.columns.rows());
        let inside = table.columns.cube_rows(cube, &all);
        let outside = all.minus(&inside);
        if inside.is_empty() || outside.is_empty() {
            return None;
        }
        let literals = cube.literals().len();
        let most = most.saturating_sub(literals) / LEAF;
        let inner = leaves(few, &inside, most, self.account)?;
        let outer = leaves(few, &outside, most - inner, self.account)?;
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
