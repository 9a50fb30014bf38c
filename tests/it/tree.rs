//! Trees from policies, and what is proved of them.

pub(crate) mod build;
mod canonical;
mod drawn;
mod equivalence;
mod files;
mod grown;
mod guards;
mod permuted;
mod proofs;
pub(crate) mod random;
mod small_delivery;
mod ticks;
mod walk;
