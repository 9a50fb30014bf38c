//! Policy tables of any origin.

use super::{Error, Tree};
use crate::driver::Text;
use crate::driver::decanonicalize::{self, Options};
use std::path::Path;
use std::sync::Arc;

/// A policy table: a column for each predicate and one for the behaviour, as comma-separated values or JSON Lines.
#[derive(Clone, Debug)]
pub struct PolicyTable {
    name: String,
    bytes: Vec<u8>,
}

impl PolicyTable {
    /// Reads the table in a file.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn from_file(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let bytes = std::fs::read(path).map_err(|error| Error::file(path, error))?;
        let name = path.to_string_lossy().into_owned();
        Ok(Self { name, bytes })
    }

    /// The table in a text; `name` is what reports call it.
    pub fn from_text(name: &str, text: &str) -> Self {
        Self {
            name: name.to_owned(),
            bytes: text.into(),
        }
    }

    /// Turns the table into a tree, which is proved equal to it.
    ///
    /// # Errors
    /// The table has mistakes.
    pub fn decanonicalise(&self, options: &Options) -> Result<Tree, Error> {
        let asked = decanonicalize::read(self.text(), None, None, options)?;
        let made = decanonicalize::decanonicalize(asked, options)?;
        let tree = made.program.trees[made.tree].clone();
        Ok(Tree::new(Arc::new(made.program), tree))
    }

    pub(super) fn text(&self) -> Text<'_> {
        Text {
            name: &self.name,
            bytes: &self.bytes,
        }
    }
}
