//! How far several runs of learning came to the same decisions.

use super::extract::Decisions;
use super::process::Key;

/// What the runs do in one minterm.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Votes {
    /// The minterm.
    pub key: Key,
    /// For each choice, how many runs make it. Runs that have not learned the minterm have no vote.
    pub votes: Vec<usize>,
}

impl Votes {
    /// The votes of the runs on a minterm.
    pub fn on(key: Key, choices: usize, runs: &[&Decisions]) -> Self {
        let mut votes = vec![0; choices];
        for decided in runs.iter().filter_map(|run| run.get(&key)) {
            if let Some(count) = votes.get_mut(decided.choice) {
                *count += 1;
            }
        }
        Self { key, votes }
    }

    /// The share of the votes for a choice; 1 if there are none.
    pub fn share(&self, choice: usize) -> f64 {
        let all: usize = self.votes.iter().sum();
        let own = self.votes.get(choice).copied().unwrap_or(0);
        if all == 0 {
            1.0
        } else {
            own as f64 / all as f64
        }
    }

    /// Whether all do the same.
    pub fn unanimous(&self) -> bool {
        self.votes.iter().filter(|count| **count > 0).count() <= 1
    }
}
