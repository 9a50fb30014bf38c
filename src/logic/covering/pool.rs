//! Cubes that were met on the way: looking at each is much less work than a search.

use super::table::Table;
use super::{Rule, Worth};
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::cube::Cube;
use crate::logic::random::Random;
use rustc_hash::FxHashSet;

/// The most cubes.
const MOST: usize = 4000;
/// Of a hundred cubes so many are passed over.
const PASSED: usize = 20;
/// The work of a look at one cube.
const LOOK: u64 = 8;

#[derive(Default)]
pub(super) struct Pool {
    cubes: Vec<Pooled>,
    known: FxHashSet<Cube>,
}

struct Pooled {
    cube: Cube,
    rows: Bits,
    /// The rows that it meets, if that are not the same.
    meets: Option<Bits>,
}

impl Pool {
    pub(super) fn add(&mut self, table: &Table, cube: &Cube, account: &Account) {
        if self.cubes.len() >= MOST || !self.known.insert(cube.clone()) {
            return;
        }
        let all = Bits::full(table.columns.rows());
        let words = LOOK + all.bound() as u64 / 64;
        account.spend(words * cube.literals().len() as u64);
        let minterms = table.columns.are_minterms();
        self.cubes.push(Pooled {
            rows: table.columns.cube_rows(cube, &all),
            meets: (!minterms).then(|| table.columns.cube_meets(cube, &all)),
            cube: cube.clone(),
        });
    }

    /// The cubes, in the order in which they were met.
    pub(super) fn cubes(self) -> Vec<Cube> {
        let cubes = self.cubes.into_iter();
        cubes.map(|pooled| pooled.cube).collect()
    }

    /// The rule that is worth most among the rows left, the first of equals. Classes of no weight have none.
    pub(super) fn best(
        &self,
        table: &Table,
        left: &Bits,
        worth: &Worth,
        passing: &mut Option<&mut Random>,
        account: &Account,
    ) -> Option<(u64, Rule)> {
        let words = left.bound() as u64 / 64;
        let mut work = 0;
        let mut best: Option<(u64, usize, &Cube)> = None;
        for pooled in &self.cubes {
            if let Some(random) = passing
                && random.below(100) < PASSED
            {
                continue;
            }
            work += LOOK;
            let Some(first) = pooled.rows.first_of_both(left) else {
                continue;
            };
            let meets = pooled.meets.as_ref().unwrap_or(&pooled.rows);
            for (class, own) in &table.classes {
                if !own.contains(first) || !meets.both_within(left, own) {
                    continue;
                }
                work += words;
                let decided = pooled.rows.count_both(left);
                let worth = worth.of(*class, decided, pooled.cube.literals().len());
                if worth > best.map_or(0, |(most, ..)| most) {
                    best = Some((worth, *class, &pooled.cube));
                }
            }
        }
        account.spend(work);
        best.map(|(worth, class, cube)| {
            let cube = cube.clone();
            (worth, Rule { class, cube })
        })
    }
}
