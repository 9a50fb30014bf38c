//! Tables whose columns hold numbers and words, column by column.
//!
//! Every value of a column has a code: its place among the column's values, numbers in ascending order. A [`Comparison`] asks for
//! one input whether it is at most a number, or has a value; [`compared`](Valued::compared) chooses as many as it takes to
//! tell apart the rows that do different things, and [`table`](Valued::table) gives the rows over them.

mod boxes;
mod builder;
mod cart;
mod coded;
mod cuts;
mod decimal;
mod name;
mod ordered;
mod rows;

pub use builder::Builder;
pub use cuts::{Asks, Comparison};
pub use decimal::Decimal;
pub use rows::{Columns, Holds, Test};

use super::names::AtomName;
use super::table::Behaviors;
use crate::ir::input::Measure;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// The code of a cell that leaves its input open.
pub const OPEN: u32 = u32::MAX;

/// A table whose columns hold values. Nothing is known yet of whether its rows contradict each other.
#[derive(Clone, Debug)]
pub struct Valued {
    /// The columns that say in what state a row is.
    pub columns: Vec<Column>,
    /// The place of the header, or of what stands for one.
    pub header: Range<usize>,
    pub(super) behaviors: Behaviors,
    /// What is done in each row: a behaviour, or a set of some.
    pub(super) decided: Vec<u32>,
    /// Empty where the table does not say.
    visits: Vec<u64>,
    places: Vec<Range<u32>>,
}

/// A column.
#[derive(Clone, Debug)]
pub struct Column {
    /// Its name, without its kind.
    pub name: String,
    /// The place of its name.
    pub place: Range<usize>,
    /// What its cells hold.
    pub kind: Kind,
    /// The code of each row's cell, [`OPEN`] where it is left open.
    pub codes: Vec<u32>,
    /// The numbers of rows that are written otherwise than the number of their code, which is the same in 64 bits.
    pub(super) rounded: FxHashMap<usize, Decimal>,
}

/// What the cells of a column hold.
#[derive(Clone, Debug)]
pub enum Kind {
    /// 0 or 1.
    Truth(AtomName),
    /// A number in a unit: all that appear, ascending, as they are written and in SI base units.
    Number(Measure, Vec<(Decimal, f64)>),
    /// One of these values.
    Category(Vec<String>),
}

impl Kind {
    /// How many codes there are.
    pub fn values(&self) -> usize {
        match self {
            Self::Truth(_) => 2,
            Self::Number(_, values) => values.len(),
            Self::Category(values) => values.len(),
        }
    }
}

impl Valued {
    /// How many rows it has.
    pub fn len(&self) -> usize {
        self.decided.len()
    }

    /// Whether it has no rows; one that was read has some.
    pub fn is_empty(&self) -> bool {
        self.decided.is_empty()
    }

    /// The names of its behaviours.
    pub fn behaviors(&self) -> impl Iterator<Item = &str> {
        self.behaviors.names.iter().map(|(name, _)| name.as_str())
    }

    /// The behaviours that a row allows, by their numbers.
    pub fn allowed(&self, row: usize) -> &[u32] {
        let at = self.decided.get(row..).and_then(|rest| rest.first());
        at.map_or(&[], |number| self.behaviors.all(number))
    }

    /// Whether all of these rows allow one behaviour.
    fn agree(&self, rows: &[u32]) -> bool {
        let mut rows = rows.iter().map(|row| self.allowed(*row as usize));
        let Some(first) = rows.next() else {
            return true;
        };
        let all = first.iter();
        let mut all = all.filter(|behavior| rows.clone().all(|row| row.contains(behavior)));
        all.next().is_some()
    }

    /// The inputs: the columns that hold more than 0 and 1, by their numbers.
    pub fn inputs(&self) -> impl Iterator<Item = (usize, &Column)> {
        let columns = self.columns.iter().enumerate();
        columns.filter(|(_, column)| !matches!(column.kind, Kind::Truth(_)))
    }
}
