//! Everything that learning found.

use super::words::numbered;
use crate::grow::Grown;
use crate::ir::tree::Node;
use crate::learn::agreement::Agreement;
use crate::learn::curve::Point;
use crate::learn::experiment::Experiment;
use crate::learn::improve::Improved;
use crate::learn::rollout::RollOut;
use crate::learn::run::Run;
use crate::learn::statistics::Summary;
use crate::policy::{Minterm, Policy};
use crate::tree::Size;
use crate::tree::decanonicalise::{Care, Decanonicalised};
use crate::world::Simulator;

/// Everything that learning found.
#[derive(Clone, Debug)]
pub struct Results<'a, W = Simulator> {
    /// The learner in its world.
    pub experiment: &'a Experiment<'a, W>,
    /// The runs, in the order of their seeds.
    pub runs: Vec<Run>,
    /// The figures of each on the episodes by which the best was taken; empty for a single one.
    pub validated: Vec<Summary>,
    /// The place of the run that was taken.
    pub best: usize,
    /// What was changed in its policy since, by simulation.
    pub improved: Improved,
    /// The minterms with too little evidence, with their decisions.
    pub thin: Vec<(Minterm, u64)>,
    /// What the greedy policy met.
    pub met: RollOut,
    /// The figures of its episodes.
    pub summary: Summary,
    /// The policy.
    pub policy: Policy,
    /// The tree on either care set; that of the chosen one is what was learned.
    pub trees: Trees,
    /// The tree that was grown and is printed instead of the exact one, if one was asked for.
    pub grown: Option<Grown>,
    /// The figures of the exact tree on test episodes, if there were any.
    pub tested: Option<Summary>,
}

/// The policy as a tree, once for each care set.
#[derive(Clone, Debug)]
pub struct Trees {
    /// The set that the learned tree was made for.
    pub care: Care,
    /// The tree for every minterm that was learned.
    pub seen: Decanonicalised,
    /// The tree for those that the greedy policy reached.
    pub reachable: Decanonicalised,
}

impl Trees {
    /// The learned tree.
    pub fn chosen(&self) -> &Decanonicalised {
        match self.care {
            Care::Seen => &self.seen,
            Care::Reachable => &self.reachable,
        }
    }
}

/// The tree that is printed, with what is known of it.
#[derive(Clone, Debug)]
pub struct Printed<'r> {
    /// The figures of its episodes.
    pub summary: &'r Summary,
    /// Its size.
    pub size: Size,
    /// What was proved of it, or that it was tested.
    pub evidence: String,
}

impl<W> Results<'_, W> {
    /// The tree that is printed. The exact tree takes the decisions of the policy, so the episodes of the policy are its
    /// own, unless it was tested in others, as it is where a behaviour fails at once: there the tree goes on.
    pub fn printed(&self) -> Printed<'_> {
        match &self.grown {
            Some(grown) => Printed {
                summary: &grown.after.summary,
                size: grown.after.size,
                evidence: match grown.kept {
                    true => format!("proved on {}", self.proved()),
                    false => format!(
                        "tested, not proved; the exact tree, proved, has {}",
                        numbered(grown.before.size.nodes as u64, "node")
                    ),
                },
            },
            None => Printed {
                summary: self.tested.as_ref().unwrap_or(&self.summary),
                size: self.trees.chosen().size,
                evidence: format!("proved on {}", self.proved()),
            },
        }
    }

    /// Whether the tree that is printed is another than the exact one.
    pub fn is_grown(&self) -> bool {
        self.grown.as_ref().is_some_and(|grown| !grown.kept)
    }

    /// The root of the tree that is printed.
    pub fn root(&self) -> &Node {
        match &self.grown {
            Some(grown) => &grown.root,
            None => &self.trees.chosen().root,
        }
    }

    /// The run that was taken.
    pub fn run(&self) -> Option<&Run> {
        self.runs.get(self.best)
    }

    /// The learning curve of each run, by its seed.
    pub fn curves(&self) -> Vec<(u64, Vec<Point>)> {
        let runs = self.runs.iter();
        runs.map(|run| (run.seed, run.points.clone())).collect()
    }

    /// How far several runs agree with the one that was taken.
    pub fn agreement(&self) -> Option<Agreement> {
        let taken = self.run().filter(|_| self.runs.len() > 1)?;
        let runs: Vec<_> = self.runs.iter().map(|run| &run.decisions).collect();
        let choices = self.experiment.task.choose.len();
        Some(Agreement::of(&taken.decisions, &runs, choices, &self.met))
    }

    /// What was proved, in words.
    pub fn proved(&self) -> String {
        let proof = &self.trees.chosen().proof;
        let closed = if proof.closed {
            "closed under them"
        } else {
            "not closed under them"
        };
        let seen = self.policy.rows.len();
        let minterms = if proof.minterms == seen {
            format!("{seen} observed minterms")
        } else {
            format!("{} of {seen} observed minterms", proof.minterms)
        };
        format!("{minterms} and {} transitions, {closed}", proof.transitions)
    }

    /// Where the learned tree comes from, as a doc comment.
    pub fn origin(&self, file: &str) -> String {
        let seed = self.run().map_or(0, |run| run.seed);
        let among = match self.runs.as_slice() {
            [first, .., last] => format!(", the best of {} to {}", first.seed, last.seed),
            _ => String::new(),
        };
        format!(
            "Learned from {file}, seed {seed}{among}: proved on {}.",
            self.proved()
        )
    }
}
