//! The world: geometry, kinematics, sensors, and what one tick does.
//!
//! A [`Simulator`] is a program's world compiled for one task; it is shared between threads. A [`Simulation`] is one
//! run of it: [`Simulation::start`] begins an episode, and each tick is [`Simulation::begin_tick`],
//! [`Simulation::act`], [`Simulation::end_tick`], so that a tree or a learner can sit on top without the world knowing
//! either.
//!
//! Lengths are in metres, angles in radians counter-clockwise from the x axis, times in seconds.

mod atoms;
mod body;
mod build;
mod compiled;
mod door;
mod ending;
mod error;
mod gaps;
mod heat;
mod history;
mod motion;
mod onward;
mod others;
mod pose;
mod scene;
mod script;
mod sensing;
mod sight;
mod simulation;
mod start;

pub use build::Simulator;
pub use error::BuildError;
pub use motion::{Command, Motion};
pub use onward::Gone;
pub use pose::Pose;
pub use scene::Scene;
pub use simulation::{End, Simulation, Tick};
pub use start::Start;
