//! A policy that the counts call better, and the parts of its changes that are tried.
//!
//! A change where the policy at hand never comes is not seen in any episode, and one that needs another on the way looks
//! bad alone. So a part begins where the policy comes, and goes on along the ways that the counts foresee from there.

use crate::grow::evidence::Visits;
use crate::learn::process::Key;
use crate::learn::solve::{Problem, Solution};
use crate::random::Random;

/// The part of the plans that are tried as a whole.
const WHOLE: f64 = 0.25;
/// The parts of a plan that are tried, and of them the ones of which each change is left out as often as not.
const PARTS: usize = 3;
const THINNED: usize = 1;
/// A part has the changes on 1, 2, 4 or up to so many ways, as a power of two, of at most so many decisions.
const WAYS: u64 = 4;
const DECISIONS: usize = 60;

/// What would be decided otherwise, and what would follow.
pub(super) struct Plan<'k> {
    keys: &'k [Key],
    /// The changes, by row; in the order of the rows.
    changes: Vec<(usize, usize)>,
    /// The rows that follow each, with the probability that the episode goes on there.
    next: Vec<Vec<(usize, f64)>>,
}

impl<'k> Plan<'k> {
    /// The plan of a solution, with what it decides otherwise than the policy at hand.
    pub(super) fn new(
        keys: &'k [Key],
        changes: Vec<(usize, usize)>,
        problem: &Problem,
        solution: &Solution,
    ) -> Self {
        let rows = problem.states.iter().zip(&solution.policy);
        let next = rows.map(|(state, taken)| {
            let outlook = taken.and_then(|taken| state.get(taken));
            outlook.map_or_else(Vec::new, |(_, outlook)| outlook.next.clone())
        });
        Self {
            keys,
            changes,
            next: next.collect(),
        }
    }

    /// Changes to try together, where the policy at hand comes so often.
    pub(super) fn parts(&self, visits: &Visits, random: &mut Random) -> Vec<Vec<(Key, usize)>> {
        let weights = self.changes.iter().map(|(row, _)| {
            let visits = self.keys.get(*row).and_then(|key| visits.get(key));
            visits.copied().unwrap_or(0.0).min(1.0)
        });
        let weights: Vec<f64> = weights.collect();
        let all: f64 = weights.iter().sum();
        if all <= 0.0 {
            return Vec::new();
        }
        let mut parts = Vec::new();
        if random.chance(WHOLE) {
            parts.push(self.keyed(|_| true));
        }
        for part in 0..PARTS {
            let weighted = self.changes.iter().map(|(row, _)| *row).zip(weights.iter());
            let first = pick(weighted.map(|(row, weight)| (row, weight / all)), random);
            let seen = self.seen(first, random);
            let is_seen = |row: usize| seen.get(row).copied().unwrap_or(false);
            parts.push(match part < THINNED {
                true => self.keyed(|row| is_seen(row) && random.chance(0.5)),
                false => self.keyed(is_seen),
            });
        }
        parts
    }

    /// The rows that a few ways come through, all of which begin in the same one.
    fn seen(&self, first: Option<usize>, random: &mut Random) -> Vec<bool> {
        let mut seen = vec![false; self.keys.len()];
        for _ in 0..1 << random.below(WAYS) {
            let mut at = first;
            for _ in 0..DECISIONS {
                let Some(row) = at else { break };
                if let Some(seen) = seen.get_mut(row) {
                    *seen = true;
                }
                let next = self.next.get(row).into_iter().flatten().copied();
                at = pick(next, random);
            }
        }
        seen
    }

    /// Some of the changes, by their minterms.
    fn keyed(&self, mut taken: impl FnMut(usize) -> bool) -> Vec<(Key, usize)> {
        let changes = self.changes.iter().filter(|(row, _)| taken(*row));
        let keyed = changes.filter_map(|(row, choice)| Some((*self.keys.get(*row)?, *choice)));
        keyed.collect()
    }
}

/// One of these, each with its probability; none with what is missing from their sum.
fn pick(mut from: impl Iterator<Item = (usize, f64)>, random: &mut Random) -> Option<usize> {
    let mut left = random.unit();
    let found = from.find(|(_, weight)| {
        left -= weight;
        left < 0.0
    });
    found.map(|(at, _)| at)
}

#[cfg(test)]
mod tests {
    use super::Plan;
    use crate::grow::evidence::Visits;
    use crate::learn::process::Key;
    use crate::random::Random;

    /// A way from minterm 10 through 11 to 12; 13 is led to by nothing.
    #[test]
    fn parts_follow_the_ways_from_where_the_policy_comes() {
        let keys: [Key; 4] = [10, 11, 12, 13];
        let plan = Plan {
            keys: &keys,
            changes: vec![(0, 1), (2, 1), (3, 1)],
            next: vec![vec![(1, 1.0)], vec![(2, 1.0)], Vec::new(), Vec::new()],
        };
        let whole = vec![(10, 1), (12, 1), (13, 1)];
        let way = vec![(10, 1), (12, 1)];
        let mut random = Random::new(1, 0, 0);
        let visits = Visits::from_iter([(10, 1.0), (11, 1.0)]);
        let (mut wholes, mut ways) = (0, 0);
        for part in (0..40).flat_map(|_| plan.parts(&visits, &mut random)) {
            wholes += usize::from(part == whole);
            ways += usize::from(part == way);
            assert!(part == whole || part.iter().all(|change| way.contains(change)));
        }
        assert!(wholes > 0 && ways >= 80);
        assert!(plan.parts(&Visits::default(), &mut random).is_empty());
    }
}
