//! Which of several policies is the best: by simulation, on episodes that none of them was learned from.

use super::experiment::Experiment;
use super::extract::{self, Decided, Decisions};
use super::process::{Key, World};
use super::q_table::QTable;
use super::run::Run;
use super::simulated::Purpose;
use super::statistics::Summary;

/// The episodes that validate a policy.
const VALIDATION: u64 = 200;

/// Those that do so where the program claims that something never happens: what is rare is not met in a few.
const CLAIMED: u64 = 1000;

/// The proposals of a run that are validated.
const FINALISTS: usize = 3;

impl<W: World> Experiment<'_, W> {
    /// The place of the best of several runs on common episodes that none of them learned from, with the figures of
    /// each there; a single run is not measured.
    pub fn elect(&self, runs: &[Run], seed: u64) -> (usize, Vec<Summary>) {
        if runs.len() < 2 {
            return (0, Vec::new());
        }
        self.compare(
            runs.iter().map(|run| &run.decisions),
            (Purpose::Validate, seed),
        )
    }

    /// The best of a run's proposals, each a table with its return on the curve: those that look best there are
    /// validated, each policy once.
    pub(super) fn elect_proposal(
        &self,
        mut proposals: Vec<(f64, QTable)>,
        seed: u64,
    ) -> Option<(Decisions, QTable)> {
        // Of equals the later one, which has seen more.
        proposals.reverse();
        proposals.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let mut finalists: Vec<(Decisions, QTable)> = Vec::new();
        for (_, table) in proposals {
            let decisions = extract::greedy(&table, self.evidence);
            let known = finalists.iter().any(|(other, _)| same(other, &decisions));
            if !known && finalists.len() < FINALISTS {
                finalists.push((decisions, table));
            }
        }
        let policies = finalists.iter().map(|(decisions, _)| decisions);
        let (best, _) = self.compare(policies, (Purpose::Propose, seed));
        finalists.into_iter().nth(best)
    }

    /// The place of the best of these policies, the first of equals, with the figures of each: where the program claims
    /// that the learned tree never does something, the fewest such events; then the greatest return.
    fn compare<'d>(
        &self,
        policies: impl Iterator<Item = &'d Decisions>,
        stream: (Purpose, u64),
    ) -> (usize, Vec<Summary>) {
        let measure = |decisions| self.roll_out(decisions, self.validations(), stream).1;
        let measured: Vec<Summary> = policies.map(measure).collect();
        let order = |a: &Summary, b: &Summary| {
            let order = self.broken(b).cmp(&self.broken(a));
            order.then(a.total.mean.total_cmp(&b.total.mean))
        };
        // Of equals `max_by` takes the last.
        let best = measured.iter().enumerate().rev();
        let best = best.max_by(|(_, a), (_, b)| order(a, b));
        (best.map_or(0, |(at, _)| at), measured)
    }

    /// The episodes by which a policy is compared with others.
    pub fn validations(&self) -> u64 {
        match self.never.is_empty() {
            true => VALIDATION,
            false => CLAIMED,
        }
    }

    /// How often something happened that the program claims never to happen.
    fn broken(&self, summary: &Summary) -> u64 {
        let events = self.never.iter().map(|event| event.index());
        let counts = events.filter_map(|event| summary.events.get(event));
        counts.map(|rate| rate.count).sum()
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
