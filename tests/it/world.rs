//! The world: its code, its geometry, its sensors and what one tick does.
pub(crate) mod delivery;
mod eval;
pub(crate) mod geometry;
mod motion;
mod random;
mod sensing;
pub(crate) mod ticks;
