//! What each command does, as functions from text to results: nothing is printed, no file is touched.

pub mod canonicalize;
pub mod check;
pub mod compile;
pub mod decanonicalize;
pub mod explain;
pub mod export;
pub mod format;
pub mod learn;
pub mod load;
pub mod minimize;
pub mod picture;
pub mod run;
pub mod simplify;
pub mod size;
pub mod table;
pub mod target;
pub mod verify;
