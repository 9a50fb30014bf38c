//! What a Rust program does with btc: the types that the crate's root offers.
//!
//! They wrap the functions behind the commands and own what they were made from, so none has a lifetime.

pub(crate) mod disk;
mod error;
mod learned;
mod program;
mod table;
mod ticker;
mod trainer;
mod tree;

pub use error::Error;
pub use learned::Learned;
pub use program::Program;
pub use table::PolicyTable;
pub use ticker::{Robot, Ticker};
pub use trainer::{Trained, Trainer};
pub use tree::Tree;

pub use crate::driver::decanonicalize::Options as DecanonicaliseOptions;
pub use crate::driver::learn::{Options as LearnOptions, Shape};
pub use crate::driver::table::Format as TableFormat;
pub use crate::driver::verify::Proved;
pub use crate::emit::form::TreeForm;
pub use crate::environment::{Ended, Environment, Outcome};
pub use crate::grow::Choice;
pub use crate::ir::tree::Status;
pub use crate::learn::statistics::Mean;
pub use crate::random::Random;
pub use crate::report::episodes::Episodes;
pub use crate::report::verdict::Answer;
pub use crate::tree::Size;
