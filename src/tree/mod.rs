//! Behaviour trees: how they tick, how large they are, to canonical form and back, and when two of them are equal.

mod answers;
pub mod atoms;
pub mod batch;
pub mod canonicalise;
pub mod change;
mod circuit;
mod compiled;
pub mod cube;
pub mod decanonicalise;
pub mod disagreement;
pub mod drawing;
pub mod equivalence;
pub mod guard;
pub mod permute;
pub mod prove;
pub mod prune;
pub mod reading;
pub mod size;
pub mod tick;
pub mod unit;

pub use decanonicalise::decanonicalise;
pub use equivalence::compare;
pub use size::Size;
pub use tick::Runner;
