//! Tests of trees without a world.

use super::law::Behavior;
use super::program::Predicate;
use super::table::Id;
use super::task::{Learner, Task};
use super::tree::{Node, Status, Tree};

/// A test: what a tree finds in each tick, and what it has to select.
#[derive(Clone, Debug, PartialEq)]
pub struct Test {
    /// What it says.
    pub title: String,
    /// The tree, as the test names it.
    pub tree: String,
    /// What is ticked.
    pub subject: Subject,
    /// The task whose history window is kept.
    pub task: Option<Id<Task>>,
    /// Its lines, in order.
    pub lines: Vec<Line>,
}

/// What a test ticks.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// A tree of the program.
    Tree(Id<Tree>),
    /// A subtree under its arguments, or what another robot runs.
    Subtree(Node),
    /// The tree that a learner learns.
    Learned(Id<Learner>),
}

/// A line of a test: what changes, and what is expected then.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// The predicates that have another value from here on.
    pub changes: Vec<(Id<Predicate>, bool)>,
    /// What is expected; nothing is ticked where there is nothing.
    pub expected: Option<Expected>,
}

/// What a tick is to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// How many ticks are to do it, one after another.
    pub ticks: u64,
    /// The behaviours that are ticked, the selected one first, each with its answer. There may be more, unless the answer of
    /// the tree is said.
    pub behaviors: Vec<(Id<Behavior>, Status)>,
    /// What the tree answers.
    pub answer: Option<Status>,
}
