//! What conditions, composites, parallels and decorators answer, as functions of what stands below them.
//!
//! The engine that ticks, the circuits of [equivalence](super::equivalence) and the [reading](super::reading) of memory from
//! the history all go by these.

use crate::ir::tree::{Composite, Decorator, Status};

/// The answer of a condition.
#[inline]
pub(super) fn condition(holds: bool) -> Status {
    match holds {
        true => Status::Success,
        false => Status::Failure,
    }
}

/// The answer of a child on which a composite goes on to the next one.
#[inline]
pub(super) fn goes_on(kind: Composite) -> Status {
    match kind {
        Composite::Selector => Status::Failure,
        Composite::Sequence => Status::Success,
    }
}

/// The answer of a parallel that needs `needed` successes, once `succeeded` of its `children` have succeeded and `failed`
/// have failed.
#[inline]
pub(super) fn parallel(needed: u32, children: u32, succeeded: u32, failed: u32) -> Status {
    if succeeded >= needed {
        Status::Success
    } else if children.saturating_sub(failed) < needed {
        Status::Failure
    } else {
        Status::Running
    }
}

/// Whether a decorator that has counted this far fails without ticking its child.
#[inline]
pub(super) fn is_over(kind: Decorator, count: u64) -> bool {
    matches!(kind, Decorator::Timeout(ticks) if count >= ticks)
}

/// The answer of a decorator that has counted this far to an answer of its child, and the count that it keeps; 0 starts
/// over.
#[inline]
pub(super) fn decorated(kind: Decorator, count: u64, child: Status) -> (Status, u64) {
    match (kind, child) {
        (Decorator::Invert | Decorator::Fail, Status::Success) => (Status::Failure, 0),
        (Decorator::Invert | Decorator::Succeed, Status::Failure) => (Status::Success, 0),
        (Decorator::Retry(times), Status::Failure)
        | (Decorator::Repeat(times), Status::Success)
            if count + 1 < u64::from(times) =>
        {
            (Status::Running, count + 1)
        }
        (Decorator::Retry(_) | Decorator::Repeat(_), Status::Running) => (Status::Running, count),
        (Decorator::Timeout(_), Status::Running) => (Status::Running, count + 1),
        (_, answer) => (answer, 0),
    }
}
