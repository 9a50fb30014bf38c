//! Where a tree waits for the next tick.
//!
//! When a child of a memory sequence has succeeded, btc begins the next one in the next tick, if the child has ticked a
//! behaviour in this one; a child that has only asked is passed at once. The libraries of robots begin the next child at
//! once in any case, so exported trees wait by nodes of their own.

use crate::ir::tree::{Composite, Decorator, Status};
use crate::tree::drawing::{Drawing, Shape};

/// Whether exported trees take each step in the tick in which btc takes it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Steps {
    /// They do.
    #[default]
    Exact,
    /// The next child of a memory node begins in the tick in which the one before ends: a shorter tree.
    SameTick,
}

/// Whether a node that ends with some answer has ticked a behaviour in that tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Drives {
    Never,
    Sometimes,
    Always,
}

/// Whether a child on whose answer a composite goes on has ticked a behaviour in the tick of that answer.
pub(super) fn drives(child: &Drawing, kind: Composite) -> Drives {
    let ways = Ways::of(child, goes_on(kind));
    match (ways.with, ways.without) {
        (false, _) => Drives::Never,
        (true, true) => Drives::Sometimes,
        (true, false) => Drives::Always,
    }
}

/// The answer of a child on which a composite goes on to the next one.
fn goes_on(kind: Composite) -> Status {
    match kind {
        Composite::Selector => Status::Failure,
        Composite::Sequence => Status::Success,
    }
}

/// How a node comes to an answer: in a tick with a behaviour, or in one without.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Ways {
    with: bool,
    without: bool,
}

const IMPOSSIBLE: Ways = Ways {
    with: false,
    without: false,
};
const WITH: Ways = Ways {
    with: true,
    without: false,
};
const WITHOUT: Ways = Ways {
    with: false,
    without: true,
};

impl Ways {
    fn or(self, other: Self) -> Self {
        Self {
            with: self.with || other.with,
            without: self.without || other.without,
        }
    }

    /// One after the other in the same tick.
    fn then(self, other: Self) -> Self {
        let possible = |ways: Self| ways.with || ways.without;
        Self {
            with: self.with && possible(other) || possible(self) && other.with,
            without: self.without && other.without,
        }
    }

    /// How a node comes to success or failure.
    fn of(node: &Drawing, answer: Status) -> Self {
        let child = |answer| {
            let child = node.children.first();
            child.map_or(IMPOSSIBLE, |child| Self::of(child, answer))
        };
        let success = answer == Status::Success;
        match node.shape {
            Shape::Literal(..) => WITHOUT,
            Shape::Const(value) => match value == success {
                true => WITHOUT,
                false => IMPOSSIBLE,
            },
            Shape::Behavior(_) => WITH,
            Shape::Composite(kind, memory) => Self::of_composite(node, (kind, memory), answer),
            Shape::Parallel(_) => {
                let each = node.children.iter().map(|child| {
                    Self::of(child, Status::Success).or(Self::of(child, Status::Failure))
                });
                each.fold(WITHOUT, Self::then)
            }
            Shape::Decorator(kind) => match (kind, success) {
                (Decorator::Invert, true) => child(Status::Failure),
                (Decorator::Invert, false) => child(Status::Success),
                (Decorator::Succeed, true) | (Decorator::Fail, false) => {
                    child(Status::Success).or(child(Status::Failure))
                }
                (Decorator::Succeed, false) | (Decorator::Fail, true) => IMPOSSIBLE,
                (Decorator::Timeout(_), false) => child(answer).or(WITHOUT),
                (Decorator::Retry(_) | Decorator::Repeat(_) | Decorator::Timeout(_), _) => {
                    child(answer)
                }
            },
        }
    }

    fn of_composite(node: &Drawing, (kind, memory): (Composite, bool), answer: Status) -> Self {
        let onward = goes_on(kind);
        // With memory, a tick that has driven a child to its end goes no further.
        let (mut before, mut ways) = (WITHOUT, IMPOSSIBLE);
        for child in &node.children {
            if answer != onward {
                ways = ways.or(before.then(Self::of(child, answer)));
            }
            before = match memory {
                false => before.then(Self::of(child, onward)),
                true => WITHOUT,
            };
        }
        match (answer == onward, memory, node.children.last()) {
            (false, ..) | (_, _, None) => ways,
            (true, false, _) => before,
            (true, true, Some(last)) => Self::of(last, onward),
        }
    }
}
