//! Why a world cannot be simulated.

use crate::eval::TooLarge;
use crate::ir::Name;
use std::fmt;

/// Why a world cannot be simulated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BuildError {
    /// The program has no world.
    NoWorld,
    /// This predicate or behaviour is declared only.
    Declared(Name),
    /// The tree of this robot cannot be run.
    NoScript(Name),
    /// There are this many walls under a condition; a world holds 128.
    TooManyDoors(usize),
    /// The program does not fit the machine.
    TooLarge,
    /// The task has this many atoms; a minterm holds 128.
    TooManyAtoms(usize),
    /// The arena is a chain of lines, which encloses nothing.
    OpenArena,
    /// The robot fits nowhere, or nearly nowhere.
    NoFreeArea,
    /// A robot does not fit where this list of start lines, counted from zero, puts it: another than the acting one by its
    /// name.
    StartBlocked(usize, Option<Name>),
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoWorld => f.write_str("there is no world to run in"),
            Self::Declared(name) => write!(f, "`{name}` is declared only, so it cannot be run"),
            Self::NoScript(name) => write!(f, "the tree of the robot `{name}` cannot be run"),
            Self::TooManyDoors(n) => {
                write!(
                    f,
                    "a world holds 128 walls under a condition, this one has {n}"
                )
            }
            Self::TooLarge => TooLarge.fmt(f),
            Self::TooManyAtoms(n) => write!(f, "a minterm holds 128 atoms, the task has {n}"),
            Self::OpenArena => f.write_str("the arena is not an area"),
            Self::NoFreeArea => f.write_str("the robot fits nowhere in the arena"),
            Self::StartBlocked(_, None) => {
                f.write_str("the robot does not fit where it is to start")
            }
            Self::StartBlocked(_, Some(name)) => {
                write!(f, "the robot `{name}` does not fit where it is to start")
            }
        }
    }
}

impl std::error::Error for BuildError {}

impl From<TooLarge> for BuildError {
    fn from(TooLarge: TooLarge) -> Self {
        Self::TooLarge
    }
}
