//! Trees from policies, and what is proved of them.
mod canonical;
mod chains;
mod cubes;
mod drawn;
mod equivalence;
mod files;
mod guards;
mod optimum;
mod permuted;
mod proofs;
mod random;
mod returning;
mod scale;
mod seen;
mod small_delivery;
mod ticks;
mod walk;
