//! The history window as a program runs: which terminations it holds, and what they make true.

use super::Id;
use super::law::Behavior;
use super::task::History;
use super::tree::{Atom, Status};

/// A behaviour, and how it ended.
pub type Termination = (Id<Behavior>, Status);

impl History {
    /// Whether a behaviour that ends with this status enters the window.
    pub fn keeps(self, status: Status) -> bool {
        let kind = match status {
            Status::Success => self.success,
            Status::Failure => self.failure,
            Status::Running => false,
        };
        kind && self.window > 0
    }

    /// Whether the window remembers what an atom asks.
    pub fn remembers(self, atom: Atom) -> bool {
        atom.termination()
            .is_some_and(|(_, status)| self.keeps(status))
    }

    /// How many terminations the window holds where these are remembered; none where there is nothing to remember.
    pub fn length<T>(self, remembered: &[T]) -> usize {
        match remembered.is_empty() {
            true => 0,
            false => self.window,
        }
    }
}

impl Atom {
    /// The termination that a history atom asks for; a predicate asks for none.
    pub fn termination(self) -> Option<Termination> {
        match self {
            Self::Predicate(_) => None,
            Self::Done(behavior) => Some((behavior, Status::Success)),
            Self::Failed(behavior) => Some((behavior, Status::Failure)),
        }
    }
}

/// The last terminations of the kinds that a task remembers.
#[derive(Clone, Debug)]
pub struct Window {
    history: History,
    /// The newest first; never longer than the window.
    entries: Vec<Termination>,
}

impl Window {
    /// An empty window.
    pub fn new(history: History) -> Self {
        Self {
            history,
            entries: Vec::with_capacity(history.window),
        }
    }

    /// The terminations, the newest first.
    pub fn entries(&self) -> &[Termination] {
        &self.entries
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.entries.clear();
    }

    /// Takes in a termination, if it is of a kind that is remembered, and says whether it was.
    pub fn record(&mut self, behavior: Id<Behavior>, status: Status) -> bool {
        let kept = self.history.keeps(status);
        if kept {
            self.entries.truncate(self.history.window - 1);
            self.entries.insert(0, (behavior, status));
        }
        kept
    }

    /// Whether the window makes a history atom true.
    pub fn shows(&self, atom: Atom) -> bool {
        let asked = atom.termination();
        asked.is_some_and(|asked| self.entries.contains(&asked))
    }
}
