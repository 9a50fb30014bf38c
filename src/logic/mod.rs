//! Two-level logic: cubes, covers, and the smallest cover that holds on some rows of a table and on none of others.
//!
//! A table holds minterms transposed, a column of bits per atom. Rows that are neither in the ON set nor in the OFF
//! set are free; so is every minterm that has no row. Don't-cares are never built.

pub mod bits;
pub mod columns;
pub mod covering;
pub mod cube;
pub mod minimise;
pub mod primes;

pub use bits::Bits;
pub use columns::Columns;
pub use cube::{Cover, Cube, Literal};
pub use minimise::minimise;
