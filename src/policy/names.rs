//! What the names in a table mean.
//!
//! A table has names as text, and anybody may have written it: a name is found in a program by its bare form.

use super::error::TableErrorKind;
use crate::ir::Id;
use crate::ir::Program;
use crate::ir::law::Behavior;
use crate::ir::tree::Atom;
use crate::spelling::{self, bare};
use std::collections::BTreeMap;
use std::fmt;

/// What an atom's column is called, without the backquotes of the language.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum AtomName {
    /// A predicate.
    Predicate(String),
    /// `done(NAME)`
    Done(String),
    /// `failed(NAME)`
    Failed(String),
}

impl AtomName {
    /// What the column of an atom is called.
    pub(super) fn of(atom: Atom, program: &Program) -> Self {
        match atom {
            Atom::Predicate(id) => Self::Predicate(program.predicates[id].name.bare()),
            Atom::Done(id) => Self::Done(program.behaviors[id].name.bare()),
            Atom::Failed(id) => Self::Failed(program.behaviors[id].name.bare()),
        }
    }

    /// What a column of this name asks. `done(NAME)` and `failed(NAME)` ask the history; all else is a predicate.
    pub fn read(column: &str) -> Self {
        let inside = |word: &str| {
            let argument = column.strip_prefix(word)?.strip_prefix('(')?;
            argument.strip_suffix(')')
        };
        match (inside(Atom::DONE), inside(Atom::FAILED)) {
            (Some(behavior), _) => Self::Done(bare(behavior).to_owned()),
            (_, Some(behavior)) => Self::Failed(bare(behavior).to_owned()),
            _ => Self::Predicate(bare(column).to_owned()),
        }
    }

    /// The behaviour whose history it asks.
    pub(super) fn behavior(&self) -> Option<&str> {
        match self {
            Self::Predicate(_) => None,
            Self::Done(name) | Self::Failed(name) => Some(name),
        }
    }

    /// Whether the language can call something so.
    pub(in crate::policy) fn check(&self) -> Result<(), TableErrorKind> {
        match self {
            Self::Predicate(name) | Self::Done(name) | Self::Failed(name) => check(name),
        }
    }
}

impl fmt::Display for AtomName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Predicate(name) => f.write_str(name),
            Self::Done(name) => write!(f, "{}({name})", Atom::DONE),
            Self::Failed(name) => write!(f, "{}({name})", Atom::FAILED),
        }
    }
}

/// The behaviours of a program by their bare names.
pub(super) fn behaviors(program: &Program) -> BTreeMap<String, Id<Behavior>> {
    let behaviors = program.behaviors.iter();
    behaviors.map(|(id, b)| (b.name.bare(), id)).collect()
}

/// The atoms of a program by what their columns are called.
pub(super) fn atoms(program: &Program) -> BTreeMap<AtomName, Atom> {
    let predicates = program.predicates.ids().map(Atom::Predicate);
    let history = program
        .behaviors
        .ids()
        .flat_map(|b| [Atom::Done(b), Atom::Failed(b)]);
    predicates
        .chain(history)
        .map(|atom| (AtomName::of(atom, program), atom))
        .collect()
}

/// What something is called here that another tool calls so, in a file that nobody writes by hand: with an underscore where the
/// name would ask the history.
pub(super) fn foreign(name: &str) -> String {
    match name {
        Atom::DONE | Atom::FAILED => format!("{name}_"),
        _ => name.to_owned(),
    }
}

/// Whether the language can call something so, in backquotes where it has to.
pub(super) fn check(name: &str) -> Result<(), TableErrorKind> {
    let why = match name {
        Atom::DONE | Atom::FAILED => Some("it asks the history, in the language as in a table"),
        _ if name.starts_with("done(") || name.starts_with("failed(") => {
            Some("it would ask the history, and its parenthesis is never closed")
        }
        _ => spelling::unusable(name),
    };
    why.map_or(Ok(()), |why| {
        Err(TableErrorKind::UnusableName {
            name: name.to_owned(),
            why,
        })
    })
}
