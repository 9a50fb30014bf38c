//! Trees from policies, and what is proved of them.

mod drawn;
mod files;
mod guards;
mod proofs;
mod random;
mod small_delivery;
mod tmp;
mod walk;
