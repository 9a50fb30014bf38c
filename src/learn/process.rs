//! The decision process as a learner sees it (semi-Markov: Sutton, Precup and Singh 1999).

use crate::ir::tree::Status;

/// A minterm in a machine word: bit i is the i-th atom.
pub type Key = u128;

/// A process to decide over.
pub trait Process {
    /// Starts an episode; the same number starts the same episode again.
    fn start(&mut self, episode: u64);

    /// The minterm that holds now.
    fn key(&self) -> Key;

    /// Carries a choice out until the next decision is due. `choice` counts the behaviours of the task, `dwell` is the
    /// number of ticks for which the choice is kept whatever changes.
    fn decide(&mut self, choice: usize, dwell: u64) -> Step;

    /// How often each event of the program has fired in this episode.
    fn events(&self) -> &[u64];
}

/// What a decision led to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The minterm found after it.
    pub to: Key,
    /// How the behaviour stood when the next decision came due.
    pub status: Status,
    /// The reward of the transition.
    pub reward: f64,
    /// How many ticks it took.
    pub ticks: u64,
    /// Whether the episode goes on.
    pub end: End,
}

/// Whether and how an episode ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// It goes on.
    Not,
    /// This line of the task's `end on`, counted from zero, ended it: nothing follows.
    Terminal(usize),
    /// The tick limit cut it: the value of what would follow still counts.
    Cut,
}
