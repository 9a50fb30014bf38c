//! The rows that decide a problem.
//!
//! Most rows of a large table repeat what others say. A core is a sample of them. A cover of the core is a guess at a cover
//! of all rows, and the rows for which the guess is wrong join the core. A cover of the core that is proved smallest and
//! is right on all rows is proved smallest for all rows.

use super::instance::Instance;
use super::{Effort, Solution, solve};
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::random::{self, Random};

/// The most rows of a problem that is its own core, and the ON and the OFF rows in the first core of a larger one.
const WHOLE: usize = 512;
const FIRST: usize = 128;
/// Rounds after which the core becomes all rows.
const ROUNDS: usize = 24;

/// A problem with its core.
#[derive(Clone, Debug)]
pub(in crate::logic) struct Core<'a> {
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
    pub(in crate::logic) fn new(
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
    pub(in crate::logic) fn solution(&self) -> &Solution {
        &self.solution
    }

    /// A solution for all rows under a greater effort, starting from the present core; `None` if the account is spent.
    pub(in crate::logic) fn finish(
        &self,
        effort: &'a Effort,
        account: &Account,
    ) -> Option<Solution> {
        let mut core = Self {
            effort,
            rounds: 0,
            ..self.clone()
        };
        while !core.refine(account)? {}
        Some(core.solution)
    }

    /// Solves the core and adds rows for which the cover is wrong; true if there are none, `None` if the account is spent.
    pub(in crate::logic) fn refine(&mut self, account: &Account) -> Option<bool> {
        if account.is_spent() {
            return None;
        }
        let rows = |bits: &Bits| bits.iter().collect::<Vec<usize>>();
        let instance = Instance::new(self.columns, &rows(&self.core_on), &rows(&self.core_off));
        // Single bits are gathered.
        account.spend((instance.rows() * self.columns.atoms()) as u64);
        self.solution = solve(&instance, self.effort, account)?;
        self.rounds += 1;
        let cover = &self.solution.cover;
        let words = self.columns.rows().div_ceil(64);
        account.spend((2 * (1 + cover.literals()) * words) as u64);
        let missed = self.on.minus(&self.columns.cover_rows(cover, self.on));
        let met = self.columns.cover_meets(cover, self.off);
        if missed.is_empty() && met.is_empty() {
            return Some(true);
        }
        let size = instance.rows();
        self.core_on.unite(&sample(&missed, size / 2));
        self.core_off.unite(&sample(&met, size / 2));
        let all = self.on.count() + self.off.count();
        if self.rounds >= ROUNDS || 2 * (self.core_on.count() + self.core_off.count()) > all {
            self.core_on = self.on.clone();
            self.core_off = self.off.clone();
        }
        Some(false)
    }
}

fn sample(rows: &Bits, size: usize) -> Bits {
    let picked = random::sample(rows.iter(), rows.count(), size, &mut Random::new(0));
    Bits::collect(rows.bound(), picked)
}
