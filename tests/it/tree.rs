//! Trees from policies, and what is proved of them.

mod proofs;
mod random;
mod small_delivery;
mod walk;
