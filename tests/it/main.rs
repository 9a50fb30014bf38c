//! The tests that see the crate as its users do.
#![allow(
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test that meets the unexpected has failed"
)]

mod house;
mod naive;
mod simplify;
mod snapshot;
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
