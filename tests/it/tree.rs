//! Trees from policies, and what is proved of them.
pub(crate) mod build;
pub(crate) mod random;

mod canonical;
mod chains;
mod cubes;
mod drawn;
mod equivalence;
mod files;
mod grown;
mod guards;
mod optimum;
mod permuted;
mod proofs;
mod returning;
mod scale;
mod seen;
mod small_delivery;
mod ticks;
mod walk;
