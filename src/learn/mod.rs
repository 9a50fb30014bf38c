//! From a decision process to a policy: tabular learning, roll-outs, evaluation.
//!
//! The room knows the world through [`process::Process`] alone.

pub mod curve;
pub mod evaluation;
pub mod process;
pub mod q_learning;
pub mod rollout;
pub mod schedule;
pub mod statistics;
pub mod table;
