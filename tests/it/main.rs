//! The tests that see the crate as its users do.

mod house;
mod naive;
mod snapshot;
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
mod tree;
mod world_delivery;
mod world_eval;
mod world_geometry;
mod world_motion;
mod world_random;
mod world_sensing;
mod world_ticks;
