//! The tests that see the crate as its users do.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test ends where it fails"
)]

mod syntax;
mod syntax_print;
mod syntax_total;
