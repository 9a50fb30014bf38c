//! The checked program: names resolved, units gone to SI, families and subtrees unrolled.
//!
//! The IR knows neither syntax nor files. Every number is an `f64` in SI base units (m, s, rad), a `bool` is 0 or 1,
//! an enum its variant's index; every reference is a typed id.

pub mod dimension;
pub mod expr;
pub mod history;
pub mod input;
pub mod law;
pub mod name;
pub(crate) mod operator;
pub mod program;
pub mod table;
pub mod task;
pub mod test;
pub mod tree;
pub mod tunable;
pub mod world;

pub use expr::{Expr, ExprId, Pool};
pub use name::Name;
pub use program::Program;
pub use table::{Id, Table};
