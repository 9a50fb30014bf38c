//! The rows that decide a problem.
//!
//! Most rows of a large table say what others have said. A core is a few of them: what covers it is a guess at a cover
//! of all, and the rows for which the guess is wrong join the core. A cover of the core that is proved smallest and
//! holds on all rows is proved smallest for all rows.

use super::bits::Bits;
use super::columns::Columns;
use super::instance::Instance;
use super::minimise::{Effort, Solution};
use super::whole;

/// Rows up to which a problem is its own core, and rows of ON and of OFF in the first core of a larger one.
const WHOLE: usize = 2_048;
const FIRST: usize = 512;
/// Rounds after which the core is all rows.
const ROUNDS: usize = 24;

/// A problem with its core.
#[derive(Clone, Debug)]
pub(super) struct Core<'a> {
    columns: &'a Columns,
    effort: &'a Effort,
    on: &'a Bits,
    off: &'a Bits,
    core_on: Bits,
    core_off: Bits,
    rounds: usize,
    solution: Solution,
}

impl<'a> Core<'a> {
    /// A problem with its first core, not yet solved.
    pub(super) fn new(
        columns: &'a Columns,
        on: &'a Bits,
        off: &'a Bits,
        effort: &'a Effort,
    ) -> Self {
        let small = on.count() + off.count() <= WHOLE;
        let first = |rows: &Bits| match small {
            true => rows.clone(),
            false => sample(rows, FIRST),
        };
        Self {
            columns,
            effort,
            core_on: first(on),
            core_off: first(off),
            on,
            off,
            rounds: 0,
            solution: Solution::default(),
        }
    }

    /// The cover of the core.
    pub(super) fn solution(&self) -> &Solution {
        &self.solution
    }

    /// Solves the core, and has the rows for which the cover is wrong join it. Whether there are none.
    pub(super) fn refine(&mut self) -> bool {
        let rows = |bits: &Bits| bits.iter().collect::<Vec<usize>>();
        let instance = Instance::new(self.columns, &rows(&self.core_on), &rows(&self.core_off));
        self.solution = whole::solve(&instance, self.effort);
        self.rounds += 1;
        let cover = &self.solution.cover;
        let missed = self.on.minus(&self.columns.cover_rows(cover, self.on));
        let met = self.columns.cover_meets(cover, self.off);
        if missed.is_empty() && met.is_empty() {
            return true;
        }
        let size = instance.rows();
        self.core_on.unite(&sample(&missed, size / 2));
        self.core_off.unite(&sample(&met, size / 2));
        let all = self.on.count() + self.off.count();
        if self.rounds >= ROUNDS || 2 * (self.core_on.count() + self.core_off.count()) > all {
            self.core_on = self.on.clone();
            self.core_off = self.off.clone();
        }
        false
    }
}

/// So many of the rows, spread evenly, or all where there are no more. Within its stretch a row is taken by a hash, so
/// that no period of the table shows.
fn sample(rows: &Bits, size: usize) -> Bits {
    let count = rows.count();
    if count <= size {
        return rows.clone();
    }
    let mut wanted = (0..size).map(|i| {
        let (from, to) = (i * count / size, (i + 1) * count / size);
        from + (hash(i as u64) % (to - from) as u64) as usize
    });
    let mut next = wanted.next();
    let picked = rows.iter().enumerate().filter(|(at, _)| {
        let hit = Some(*at) == next;
        if hit {
            next = wanted.next();
        }
        hit
    });
    Bits::collect(rows.bound(), picked.map(|(_, row)| row))
}

/// A number that looks random (the finaliser of splitmix64: Steele, Lea and Flood 2014).
fn hash(number: u64) -> u64 {
    let mut z = number.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
