//! The tests that see the crate as its users do.

mod syntax;
