//! The history window of an environment that says only what atoms ask: what else ends is one and the same to it.

use crate::ir::history;
use crate::ir::tree::Atom;

/// A termination; `None` is one that no atom asks for.
pub(super) type Termination = Option<history::Termination>;

/// The last terminations, the newest last. A window is full: what no atom asks for fills it up. It is empty where
/// nothing is remembered.
pub(super) type Window = Vec<Termination>;

/// Whether a window makes a history atom true.
pub(super) fn shows(window: &[Termination], atom: Atom) -> bool {
    let asked = atom.termination();
    asked.is_some() && window.contains(&asked)
}

/// A termination enters the window, and the oldest leaves it.
pub(super) fn enter(window: &mut Window, termination: Termination) {
    if !window.is_empty() {
        window.remove(0);
        window.push(termination);
    }
}
