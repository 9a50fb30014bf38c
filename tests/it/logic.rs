//! Minimisation, seen from outside.

mod espresso;
mod lists;
mod minimize;
mod random;
