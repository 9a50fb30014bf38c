//! `btc` compiles behaviour trees that robots learn by themselves: a `.bt` file is checked, simulated, learned
//! from, and the learned policy is printed as the tree that a person would have written, proved equal to it.
//!
//! The modules stand in the order in which a program goes through them; see `ARCHITECTURE.md`.

pub mod source;

pub mod diagnostic;

pub mod spelling;

pub mod syntax;

pub mod check;

pub mod ir;

pub mod math;

pub mod random;

pub mod geometry;

pub mod eval;

pub mod world;

pub mod learn;

pub mod policy;

pub mod logic;

pub mod tree;

pub mod trial;

pub mod simplify;

pub mod emit;

pub mod report;

pub mod driver;

#[cfg(feature = "cli")]
pub mod cli;
