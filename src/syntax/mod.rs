//! Text to syntax tree and back.

pub mod ast;
mod brackets;
mod build;
mod comments;
mod conflicts;
mod diagnose;
mod expected;
mod follow_ups;
mod glance;
mod grammar;
mod nesting;
mod parens;
mod parse;
pub mod print;
mod reparse;
pub mod tokens;
pub mod words;

pub use build::unit;
pub use parse::{Memory, parse};
