//! Worlds and robots.

use crate::source::Span;
use crate::syntax::ast::{Expr, Ident};

/// `world name { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// Its name.
    pub name: Ident,
    /// Places, walls, robots and fields, in their order.
    pub entries: Vec<WorldEntry>,
}

/// An entry of a world.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldEntry {
    /// The `///` lines before it.
    pub docs: Vec<String>,
    /// What it is.
    pub kind: WorldEntryKind,
    /// Without its documentation.
    pub span: Span,
}

/// The kinds of world entries.
#[derive(Clone, Debug, PartialEq)]
pub enum WorldEntryKind {
    /// `place name: kind = shape facing angle`
    Place {
        /// Its name.
        name: Ident,
        /// The kind that families range over.
        of_kind: Option<Ident>,
        /// The shape.
        shape: Expr,
        /// The direction in which a robot stands here.
        facing: Option<Expr>,
    },
    /// `wall name: kind = shape when condition`
    Wall {
        /// Its name.
        name: Ident,
        /// The kind that families range over.
        of_kind: Option<Ident>,
        /// The shape.
        shape: Expr,
        /// The condition under which it stands.
        when: Option<Expr>,
    },
    /// `robot name { … }`
    Robot {
        /// Its name.
        name: Ident,
        /// Sensors and fields.
        entries: Vec<RobotEntry>,
    },
    /// `tick = …`, `arena = …`
    Field(Field),
    /// Not understood, and reported.
    Error,
}

impl WorldEntryKind {
    /// The kind of a place or a wall.
    pub fn of_kind(&self) -> Option<&Ident> {
        match self {
            Self::Place { of_kind, .. } | Self::Wall { of_kind, .. } => of_kind.as_ref(),
            _ => None,
        }
    }
}

/// An entry of a robot.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotEntry {
    /// The `///` lines before it.
    pub docs: Vec<String>,
    /// What it is.
    pub kind: RobotEntryKind,
    /// Without its documentation.
    pub span: Span,
}

/// The kinds of robot entries.
#[derive(Clone, Debug, PartialEq)]
pub enum RobotEntryKind {
    /// `sensor name = scanner(…)`
    Sensor {
        /// Its name.
        name: Ident,
        /// What it is.
        value: Expr,
    },
    /// `body = …`, `drive = …`, `contact = …`, `runs = …`
    Field(Field),
    /// Not understood, and reported.
    Error,
}

/// `name = expr`
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its name.
    pub name: Ident,
    /// Its value.
    pub value: Expr,
}
