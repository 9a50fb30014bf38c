//! What can be wrong with a PLA.

use std::fmt;
use std::ops::Range;

/// A mistake in the text of a PLA.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PlaError {
    /// Where, in bytes.
    pub span: Range<usize>,
    /// What.
    pub kind: PlaErrorKind,
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PlaErrorKind {
    /// A keyword that is not known, or not served.
    Keyword(String),
    /// A keyword that needs a number.
    Number(String),
    /// More inputs or outputs than there may be.
    Many(String, u32),
    /// A size that was given before.
    Again(String),
    /// Outputs that are to be complemented.
    Phase,
    /// A keyword of inputs with several values.
    Valued(String),
    /// A type that there is not.
    Type(String),
    /// Names that are not as many as there are columns.
    Names {
        /// Columns.
        wanted: usize,
        /// Names.
        found: usize,
    },
    /// A row that has more or fewer characters than there are columns.
    Width {
        /// Columns.
        wanted: usize,
        /// Characters.
        found: usize,
    },
    /// A character that has no meaning in a row.
    Character(char),
    /// `.i` or `.o` is missing before what needs it.
    Size,
}

impl fmt::Display for PlaErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Keyword(word) => write!(f, "`{word}` is not known here"),
            Self::Number(word) => write!(f, "`{word}` needs a number"),
            Self::Many(word, most) => write!(f, "`{word}` is at most {most}"),
            Self::Again(word) => write!(f, "`{word}` was given before"),
            Self::Phase => write!(f, "outputs are minimised as they are, not complemented"),
            Self::Valued(word) => {
                write!(
                    f,
                    "`{word}` is for inputs of several values; here each is 0 or 1"
                )
            }
            Self::Type(word) => write!(f, "there is no type `{word}`"),
            Self::Names { wanted, found } => {
                write!(f, "{found} names for {wanted} columns")
            }
            Self::Width { wanted, found } => {
                write!(f, "{found} characters for {wanted} columns")
            }
            Self::Character(c) => write!(f, "`{}` has no meaning here", c.escape_debug()),
            Self::Size => write!(f, "the numbers of inputs and outputs are not known yet"),
        }
    }
}
