//! The history window: which terminations it holds, and what it shows of them.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Status};

/// A behaviour with how it ended; `None` is one that no atom asks for.
pub(super) type Termination = Option<(Id<Behavior>, Status)>;

/// The last terminations, the newest last. A window is full: what no atom asks for fills it up. It is empty where
/// nothing is remembered.
pub(super) type Window = Vec<Termination>;

/// The termination that a history atom asks for.
pub(super) fn termination(atom: Atom) -> Termination {
    match atom {
        Atom::Predicate(_) => None,
        Atom::Done(behavior) => Some((behavior, Status::Success)),
        Atom::Failed(behavior) => Some((behavior, Status::Failure)),
    }
}

/// Whether a behaviour that ends so enters the window.
pub(super) fn keeps(history: History, status: Status) -> bool {
    match status {
        Status::Success => history.window > 0 && history.success,
        Status::Failure => history.window > 0 && history.failure,
        Status::Running => false,
    }
}

/// Whether the window remembers what an atom asks.
pub(in crate::tree) fn remembers(history: History, atom: Atom) -> bool {
    termination(atom).is_some_and(|(_, status)| keeps(history, status))
}

/// Whether a window makes a history atom true.
pub(super) fn shows(window: &[Termination], atom: Atom) -> bool {
    let asked = termination(atom);
    asked.is_some() && window.contains(&asked)
}

/// A termination enters the window, and the oldest leaves it.
pub(super) fn enter(window: &mut Window, termination: Termination) {
    if !window.is_empty() {
        window.remove(0);
        window.push(termination);
    }
}
