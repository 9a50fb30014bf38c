//! The renderers of diagnostics, one file each.

mod excerpt;
mod human;
mod json;
mod sarif;
mod short;
mod visible;

pub use human::human;
pub use json::json;
pub use sarif::sarif;
pub use short::{github, short};
pub use visible::{hidden, on_one_line, visible};
