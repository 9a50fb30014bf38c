//! One binary for all integration tests; a test is a file of its own.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test fails where it goes wrong"
)]

mod world_delivery;
mod world_eval;
mod world_geometry;
mod world_motion;
mod world_random;
mod world_sensing;
mod world_ticks;
