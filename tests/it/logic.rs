//! Minimisation, seen from outside.

mod covers;
mod espresso;
mod lists;
mod minimize;
mod random;
