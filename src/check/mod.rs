//! Names, types, units and constants: the syntax tree becomes the checked program.
//!
//! Every body is checked once for itself, with its parameters known by type only; then families, behaviours and
//! subtrees are unrolled by checking their bodies again under their arguments. What goes wrong only under the
//! arguments is reported where they are given. A mistake is reported once: an expression of `Type::Error`
//! agrees with everything that is built on it.

mod body;
mod builtin;
mod checker;
mod clash;
mod context;
mod decl;
mod expr;
mod lint;
mod meaning;
mod members;
mod merge;
mod names;
mod report;
mod signature;
mod task;
mod tree;
mod tune;
mod twice;
mod types;
mod world;

pub use builtin::names as built_in_names;
pub use lint::{exclusions, least};
pub use meaning::{Entity, Meaning, Meanings};
pub use names::learned_name;
pub use task::history::kept_too_little;
pub use task::learner::methods;
pub use types::written::names as built_in_types;

use crate::diagnostic::Diagnostic;
use crate::ir::Program;
use crate::ir::input::Measure;
use crate::source::Span;
use crate::syntax::{self, ast};
use checker::Checker;
use std::collections::BTreeMap;
use types::units;

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
    /// Where the values of the program's tunables stand; several places where they are arguments that are spelled alike.
    pub tunes: Vec<Vec<Span>>,
    /// What the names of the text stand for.
    pub meanings: Meanings,
    /// Every mistake and warning.
    pub diagnostics: Vec<Diagnostic>,
}

/// What a unit means that a table names; `None` if the language has none that is called so.
pub fn unit(text: &str) -> Option<Measure> {
    let meaning = units::meaning(&syntax::unit(text)?, None)?;
    Some(Measure {
        unit: meaning.scale.of_unit(text),
        dim: meaning.dim,
    })
}

/// Checks the files of a program, those that are used before those that use them.
pub fn check(files: &[Input]) -> Checked {
    check_with(files, BTreeMap::new())
}

/// Checks a program with other values for some of its tunables, in their units, by the places where these stand.
pub fn check_with(files: &[Input], tuned: BTreeMap<Span, f64>) -> Checked {
    let mut checker = Checker::new(files);
    checker.tunes.set(tuned);
    checker.program(files);
    checker.checked()
}
