//! From a decision process to a policy: tabular learning, roll-outs, evaluation.
//!
//! What learns knows the world through [`process::Process`] alone; [`simulated`] is its one implementation over the
//! simulator. [`train`] goes through the episodes, a [`method::Method`] learns from them.

pub mod agreement;
pub mod apart;
pub mod average;
pub mod binomial;
pub mod bootstrap;
pub mod curve;
pub mod discount;
pub mod double_q;
mod elect;
pub mod episode;
pub mod experiment;
pub mod extract;
pub mod greedy;
pub mod improve;
pub mod method;
pub mod model;
pub mod on_policy;
pub mod poisson;
pub mod process;
pub mod q_learning;
pub mod q_table;
pub mod rate;
pub mod record;
pub mod rollout;
pub mod run;
pub mod schedule;
pub mod simulated;
pub mod solve;
pub mod statistics;
pub mod train;
