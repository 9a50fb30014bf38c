//! What is wrong with a table.

use std::fmt;
use std::ops::Range;
use std::sync::Arc;

/// What is wrong with a table, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableError {
    /// The bytes of the text that it is about.
    pub span: Range<usize>,
    /// What is wrong.
    pub kind: TableErrorKind,
}

impl TableError {
    /// Whether the other error is about the same wrong value in another cell, which then counts here: it is one mistake in many
    /// rows.
    pub fn counts(&mut self, other: &Self) -> bool {
        let (
            TableErrorKind::NoValue {
                found,
                column,
                cells,
                ..
            },
            TableErrorKind::NoValue {
                found: again,
                column: of,
                ..
            },
        ) = (&mut self.kind, &other.kind)
        else {
            return false;
        };
        let same = found == again && column == of;
        *cells += usize::from(same);
        same
    }
}

/// What can be wrong with a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TableErrorKind {
    /// It is not comma-separated text, or a line is not a JSON object.
    Malformed(String),
    /// Bytes that are no characters (UTF-8).
    NoText,
    /// It has no rows.
    Empty,
    /// A row has another number of cells than the header.
    Ragged {
        /// Cells in the row.
        found: usize,
        /// Cells in the header.
        expected: usize,
    },
    /// A row does not say what the first one does.
    MissingKey(String),
    /// A row says what the first one does not.
    UnknownKey(String),
    /// A column names nothing that the program has.
    UnknownColumn(String),
    /// A column appears twice.
    RepeatedColumn(String),
    /// Two columns say what is done.
    SecondBehavior(String),
    /// A column that has to be there is not.
    MissingColumn {
        /// What it would be called.
        name: String,
        /// A column that is nearly called so.
        likely: Option<String>,
    },
    /// The columns are parted by this character, and not by commas.
    Separator(char),
    /// A column without a name.
    Nameless,
    /// A name that the language cannot write.
    UnusableName {
        /// The name.
        name: String,
        /// Why not.
        why: &'static str,
    },
    /// A behaviour is called as a predicate is.
    SharedName(String),
    /// A cell holds something else than it may.
    UnknownValue {
        /// What it holds.
        found: String,
        /// What it may hold.
        expected: &'static str,
    },
    /// A behaviour that the program does not have, or the policy cannot choose.
    UnknownBehavior(String),
    /// One minterm, two behaviours.
    Contradiction {
        /// The row that says otherwise.
        earlier: Range<usize>,
        /// What holds where both rows speak; `None` if they speak of the same minterms.
        overlap: Option<String>,
    },
    /// One state, two behaviours.
    Disagreement {
        /// The row that says otherwise.
        earlier: Range<usize>,
        /// Two numbers in these rows that are one in 64 bits.
        rounded: Option<[String; 2]>,
    },
    /// A minterm without a row among the decisions.
    Unseen,
    /// Rows that allow several behaviours where each has to have one.
    Several,
    /// A row that stands for too many minterms because of its `-`.
    Wide,
    /// A row that leaves open what this predicate asks.
    Open(String),
    /// Columns hold numbers or words and do not say so.
    Undeclared {
        /// The first of them.
        name: String,
        /// Whether it holds numbers.
        numbers: bool,
        /// The header that says so.
        header: String,
    },
    /// Behind the name of a column stands something that is no kind.
    UnknownKind {
        /// The name of the column.
        name: String,
        /// What stands behind it.
        found: String,
    },
    /// A unit that the language does not have.
    UnknownUnit(String),
    /// The list of a column's values has no end.
    OpenValues(String),
    /// A column may have none of some values.
    NoValues(String),
    /// A column may have a value twice.
    RepeatedValue(String),
    /// A cell has a value that its column may not have.
    NoValue {
        /// The value.
        found: String,
        /// The column.
        column: String,
        /// The values that it may have.
        values: Arc<[String]>,
        /// How many cells have it; the first of them is told.
        cells: usize,
    },
    /// A behaviour is called as an input is.
    SharedInput(String),
    /// Rows that differ in more numbers than are compared.
    Numerous {
        /// The comparisons that tell them apart.
        comparisons: usize,
        /// The most for so many rows.
        most: usize,
    },
    /// A policy of another tool does not say what a table needs.
    Foreign {
        /// What is wrong.
        message: String,
        /// What to do about it.
        help: Option<&'static str>,
    },
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.kind {
            TableErrorKind::Malformed(why) => write!(f, "this is not a table: {why}"),
            TableErrorKind::NoText => write!(f, "this is not text (UTF-8)"),
            TableErrorKind::Empty => write!(f, "the table has no rows"),
            TableErrorKind::Ragged { found, expected } => {
                let cells = if *found == 1 { "cell" } else { "cells" };
                write!(f, "this row has {found} {cells}, the header has {expected}")
            }
            TableErrorKind::MissingKey(name) => write!(f, "this row does not say `{name}`"),
            TableErrorKind::UnknownKey(name) => {
                write!(f, "the first row does not say `{name}`, this one does")
            }
            TableErrorKind::UnknownColumn(name) => write!(f, "unknown column `{name}`"),
            TableErrorKind::RepeatedColumn(name) => write!(f, "column `{name}` appears twice"),
            TableErrorKind::SecondBehavior(name) => {
                write!(f, "`{name}` is a second column that says what is done")
            }
            TableErrorKind::MissingColumn { name, .. } => write!(f, "column `{name}` is missing"),
            TableErrorKind::Separator('\t') => {
                write!(f, "columns are parted by commas, not by tabs")
            }
            TableErrorKind::Separator(other) => {
                write!(f, "columns are parted by commas, not by `{other}`")
            }
            TableErrorKind::Nameless => write!(f, "a column without a name"),
            TableErrorKind::UnusableName { name, why } if name.is_empty() => {
                write!(f, "a name is missing: {why}")
            }
            TableErrorKind::UnusableName { name, why } => {
                write!(f, "`{name}` cannot be a name: {why}")
            }
            TableErrorKind::SharedName(name) => {
                write!(f, "`{name}` is a predicate and a behaviour")
            }
            TableErrorKind::UnknownValue { found, expected } if found.is_empty() => {
                write!(f, "an empty cell is not {expected}")
            }
            TableErrorKind::UnknownValue { found, expected } => {
                write!(f, "`{found}` is not {expected}")
            }
            TableErrorKind::UnknownBehavior(name) => write!(f, "unknown behavior `{name}`"),
            TableErrorKind::Contradiction { overlap: None, .. } => {
                write!(f, "an earlier row does something else in this minterm")
            }
            TableErrorKind::Contradiction { .. } => {
                write!(
                    f,
                    "an earlier row does something else in a minterm of this one"
                )
            }
            TableErrorKind::Disagreement { .. } => {
                write!(f, "an earlier row does something else in the same state")
            }
            TableErrorKind::Unseen => write!(f, "no decision is known in this minterm"),
            TableErrorKind::Several => {
                write!(f, "a row allows several behaviours; here each has one")
            }
            TableErrorKind::Wide => write!(f, "this row stands for too many minterms"),
            TableErrorKind::Open(name) => {
                write!(f, "this row does not say whether `{name}` holds")
            }
            TableErrorKind::Undeclared { name, numbers, .. } => {
                let what = if *numbers { "numbers" } else { "words" };
                write!(f, "`{name}` holds {what}, and the header does not say so")
            }
            TableErrorKind::UnknownKind { name, found } if found.is_empty() => {
                write!(f, "`{name}:` has no kind behind it")
            }
            TableErrorKind::UnknownKind { name, found } => {
                write!(f, "`{found}` is not a kind of column, as `{name}` would be")
            }
            TableErrorKind::UnknownUnit(unit) => write!(f, "`{unit}` is not a unit"),
            TableErrorKind::OpenValues(name) => {
                write!(f, "the values of `{name}` are not closed")
            }
            TableErrorKind::NoValues(name) => write!(f, "`{name}` has no values"),
            TableErrorKind::RepeatedValue(value) => write!(f, "the value `{value}` stands twice"),
            TableErrorKind::NoValue { found, column, .. } if found.is_empty() => {
                write!(f, "an empty cell is no value of `{column}`")
            }
            TableErrorKind::NoValue { found, column, .. } => {
                write!(f, "`{found}` is no value of `{column}`")
            }
            TableErrorKind::SharedInput(name) => write!(f, "`{name}` is an input and a behaviour"),
            TableErrorKind::Numerous { comparisons, most } => write!(
                f,
                "{comparisons} comparisons tell these rows apart, and {most} are the most for so many rows"
            ),
            TableErrorKind::Foreign { message, .. } => f.write_str(message),
        }
    }
}

impl std::error::Error for TableError {}
