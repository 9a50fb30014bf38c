//! Trees.

use super::{Error, Ticker};
use crate::driver::{Refused, export, verify};
use crate::emit::bt;
use crate::emit::form::TreeForm;
use crate::ir;
use crate::source::{Sources, Span};
use crate::tree::Size;
use std::fmt;
use std::sync::Arc;

/// A tree, with the program that its names belong to. [`fmt::Display`] writes it in the language.
#[derive(Clone, Debug)]
pub struct Tree {
    program: Arc<ir::Program>,
    tree: ir::tree::Tree,
}

impl Tree {
    pub(super) fn new(program: Arc<ir::Program>, tree: ir::tree::Tree) -> Self {
        Self { program, tree }
    }

    pub(super) fn program(&self) -> &ir::Program {
        &self.program
    }

    pub(super) fn ir(&self) -> &ir::tree::Tree {
        &self.tree
    }

    /// The name, as the language writes it.
    pub fn name(&self) -> String {
        self.tree.name.to_string()
    }

    /// The size: nodes, literals and depth.
    pub fn size(&self) -> Size {
        Size::of(&self.tree.root)
    }

    /// Writes the tree in a form.
    ///
    /// # Errors
    /// The form has no counterpart for a node of the tree.
    pub fn emit(&self, form: TreeForm) -> Result<String, Error> {
        export::tree(&self.program, &self.tree, form, |_| Span::default()).map_err(|mistake| {
            Error::Mistakes(Refused {
                sources: Sources::default(),
                diagnostics: vec![mistake],
            })
        })
    }

    /// The tree with fresh memory, to tick in a loop of your own.
    pub fn ticker(&self) -> Ticker {
        let history = match self.tree.task {
            Some(task) => self.program.tasks[task].history,
            None => verify::assumed(&[&self.tree.root]),
        };
        Ticker::new(&self.program, &self.tree.root, history)
    }
}

impl fmt::Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&bt::tree(&self.program, &self.tree))
    }
}
