//! Minimisation, seen from outside.

#[path = "logic/lists.rs"]
mod lists;
#[path = "planted.rs"]
pub(crate) mod planted;
