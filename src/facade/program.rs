//! Programs.

use super::disk::{Disk, bounded};
use super::{Error, Learned, PolicyTable, Tree};
use crate::diagnostic::Diagnostic;
use crate::driver::load::{self, Loaded};
use crate::driver::verify::Proved;
use crate::driver::{Refused, learn, run, target, verify};
use crate::ir;
use crate::report::episodes::Episodes;
use crate::syntax::print;
use std::fmt;
use std::fs::File;
use std::path::Path;
use std::sync::Arc;

/// A checked program: a world, what can be observed of it, behaviours, tasks, learners and trees.
#[derive(Clone, Debug)]
pub struct Program {
    loaded: Arc<Loaded>,
    /// The program alone, which trees share.
    ir: Arc<ir::Program>,
}

impl Program {
    /// Reads and checks the program in a file, and the files that it uses.
    ///
    /// # Errors
    /// The file cannot be read, or the program has mistakes: all of them, not only the first.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let text = File::open(path).and_then(|file| bounded(file, load::MOST as u64));
        let text = text.map_err(|error| Error::file(path, error))?;
        Self::checked(&path.to_string_lossy(), text)
    }

    /// Checks a program. Files that it uses are looked for from the current folder.
    ///
    /// # Errors
    /// The program has mistakes: all of them, not only the first.
    pub fn from_text(text: &str) -> Result<Self, Error> {
        Self::checked("<text>", text.into())
    }

    fn checked(name: &str, text: Vec<u8>) -> Result<Self, Error> {
        let loaded = load::load(name, text, &mut Disk);
        if loaded.has_errors() {
            return Err(Error::Mistakes(Refused {
                sources: loaded.sources,
                diagnostics: loaded.diagnostics,
            }));
        }
        Ok(Self {
            ir: Arc::new(loaded.program.clone()),
            loaded: Arc::new(loaded),
        })
    }

    /// What may be wrong with the program although it runs.
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.loaded.diagnostics
    }

    /// The trees of the program, in the order in which they are declared.
    pub fn trees(&self) -> impl Iterator<Item = Tree> {
        let trees = self.ir.trees.values();
        trees.map(|tree| Tree::new(Arc::clone(&self.ir), tree.clone()))
    }

    /// The tree of a name.
    ///
    /// # Errors
    /// There is none.
    pub fn tree(&self, name: &str) -> Result<Tree, Error> {
        let id = target::tree(&self.loaded, name)?;
        Ok(Tree::new(Arc::clone(&self.ir), self.ir.trees[id].clone()))
    }

    /// Learns a policy, turns it into a tree and proves that the two are equal.
    ///
    /// # Errors
    /// The program has no such learner, its world cannot be built, or nothing was learned.
    pub fn learn(&self, options: &learn::Options) -> Result<Learned, Error> {
        let learned = learn::learn(&self.loaded, options, &|_| {})?;
        Ok(Learned::new(Arc::clone(&self.ir), learned))
    }

    /// Runs episodes 0 … n − 1 of a seed under a tree, on all threads.
    ///
    /// # Errors
    /// There is no such tree, or the world cannot be built.
    pub fn run(&self, tree: &str, episodes: u64, seed: u64) -> Result<Episodes, Error> {
        let subject = run::Subject::tree(&self.loaded, tree)?;
        Ok(run::run(&self.loaded, &subject, episodes, seed)?)
    }

    /// Proves that two trees select the same behaviour in every tick, or finds a shortest trace on which they part.
    ///
    /// # Errors
    /// There is no such tree, or the trees are for different tasks.
    pub fn prove_equal(&self, left: &str, right: &str) -> Result<Proved, Error> {
        Ok(verify::trees(&self.loaded, left, right)?)
    }

    /// Proves that a tree takes the decisions of a table, or shows the rows that it decides otherwise.
    ///
    /// # Errors
    /// There is no such tree, or the table has mistakes, or it does not say what the tree asks.
    pub fn prove_decisions(&self, tree: &str, table: &PolicyTable) -> Result<Proved, Error> {
        Ok(verify::table(
            &self.loaded,
            tree,
            (table.text(), None),
            None,
        )?)
    }
}

/// The text of the program, laid out.
impl fmt::Display for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = self.loaded.sources.get(self.loaded.main);
        let text = text.map(|source| source.text.as_str());
        f.write_str(&print::file(&self.loaded.ast, text))
    }
}
