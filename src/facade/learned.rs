//! What was learned.

use super::Tree;
use crate::driver::learn;
use crate::ir::Program;
use std::sync::Arc;

/// What was learned: a tree that is proved equal to its policy, with all that was found on the way.
#[derive(Clone, Debug)]
pub struct Learned {
    tree: Tree,
    learned: learn::Learned,
}

impl Learned {
    pub(super) fn new(program: Arc<Program>, learned: learn::Learned) -> Self {
        let tree = Tree::new(program, learned.tree.clone());
        Self { tree, learned }
    }

    /// The tree.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// What a person wants to know of the learning and of the tree, in lines.
    pub fn report(&self) -> &[String] {
        &self.learned.report
    }

    /// The files that `btc learn` writes, by name: the policy, its transitions, the Q-table, the tree in its forms.
    pub fn files(&self) -> impl Iterator<Item = (&str, &str)> {
        let files = self.learned.files.iter();
        files.map(|(name, text)| (*name, text.as_str()))
    }

    /// The text of one of these files.
    pub fn file(&self, name: &str) -> Option<&str> {
        let found = self.files().find(|(file, _)| *file == name);
        found.map(|(_, text)| text)
    }
}
