//! The renderers of diagnostics, one file each.

mod human;
mod json;

pub use human::human;
pub use json::json;
