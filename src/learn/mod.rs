//! From a decision process to a policy: tabular learning, roll-outs, evaluation.
//!
//! What learns knows the world through [`process::Process`] alone; [`simulated`] is its one implementation over the
//! simulator.

pub mod curve;
pub mod episode;
pub mod extract;
pub mod process;
pub mod q_learning;
pub mod rollout;
pub mod schedule;
pub mod simulated;
pub mod statistics;
pub mod table;
