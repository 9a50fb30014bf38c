//! Covers and guards for sets of rows, each minimised once, within an effort.

use super::problem::{OPERATION, Problem};
use crate::ir::tree::{Composite, Guard, Node};
use crate::logic::{Account, Bits, Cover, Effort, minimise_within};
use crate::tree::Size;
use crate::tree::guard::{factored, not};
use crate::tree::size::Price;
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::rc::Rc;

/// About the work of minimising a row.
const ROW: u64 = 256;

/// One cover may take this part of what is left.
const COVERS: usize = 8;

/// The most rows of a table whose covers are improved thoroughly.
const SMALL: usize = 256;

/// The most rows of a small table. In a larger one covers are not improved once they are right, and Algorithm 1 is not
/// run as well.
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

/// A minimiser that remembers what it found and draws on an account.
pub(super) struct Minimiser<'a> {
    pub(super) problem: &'a Problem<'a>,
    pub(super) account: Account,
    known: RefCell<FxHashMap<(Bits, Bits), Rc<Cover>>>,
    priced: RefCell<FxHashMap<(Bits, Bits), Rc<Priced>>>,
}

impl<'a> Minimiser<'a> {
    pub(super) fn new(problem: &'a Problem<'a>, account: Account) -> Self {
        Self {
            problem,
            account,
            known: RefCell::default(),
            priced: RefCell::default(),
        }
    }

    /// The work of one operation on sets of rows.
    pub(super) fn words(&self) -> u64 {
        self.problem.words()
    }

    /// How covers are sought: the larger the table, the less they are improved once they are right.
    pub(super) fn effort(&self) -> Effort {
        let usual = Effort::default();
        let rounds = match self.problem.policy.rows.len() {
            0..=SMALL => usual.rounds,
            rows if rows <= LARGE => 1,
            _ => 0,
        };
        Effort { rounds, ..usual }
    }

    /// Whether a search that can do without the cover may minimise `on` against `off`.
    pub(super) fn may_minimise(&self, on: &Bits, off: &Bits) -> bool {
        if self.known.borrow().contains_key(&(on.clone(), off.clone())) {
            return true;
        }
        let rows = (on.count() + off.count()) as u64;
        self.problem.policy.rows.len() <= LARGE && self.account.affords(ROW * rows)
    }

    /// A small cover of `on` against `off`; `None` if the account is spent.
    pub(super) fn cover(&self, on: &Bits, off: &Bits) -> Option<Rc<Cover>> {
        let key = (on.clone(), off.clone());
        if let Some(cover) = self.known.borrow().get(&key) {
            return Some(cover.clone());
        }
        let columns = self.problem.columns();
        // No cover alone takes all that is left.
        let part = self.account.part(COVERS);
        let found = minimise_within(columns, on, off, &self.effort(), &part);
        self.account.settle(&part);
        let cover = Rc::new(found?.cover);
        self.known.borrow_mut().insert(key, cover.clone());
        Some(cover)
    }

    /// A small guard: the factored cover of `on`, or the negation of that of `off`, whichever is smaller; `None` if the
    /// account is spent.
    pub(super) fn guard(&self, on: &Bits, off: &Bits) -> Option<Rc<Priced>> {
        let key = (on.clone(), off.clone());
        if let Some(priced) = self.priced.borrow().get(&key) {
            return Some(priced.clone());
        }
        let atoms = &self.problem.policy.atoms;
        let cover = self.cover(on, off)?;
        let mut best = self.factored(&cover);
        if cover.cubes().len() > 1
            && self.may_minimise(off, on)
            && let Some(other) = self.cover(off, on)
        {
            let other = Priced::new(not(factored(&other, atoms)));
            if other.price < best.price {
                best = other;
            }
        }
        let best = Rc::new(best);
        self.priced.borrow_mut().insert(key, best.clone());
        Some(best)
    }

    /// Whether the tree is proved to take the policy's decisions.
    pub(super) fn proves(&self, root: &Node) -> bool {
        let problem = self.problem;
        let steps = match root.remembers() {
            true => problem.policy.transitions.len() + problem.policy.starts.len(),
            false => 0,
        };
        let nodes = Size::of(root).nodes as u64;
        self.account
            .spend(nodes * (self.words() + steps as u64 * OPERATION));
        problem.proves(root)
    }

    /// A cover as a guard.
    pub(super) fn factored(&self, cover: &Cover) -> Priced {
        let cubes = cover.cubes().len() as u64;
        self.account.spend(cubes * cubes * 8 * OPERATION);
        Priced::new(factored(cover, &self.problem.policy.atoms))
    }
}
