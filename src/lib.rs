//! `btc` compiles behaviour trees that robots learn by themselves: a `.bt` file is checked, simulated, learned
//! from, and the learned policy is printed as the tree that a person would have written, proved equal to it.
//!
//! The modules stand in the order in which a program goes through them; see `ARCHITECTURE.md`.

pub mod diagnostic;
pub mod emit;
pub mod ir;
pub mod logic;
pub mod math;
pub mod policy;
pub mod source;
pub mod syntax;
pub mod tree;
