//! Covers and guards for sets of rows, each minimised once, within an effort.

use super::problem::Problem;
use crate::ir::tree::{Composite, Guard};
use crate::logic::{Bits, Cover, Effort, minimise_with};
use crate::tree::guard::{factored, not};
use crate::tree::size::Price;
use rustc_hash::FxHashMap;
use std::cell::{Cell, RefCell};
use std::rc::Rc;

/// The work of minimising a row. The unit of work is one word of a set of rows, read once.
const ROW: u64 = 256;

/// The most rows of a small table. In a larger one covers are not improved once they are right, the search has only the
/// rules of the list that it starts from, and Algorithm 1 is not run as well.
pub(super) const LARGE: usize = 4096;

/// A guard with its price under a sequence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Priced {
    pub(super) guard: Guard,
    pub(super) price: Price,
}

impl Priced {
    pub(super) fn new(guard: Guard) -> Self {
        Self {
            price: Price::of_guard(&guard, Composite::Sequence),
            guard,
        }
    }
}

/// A minimiser that remembers what it found and counts its work.
pub(super) struct Minimiser<'a> {
    pub(super) problem: &'a Problem<'a>,
    known: RefCell<FxHashMap<(Bits, Bits), Rc<Cover>>>,
    priced: RefCell<FxHashMap<(Bits, Bits), Rc<Priced>>>,
    work: Cell<u64>,
    limit: u64,
}

impl<'a> Minimiser<'a> {
    /// A minimiser that may do `limit` work.
    pub(super) fn new(problem: &'a Problem<'a>, limit: u64) -> Self {
        Self {
            problem,
            known: RefCell::default(),
            priced: RefCell::default(),
            work: Cell::new(0),
            limit,
        }
    }

    /// The words of one set of rows.
    pub(super) fn words(&self) -> u64 {
        1 + self.problem.columns().rows() as u64 / 64
    }

    /// Counts work.
    pub(super) fn spend(&self, work: u64) {
        self.work.set(self.work.get().saturating_add(work));
    }

    /// Whether the search may minimise `on` against `off`.
    pub(super) fn may_minimise(&self, on: &Bits, off: &Bits) -> bool {
        self.problem.policy.rows.len() <= LARGE && self.affords(self.price(on, off))
    }

    /// Whether this much more work is within the limit.
    pub(super) fn affords(&self, work: u64) -> bool {
        self.work.get().saturating_add(work) <= self.limit
    }

    /// The work of minimising `on` against `off`; none if the cover is known.
    fn price(&self, on: &Bits, off: &Bits) -> u64 {
        match self.known.borrow().contains_key(&(on.clone(), off.clone())) {
            true => 0,
            false => ROW * (on.count() + off.count()) as u64,
        }
    }

    /// A smallest cover of `on` against `off`.
    pub(super) fn cover(&self, on: &Bits, off: &Bits) -> Rc<Cover> {
        let key = (on.clone(), off.clone());
        if let Some(cover) = self.known.borrow().get(&key) {
            return cover.clone();
        }
        self.spend(ROW * (on.count() + off.count()) as u64);
        let columns = self.problem.columns();
        let effort = match columns.rows() > LARGE {
            true => Effort {
                rounds: 0,
                ..Effort::default()
            },
            false => Effort::default(),
        };
        let cover = Rc::new(minimise_with(columns, on, off, &effort).cover);
        self.known.borrow_mut().insert(key, cover.clone());
        cover
    }

    /// A small guard: the factored cover of `on`, or the negation of that of `off`, whichever is smaller.
    pub(super) fn guard(&self, on: &Bits, off: &Bits) -> Rc<Priced> {
        let key = (on.clone(), off.clone());
        if let Some(priced) = self.priced.borrow().get(&key) {
            return priced.clone();
        }
        let atoms = &self.problem.policy.atoms;
        let cover = self.cover(on, off);
        let mut best = Priced::new(factored(&cover, atoms));
        if cover.cubes().len() > 1 && self.may_minimise(off, on) {
            let other = Priced::new(not(factored(&self.cover(off, on), atoms)));
            if other.price < best.price {
                best = other;
            }
        }
        let best = Rc::new(best);
        self.priced.borrow_mut().insert(key, best.clone());
        best
    }
}
