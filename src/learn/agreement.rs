//! How far several runs of learning agree on decisions.

use super::extract::Decisions;
use super::process::Key;
use super::rollout::RollOut;
use std::cmp::Reverse;

/// The agreement of several runs with one of them, on the minterms that its greedy policy reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Agreement {
    /// The number of these minterms.
    pub reached: usize,
    /// On how many of them all runs decide alike.
    pub unanimous: usize,
    /// The share of the runs that do what the policy does, averaged over its decisions.
    pub share: f64,
    /// The minterms on which runs differ, the most frequent first.
    pub disputed: Vec<Disputed>,
}

/// A minterm on which runs differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Disputed {
    /// The minterm.
    pub key: Key,
    /// The choices that runs make there, each with the number of runs, the most frequent first.
    pub votes: Vec<(usize, usize)>,
    /// How often the policy decided there.
    pub count: u64,
}

impl Agreement {
    /// The agreement of `runs` with `taken`, on what it met. Runs that have not learned a minterm have no vote there.
    pub fn of(taken: &Decisions, runs: &[&Decisions], choices: usize, met: &RollOut) -> Self {
        let mut agreement = Self {
            reached: 0,
            unanimous: 0,
            share: 0.0,
            disputed: Vec::new(),
        };
        let mut all = 0;
        for (key, count) in met.decisions() {
            let Some(decided) = taken.get(&key) else {
                continue;
            };
            let votes = votes(key, choices, runs);
            agreement.reached += 1;
            agreement.share += share(&votes, decided.choice) * count as f64;
            all += count;
            if votes.len() <= 1 {
                agreement.unanimous += 1;
            } else {
                agreement.disputed.push(Disputed { key, votes, count });
            }
        }
        agreement.share /= all.max(1) as f64;
        let disputed = &mut agreement.disputed;
        disputed.sort_by_key(|disputed| Reverse(disputed.count));
        agreement
    }
}

/// The choices that runs make in a minterm, with the number of runs, the most frequent first.
fn votes(key: Key, choices: usize, runs: &[&Decisions]) -> Vec<(usize, usize)> {
    let made = |choice| {
        let decided = runs.iter().filter_map(|run| run.get(&key));
        decided.filter(|decided| decided.choice == choice).count()
    };
    let votes = (0..choices).map(|choice| (choice, made(choice)));
    let mut votes: Vec<(usize, usize)> = votes.filter(|(_, count)| *count > 0).collect();
    votes.sort_by_key(|(_, count)| Reverse(*count));
    votes
}

/// The share of the votes for a choice; 1 if there are none.
fn share(votes: &[(usize, usize)], choice: usize) -> f64 {
    let all: usize = votes.iter().map(|(_, count)| count).sum();
    let own = votes.iter().find(|(other, _)| *other == choice);
    if all == 0 {
        1.0
    } else {
        own.map_or(0, |(_, count)| *count) as f64 / all as f64
    }
}
