//! The tests that see the crate as its users do.

mod house;
mod naive;
mod snapshot;
mod syntax;
mod syntax_print;
mod syntax_total;
mod tree;
mod world_delivery;
mod world_ticks;
