//! The world: its code, its geometry, its sensors and what one tick does.
mod eval;
mod geometry;
mod motion;
mod random;
mod remembered;
mod sensing;
mod ticks;
