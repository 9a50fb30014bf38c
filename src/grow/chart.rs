//! What whole trees are worth in the process that was counted.
//!
//! The advantage of a decision says what it brings once, if the tree before goes on from there. A tree that takes it again
//! and again goes elsewhere. So a tree is followed through the counts: what it is worth, and where it goes.

use super::evidence::{Evidence, FAR, Sight, Visits};
use super::field::Field;
use super::ground::Ground;
use super::reader::Reader;
use crate::ir::tree::Node;
use crate::learn::process::{Key, World};
use crate::learn::solve::Problem;

/// The counted process, in which trees are followed.
#[derive(Debug)]
pub struct Chart<'w> {
    problem: Problem,
    keys: Vec<Key>,
    /// How often an episode begins in each row.
    from: Vec<f64>,
    /// The return of an episode for each unit of discounted value.
    scale: f64,
    reader: Reader<'w>,
}

/// A tree as it was followed.
#[derive(Clone, Debug)]
pub struct Followed {
    /// The choice in each row, by its place among those that are known there.
    policy: Vec<Option<usize>>,
    /// What each row is worth.
    values: Vec<f64>,
    /// What it is worth to do what nobody tried.
    unknown: f64,
    /// What an episode returns.
    pub value: f64,
}

impl Followed {
    /// Whether it does something in more than half of the minterms.
    pub fn acts(&self) -> bool {
        self.policy.iter().flatten().count() * 2 > self.policy.len()
    }
}

/// How often what is not known is valued by what is.
const VALUED: usize = 3;

impl<'w> Chart<'w> {
    /// The process of these counts, doubted by so many decisions, where an episode has so many ticks.
    pub fn new<W: World>(
        ground: &Ground<'w, W>,
        evidence: &Evidence,
        doubt: f64,
        length: u64,
    ) -> Self {
        let keys = evidence.keys();
        let refusing = evidence.refusing();
        let minterms = keys.iter().zip(&refusing);
        let minterms = minterms.map(|(key, refuses)| (*key, refuses.as_slice()));
        let all: f64 = keys.iter().map(|key| evidence.begun(*key)).sum();
        let from = keys.iter().map(|key| evidence.begun(*key) / all.max(1.0));
        let horizons = length as f64 / (FAR * ground.start.limit as f64);
        Self {
            problem: evidence.doubted(Sight::Far, doubt),
            keys: keys.to_vec(),
            from: from.collect(),
            scale: horizons / (1.0 - crate::math::exp(-horizons)).max(1e-9),
            reader: Reader::new(ground, minterms),
        }
    }

    /// Follows a tree; `None` if it asks what the world does not know. What nobody tried is worth about as little as anything
    /// else that the tree does.
    pub fn follow(&self, root: &Node) -> Option<Followed> {
        let policy = self.policy(root)?;
        let mut values = self.problem.estimate(&policy);
        let mut unknown = self.problem.unknown;
        for _ in 0..VALUED {
            unknown = self.problem.low(&values);
            values = self.problem.evaluate_near(&policy, values, unknown);
        }
        Some(self.followed(policy, values, unknown))
    }

    /// Follows a tree that is much like another.
    pub fn follow_near(&self, root: &Node, near: &Followed) -> Option<Followed> {
        let policy = self.policy(root)?;
        let values = near.values.clone();
        let values = self.problem.evaluate_near(&policy, values, near.unknown);
        Some(self.followed(policy, values, near.unknown))
    }

    fn followed(&self, policy: Vec<Option<usize>>, values: Vec<f64>, unknown: f64) -> Followed {
        let begun = self.from.iter().zip(&values);
        let value: f64 = begun.map(|(part, value)| part * value).sum();
        Followed {
            policy,
            values,
            unknown,
            value: value * self.scale,
        }
    }

    fn policy(&self, root: &Node) -> Option<Vec<Option<usize>>> {
        self.reader.policy(root, &self.problem)
    }

    /// The minterms that matter to a tree, by how often an episode enters them.
    pub fn field<W: World>(
        &self,
        ground: &Ground<'w, W>,
        evidence: &Evidence,
        followed: &Followed,
    ) -> Field<'w> {
        let policy = &followed.policy;
        let met = self.problem.occupancy(policy, &self.from);
        let rows = self.keys.iter().zip(&met).enumerate();
        let visits: Visits = rows
            .map(|(row, (key, met))| {
                let stays = self.problem.stays(row, policy);
                (*key, met * (1.0 - stays) * self.scale)
            })
            .filter(|(_, visits)| *visits > 0.0)
            .collect();
        Field::with(ground, evidence, &self.problem, &followed.values, &visits)
    }
}
