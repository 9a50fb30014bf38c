//! Integration tests, one binary.

mod naive;
mod snapshot;
mod tree;
