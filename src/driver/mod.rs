//! The commands as functions from texts to results, a file each: nothing here prints or touches a file.
//!
//! [`load`], [`table`] and [`target`] read what a command is given; [`Refused`] is why it has no result.

mod allowed;
pub mod canonicalize;
pub mod check;
pub mod compile;
pub mod decanonicalize;
pub mod diff;
pub mod digest;
pub mod environment;
pub mod explain;
pub mod export;
pub mod format;
pub mod inputs;
pub mod learn;
pub mod load;
pub mod minimize;
pub mod new;
mod nodes;
pub mod picture;
mod record;
mod refused;
pub mod run;
pub mod size;
pub mod snapshot;
pub mod suggest;
pub mod table;
pub mod target;
pub mod test;
mod text;
pub mod trace;
pub mod tune;
pub mod verify;
mod world;

pub use refused::Refused;
pub use text::Text;
