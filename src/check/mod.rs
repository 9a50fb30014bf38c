//! Names, types, units and constants: the syntax tree becomes the checked program.
//!
//! Every body is checked once for itself, with its parameters known by type only; then families, behaviours and
//! subtrees are unrolled by checking their bodies again under their arguments. What goes wrong only under the
//! arguments is reported where they are given. A mistake is reported once: an expression of `Type::Error`
//! agrees with everything that is built on it.

mod body;
mod builtin;
mod checker;
mod context;
mod decl;
mod expr;
mod names;
mod report;
mod signature;
mod task;
mod tree;
mod types;
mod world;

pub use builtin::names as built_in_names;

use crate::diagnostic::Diagnostic;
use crate::ir::Program;
use crate::syntax::ast;
use checker::Checker;

/// A parsed file.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// Its syntax tree.
    pub ast: &'a ast::File,
    /// Whether it is of the embedded library.
    pub library: bool,
}

/// What came of a program.
#[derive(Debug)]
pub struct Checked {
    /// The program; of use only where no diagnostic is an error.
    pub program: Program,
    /// Every mistake and warning.
    pub diagnostics: Vec<Diagnostic>,
}

/// Checks the files of a program, those that are used before those that use them.
pub fn check(files: &[Input]) -> Checked {
    let mut checker = Checker::new(files);
    checker.program(files);
    checker.checked()
}
