//! Minimisation, seen from outside.

#[path = "logic/lists.rs"]
mod lists;
#[path = "planted.rs"]
mod planted;
