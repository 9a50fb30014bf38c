//! Where a search for a tree stands: what it has to know to go on.

use super::evidence::{Evidence, Visits};
use super::grower::Visited;
use super::race::Seen;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Node;
use crate::learn::process::Key;
use crate::random::Random;
use rustc_hash::{FxHashMap, FxHashSet};
use serde::{Deserialize, Serialize};

/// A search that was stopped between two steps.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Halted {
    pub(super) evidence: Evidence,
    pub(super) random: Random,
    pub(super) collected: u64,
    pub(super) price: f64,
    pub(super) full_price: f64,
    pub(super) scale: f64,
    pub(super) visited: Vec<Visited>,
    pub(super) single: Option<Node>,
    pub(super) attempts: Attempts,
    pub(super) seen: Seen,
    /// The best tree so far.
    pub(super) base: Node,
    pub(super) step: Step,
}

/// What a search does next.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) enum Step {
    /// It has its first base.
    Begun,
    /// It covers the base by smaller trees.
    Cover(Cover),
    /// It grows trees by the counts alone, in this round.
    Sprout(usize),
    /// It has ended an attempt with the base.
    Attempted,
    /// It changes a tree beside the base.
    Detour(Detour),
    /// It changes the base.
    Climb(Stage),
    /// It looks for smaller trees that cost something.
    Refine(Stage),
    /// Nothing.
    Done,
}

/// The attempts to find a tree.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Attempts {
    /// The trees of the file that do no more harm than the exact one.
    pub(super) theirs: Vec<Node>,
    /// The trees that they begin with, in turn.
    pub(super) starts: Vec<Node>,
    /// The ticks that had been simulated when the one at hand began; none when they are over.
    pub(super) begun: Option<u64>,
    /// What came of those before: the best trees of their time, the last one last.
    pub(super) found: Vec<Vec<Visited>>,
}

/// Changes of a tree beside the best one.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Detour {
    /// The behaviours that were put into the best tree so far, by their numbers.
    pub(super) tried: Vec<usize>,
    /// The tree; none before the first and between two.
    pub(super) tree: Option<Node>,
    /// The behaviour that it must keep.
    pub(super) kept: Option<Id<Behavior>>,
    /// The ticks that had been simulated when it began.
    pub(super) begun: u64,
    /// How far it has come.
    pub(super) stage: Stage,
}

/// The trees that cover the base so far.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Cover {
    /// The last of them.
    pub(super) tree: Node,
    /// Where they went.
    pub(super) visits: Visits,
    /// The decisions of the base that the next keeps.
    pub(super) kept: FxHashMap<Key, usize>,
    pub(super) trees: Vec<Node>,
}

/// How far a row of races has come, in which one change after another is tried.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Stage {
    /// The number of the stage.
    pub(super) number: usize,
    /// Races without a better tree.
    pub(super) failures: usize,
    /// Trees that raced in it.
    pub(super) tried: FxHashSet<String>,
}

impl Stage {
    /// The beginning of a stage.
    pub(super) fn of(number: usize) -> Self {
        Self {
            number,
            ..Self::default()
        }
    }
}
