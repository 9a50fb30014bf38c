//! The tests that see the crate as its users do.

mod syntax;
mod syntax_print;
mod syntax_total;
