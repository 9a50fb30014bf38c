//! Trees from policies, and what is proved of them.

mod build;
mod canonical;
mod chains;
mod cubes;
mod drawn;
mod files;
mod guards;
mod proofs;
mod random;
mod scale;
mod small_delivery;
mod ticks;
mod walk;
