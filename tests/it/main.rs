//! The tests that see the crate as its users do.

mod syntax;
mod world_delivery;
mod world_ticks;
