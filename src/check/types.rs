//! Types, and the values that expressions have while they are checked.

pub mod units;
pub mod written;

use super::types::units::Dim;
use crate::geometry;
use crate::ir::Id;
use crate::ir::expr::ExprId;
use crate::ir::law::Behavior;
use crate::ir::world::{Place, Robot, Sensor, Wall};
use crate::source::Span;
use std::fmt;

/// A type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Type {
    /// The type of an expression that was reported; it fits every type.
    Error,
    /// `bool`
    Bool,
    /// A quantity.
    Quantity(Dim),
    /// A plain number, shown in `%`.
    Ratio,
    /// `point`
    Point,
    /// An enum, by name.
    Enum(String),
    /// A place, perhaps of a kind.
    Place(Option<String>),
    /// A wall, perhaps of a kind.
    Wall(Option<String>),
    /// `robot`
    Robot,
    /// `sensor`
    Sensor,
    /// `target`: anything that is measured to.
    Target,
    /// `nowhere`, which may stand for any target that has a name.
    Nowhere,
    /// A behaviour.
    Behavior,
    /// A shape.
    Shape,
    /// How a behaviour ended: what a `history` line takes.
    Termination,
    /// `anywhere`
    Anywhere,
}

impl Type {
    /// A plain number.
    pub const NUMBER: Type = Type::Quantity(Dim::NONE);
    /// A length.
    pub const LENGTH: Type = Type::Quantity(Dim::LENGTH);
    /// A time.
    pub const TIME: Type = Type::Quantity(Dim::TIME);
    /// An angle.
    pub const ANGLE: Type = Type::Quantity(Dim::ANGLE);
    /// A speed.
    pub const SPEED: Type = Type::Quantity(Dim::SPEED);
    /// A turn rate.
    pub const TURN_RATE: Type = Type::Quantity(Dim::TURN_RATE);
    /// A frequency.
    pub const FREQUENCY: Type = Type::Quantity(Dim::FREQUENCY);

    /// The dimension of a number of any kind.
    pub fn dim(&self) -> Option<Dim> {
        match self {
            Type::Quantity(dim) => Some(*dim),
            Type::Ratio => Some(Dim::NONE),
            _ => None,
        }
    }

    /// Whether something can be measured to it.
    pub fn is_target(&self) -> bool {
        matches!(self, Type::Point | Type::Target | Type::Nowhere) || self.is_named_target()
    }

    /// Whether it is a target that has a name.
    pub fn is_named_target(&self) -> bool {
        matches!(
            self,
            Type::Place(_) | Type::Wall(_) | Type::Robot | Type::Sensor
        )
    }

    /// The type of what may be a value of either type.
    pub fn join(&self, other: &Type) -> Option<Type> {
        match (self, other) {
            _ if other.fits(self) => Some(self.clone()),
            _ if self.fits(other) => Some(other.clone()),
            (Type::Place(_), Type::Place(_)) => Some(Type::Place(None)),
            (Type::Wall(_), Type::Wall(_)) => Some(Type::Wall(None)),
            _ => None,
        }
    }

    /// Whether a value of this type may stand where `wanted` is asked for.
    pub fn fits(&self, wanted: &Type) -> bool {
        match (self, wanted) {
            (Type::Error, _) | (_, Type::Error) => true,
            (Type::Place(_), Type::Place(None)) | (Type::Wall(_), Type::Wall(None)) => true,
            (_, Type::Target) => self.is_target(),
            (Type::Nowhere, _) => wanted.is_named_target() || *wanted == Type::Nowhere,
            _ => match (self.dim(), wanted.dim()) {
                (Some(a), Some(b)) => a == b,
                _ => self == wanted,
            },
        }
    }
}

impl fmt::Display for Type {
    /// The type as a person names it, with its article.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Type::Error => f.write_str("something unknown"),
            Type::Bool => f.write_str("a truth value (bool)"),
            Type::Quantity(dim) => dim.fmt(f),
            Type::Ratio => f.write_str("a ratio (%)"),
            Type::Point => f.write_str("a point"),
            Type::Enum(name) => write!(f, "a value of the enum `{name}`"),
            Type::Place(None) => f.write_str("a place"),
            Type::Place(Some(kind)) => write!(f, "a place of kind `{kind}`"),
            Type::Wall(None) => f.write_str("a wall"),
            Type::Wall(Some(kind)) => write!(f, "a wall of kind `{kind}`"),
            Type::Robot => f.write_str("a robot"),
            Type::Sensor => f.write_str("a sensor"),
            Type::Target => f.write_str("a target"),
            Type::Nowhere => f.write_str("the word `nowhere`"),
            Type::Behavior => f.write_str("a behaviour"),
            Type::Shape => f.write_str("a shape"),
            Type::Termination => f.write_str("the end of a behaviour"),
            Type::Anywhere => f.write_str("the word `anywhere`"),
        }
    }
}

/// The value of a checked expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// Known by its type only: a parameter of a body that is checked for itself, or something that was reported.
    Unknown,
    /// A number, a truth value, an enum's variant or a termination's code.
    Scalar(ExprId),
    /// A point.
    Point(ExprId, ExprId),
    /// A place.
    Place(Id<Place>),
    /// A wall.
    Wall(Id<Wall>),
    /// The nearest wall.
    NearestWall,
    /// A robot, by its place among all robots.
    Robot(Id<Robot>),
    /// A sensor.
    Sensor(Id<Sensor>),
    /// No target at all.
    Nowhere,
    /// A target that is chosen while the program runs: its code, and what it may be.
    Chosen(ExprId, Vec<Value>),
    /// A behaviour.
    Behavior(Id<Behavior>),
    /// A shape.
    Shape(geometry::Shape),
    /// `anywhere`
    Anywhere,
}

/// A checked expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Typed {
    /// Its type.
    pub ty: Type,
    /// Its value.
    pub value: Value,
    /// Where it stands.
    pub span: Span,
}

impl Value {
    /// The numbers that it is made of: one of a scalar, two of a point, none of anything else.
    pub fn parts(&self) -> Vec<ExprId> {
        match *self {
            Value::Scalar(id) => vec![id],
            Value::Point(x, y) => vec![x, y],
            _ => Vec::new(),
        }
    }

    /// The scalar or the point that is made of these numbers.
    pub fn of_parts(parts: &[ExprId]) -> Self {
        match *parts {
            [id] => Value::Scalar(id),
            [x, y] => Value::Point(x, y),
            _ => Value::Unknown,
        }
    }

    /// The value with each of its numbers replaced.
    #[must_use]
    pub fn map(self, mut replaced: impl FnMut(ExprId) -> ExprId) -> Self {
        match self {
            Value::Scalar(id) => Value::Scalar(replaced(id)),
            Value::Point(x, y) => Value::Point(replaced(x), replaced(y)),
            Value::Chosen(code, of) => Value::Chosen(replaced(code), of),
            other => other,
        }
    }
}

impl From<Option<Value>> for Value {
    fn from(known: Option<Value>) -> Self {
        known.unwrap_or(Value::Unknown)
    }
}

impl From<Option<ExprId>> for Value {
    fn from(known: Option<ExprId>) -> Self {
        known.map_or(Value::Unknown, Value::Scalar)
    }
}

impl Typed {
    /// An expression at `span`.
    pub fn new(ty: Type, value: impl Into<Value>, span: Span) -> Self {
        Self {
            ty,
            value: value.into(),
            span,
        }
    }

    /// An expression that is known by its type only.
    pub fn unknown(ty: Type, span: Span) -> Self {
        Self::new(ty, Value::Unknown, span)
    }

    /// An expression that has been reported.
    pub fn error(span: Span) -> Self {
        Self::unknown(Type::Error, span)
    }

    /// The scalar that it is, if it is one and known.
    pub fn scalar(&self) -> Option<ExprId> {
        match self.value {
            Value::Scalar(id) => Some(id),
            _ => None,
        }
    }
}
