//! Two-level logic: cubes, covers, and the smallest cover that holds on some rows of a table and on none of others.
//!
//! A table holds its rows transposed, one column of bits per atom. Rows that are neither in the ON set nor in the OFF set
//! are free, and so is every minterm of no row: the don't-care set is never built.

pub mod account;
mod alive;
pub mod bits;
pub mod columns;
pub mod complement;
pub mod covering;
pub mod cube;
pub mod impurity;
pub mod list;
pub mod minimise;
pub mod minterm;
pub mod packed;
pub mod partition;
pub mod pla;
pub mod random;
mod transpose;

pub use account::Account;
pub use bits::Bits;
pub use columns::Columns;
pub use cube::{Cover, Cube, Literal};
pub use list::{Order, list, list_within};
pub use minimise::{Effort, Solution, minimise, minimise_with, minimise_within};
pub use minterm::Minterm;
