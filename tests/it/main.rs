//! The tests that see the crate as its users do.

mod house;
mod naive;
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
