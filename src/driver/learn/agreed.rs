//! How far the seeds agree on what the learned policy does.

use super::bench::Bench;
use super::results::Results;
use crate::learn::agreement::Votes;
use crate::policy::Minterm;

/// The agreement of several runs with the one that was taken, on the minterms that its greedy policy reached.
pub(super) struct Agreement {
    /// How many minterms.
    pub reached: usize,
    /// On how many of them all runs do the same.
    pub unanimous: usize,
    /// The share of the runs that do what the policy does, over its decisions as they came.
    pub share: f64,
    /// The minterms on which runs differ, the most frequent first: what each behaviour got, and the decisions.
    pub disputed: Vec<Disputed>,
}

/// A minterm on which runs differ.
pub(super) struct Disputed {
    /// The minterm.
    pub minterm: Minterm,
    /// The behaviours that are chosen, by name, with the number of runs; most first.
    pub votes: Vec<(String, usize)>,
    /// How often the policy decided there.
    pub count: u64,
}

impl Agreement {
    /// Of the runs.
    pub fn of(bench: &Bench, results: &Results) -> Option<Self> {
        let taken = results.run()?;
        let runs: Vec<_> = results.runs.iter().map(|run| &run.decisions).collect();
        let choices = bench.task.choose.len();
        let mut agreement = Self {
            reached: 0,
            unanimous: 0,
            share: 0.0,
            disputed: Vec::new(),
        };
        let mut all = 0;
        for (key, count) in results.met.decisions() {
            let Some(decided) = taken.decisions.get(&key) else {
                continue;
            };
            let votes = Votes::on(key, choices, &runs);
            agreement.reached += 1;
            agreement.share += votes.share(decided.choice) * count as f64;
            all += count;
            if votes.unanimous() {
                agreement.unanimous += 1;
                continue;
            }
            let names = bench
                .task
                .choose
                .iter()
                .map(|id| bench.program.behaviors[*id].name.to_string());
            let mut named: Vec<(String, usize)> = names
                .zip(votes.votes)
                .filter(|(_, count)| *count > 0)
                .collect();
            named.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
            agreement.disputed.push(Disputed {
                minterm: Minterm::of_key(key, results.policy.atoms.len()),
                votes: named,
                count,
            });
        }
        agreement.share /= all.max(1) as f64;
        agreement
            .disputed
            .sort_by_key(|disputed| std::cmp::Reverse(disputed.count));
        Some(agreement)
    }
}
