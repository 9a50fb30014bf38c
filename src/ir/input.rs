//! Inputs: what is known from outside where no world is simulated.

use super::Name;
use super::dimension::Dim;
use super::expr::{Expr, ExprId, Pool};
use super::table::Id;
use super::tunable::Unit;

/// A value that is known from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Its name.
    pub name: Name,
    /// What it may be.
    pub kind: InputKind,
}

/// What an input may be.
#[derive(Clone, Debug, PartialEq)]
pub enum InputKind {
    /// A number of this dimension in SI base units; `ratio` if it is shown in `%`.
    Number {
        /// Its dimension.
        dim: Dim,
        /// Whether it is a ratio.
        ratio: bool,
    },
    /// One of these values; its number is the position.
    Category(Vec<Name>),
}

/// The unit of numbers in a text, with its dimension.
#[derive(Clone, Debug, PartialEq)]
pub struct Measure {
    /// The unit; without a spelling for plain numbers.
    pub unit: Unit,
    /// Its dimension.
    pub dim: Dim,
}

impl Measure {
    /// Plain numbers.
    pub fn plain() -> Self {
        Self {
            unit: Unit {
                text: String::new(),
                times: 1.0,
                over: 1.0,
            },
            dim: Dim::NONE,
        }
    }

    /// The kind of an input of this unit.
    pub fn kind(&self) -> InputKind {
        InputKind::Number {
            dim: self.dim,
            ratio: self.unit.text == "%",
        }
    }
}

/// The value of an expression over inputs alone; `None` if it reads anything else. Truth values are 0 and 1.
pub fn value(pool: &Pool, id: ExprId, of: &impl Fn(Id<Input>) -> f64) -> Option<f64> {
    let sub = |id| value(pool, id, of);
    Some(match pool.get(id) {
        Expr::Num(number) => number,
        Expr::Bool(truth) => f64::from(truth),
        Expr::Input(input) => of(input),
        Expr::Unary(op, a) => op.apply(sub(a)?),
        Expr::Binary(op, a, b) => op.apply(sub(a)?, sub(b)?),
        Expr::Select(condition, then, otherwise) => match sub(condition)? {
            0.0 => sub(otherwise)?,
            _ => sub(then)?,
        },
        _ => return None,
    })
}
