//! The tests that see the crate as its users do.

mod naive;
mod snapshot;
mod syntax;
mod tree;
mod world_delivery;
mod world_ticks;
