//! How a node may answer, as an abstract interpretation sees it (Cousot and Cousot, "Abstract interpretation", 1977).
//!
//! The abstract value of a node is an [`Answer`] for success and one for failure. An answer has two components:
//!
//! - `at_once`: when the node gives it without ticking a behaviour. The values lie between never and always and err on the
//!   side of always; how finely they tell conditions apart is up to an [`Approximation`].
//! - `by`: the terminations of behaviours by which the node gives it. The values are sets, ordered by inclusion, below a
//!   greatest one: the history does not show them.
//!
//! The join of two answers takes both components together. A tree has no loops, so values are computed once, from the leaves
//! up, and nothing is iterated.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Guard, Status};
use crate::tree::answers;
use std::collections::BTreeSet;

/// Something for each of the two answers.
#[derive(Clone, Copy, Debug)]
pub(in crate::tree) struct Answers<T> {
    pub(in crate::tree) success: T,
    pub(in crate::tree) failure: T,
}

impl<T> Answers<T> {
    pub(super) fn inverted(self) -> Self {
        Self {
            success: self.failure,
            failure: self.success,
        }
    }

    /// A selector is a sequence with success and failure exchanged, inside and outside; so only sequences are looked at.
    pub(super) fn seen_from(self, kind: Composite) -> Self {
        match answers::goes_on(kind) {
            Status::Failure => self.inverted(),
            _ => self,
        }
    }

    /// Under a decorator that does not count; `either` joins two, and `never` is the least.
    pub(super) fn decorated(
        self,
        kind: Decorator,
        never: T,
        either: impl FnOnce(T, T) -> T,
    ) -> Self {
        let answer = |child| answers::decorated(kind, 0, child).0;
        match (answer(Status::Success), answer(Status::Failure)) {
            (Status::Success, Status::Success) => Self {
                success: either(self.success, self.failure),
                failure: never,
            },
            (Status::Failure, Status::Failure) => Self {
                success: never,
                failure: either(self.success, self.failure),
            },
            (Status::Failure, _) => self.inverted(),
            _ => self,
        }
    }
}

/// Conditions under which a node answers at once: a lattice from never to always.
pub(in crate::tree) trait Approximation {
    type When: Copy + PartialEq;
    const NEVER: Self::When;
    const ALWAYS: Self::When;

    /// When a guard holds and when it does not.
    fn guard(&mut self, guard: &Guard) -> Answers<Self::When>;
    fn both(&mut self, a: Self::When, b: Self::When) -> Self::When;
    fn either(&mut self, a: Self::When, b: Self::When) -> Self::When;
}

/// The coarsest approximation: never, or perhaps. It costs nothing, for proofs of thousands of trees.
pub(in crate::tree) struct May;

impl Approximation for May {
    type When = bool;
    const NEVER: bool = false;
    const ALWAYS: bool = true;

    fn guard(&mut self, guard: &Guard) -> Answers<bool> {
        Answers {
            success: *guard != Guard::Const(false),
            failure: *guard != Guard::Const(true),
        }
    }

    fn both(&mut self, a: bool, b: bool) -> bool {
        a && b
    }

    fn either(&mut self, a: bool, b: bool) -> bool {
        a || b
    }
}

/// The terminations by which a node answers.
#[derive(Clone, Debug)]
pub(super) enum Ends {
    /// One of these, which the history shows.
    By(BTreeSet<(Id<Behavior>, Status)>),
    /// The greatest value: the history does not show them.
    Unknown,
}

impl Ends {
    pub(super) const NONE: Self = Self::By(BTreeSet::new());

    pub(super) fn of(behavior: Id<Behavior>, status: Status) -> Self {
        Self::By(BTreeSet::from([(behavior, status)]))
    }

    fn join(self, other: Self) -> Self {
        match (self, other) {
            (Self::By(mut these), Self::By(others)) => {
                these.extend(others);
                Self::By(these)
            }
            _ => Self::Unknown,
        }
    }
}

/// When and by what a node gives one of the two answers.
#[derive(Clone, Debug)]
pub(super) struct Answer<W> {
    pub(super) at_once: W,
    pub(super) by: Ends,
}

impl<W> Answer<W> {
    /// Given at once or not at all.
    pub(super) fn at_once(at_once: W) -> Self {
        Self {
            at_once,
            by: Ends::NONE,
        }
    }

    /// Given by the termination of a behaviour.
    pub(super) fn by(behavior: Id<Behavior>, status: Status, never: W) -> Self {
        Self {
            at_once: never,
            by: Ends::of(behavior, status),
        }
    }

    pub(super) fn join<A: Approximation<When = W>>(self, other: Self, when: &mut A) -> Self {
        Self {
            at_once: when.either(self.at_once, other.at_once),
            by: self.by.join(other.by),
        }
    }
}

/// The history atom that shows a termination.
pub(super) fn shown((behavior, status): &(Id<Behavior>, Status)) -> Atom {
    match status {
        Status::Failure => Atom::Failed(*behavior),
        _ => Atom::Done(*behavior),
    }
}
