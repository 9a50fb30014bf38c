//! Which of several policies is the best: by simulation, on episodes that none of them was learned from.

use super::bench::Bench;
use crate::learn::extract::{self, Decided, Decisions};
use crate::learn::process::Key;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Summary;
use crate::learn::table::Table;

/// How many episodes a policy is validated on.
const VALIDATION: u64 = 200;

/// How many proposals of a run are validated.
const FINALISTS: usize = 3;

impl Bench<'_> {
    /// The best of a run's proposals, each a table with what it came to on the curve: those that look best there are
    /// validated, each policy once.
    pub fn elect(&self, mut proposals: Vec<(f64, Table)>, seed: u64) -> Option<(Decisions, Table)> {
        // Of equals the later one, which has seen more.
        proposals.reverse();
        proposals.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let mut finalists: Vec<(Decisions, Table)> = Vec::new();
        for (_, table) in proposals {
            let decisions = extract::greedy(&table, self.evidence);
            let known = finalists.iter().any(|(other, _)| same(other, &decisions));
            if !known && finalists.len() < FINALISTS {
                finalists.push((decisions, table));
            }
        }
        let stream = (Purpose::Propose, seed);
        let all = finalists.iter();
        let validated: Vec<Summary> = all
            .map(|(decisions, _)| self.validate(decisions, stream))
            .collect();
        finalists.into_iter().nth(self.best(&validated))
    }

    /// What a policy is worth on the episodes by which the best of several is taken.
    pub fn validate(&self, decisions: &Decisions, stream: (Purpose, u64)) -> Summary {
        self.roll_out(decisions, VALIDATION, stream).1
    }

    /// The place of the best, the first of equals: where the program claims that the learned tree never does something,
    /// the fewest such events; then the greatest return.
    pub fn best(&self, validated: &[Summary]) -> usize {
        let better = |a: &Summary, b: &Summary| {
            let order = self.broken(b).cmp(&self.broken(a));
            order.then(a.total.mean.total_cmp(&b.total.mean)).is_gt()
        };
        let mut best = 0;
        for (at, summary) in validated.iter().enumerate() {
            if validated
                .get(best)
                .is_some_and(|other| better(summary, other))
            {
                best = at;
            }
        }
        best
    }

    /// How often something happened that the program claims never to happen.
    fn broken(&self, summary: &Summary) -> u64 {
        let events = self.never.iter().map(|event| event.index());
        let counts = events.filter_map(|event| summary.events.get(event));
        counts.map(|(count, _)| count).sum()
    }
}

/// Whether two policies decide alike.
fn same(a: &Decisions, b: &Decisions) -> bool {
    let alike = |(key, decided): (&Key, &Decided)| {
        b.get(key)
            .is_some_and(|other| other.choice == decided.choice)
    };
    a.len() == b.len() && a.iter().all(alike)
}
