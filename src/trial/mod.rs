//! Trees and policies at work in the world of a task, on seeds that several of them may share.
//!
//! [`play`] plays episodes under a tree or a policy, [`reached`] counts what the nodes of a tree answer in them, [`learned`]
//! measures a learned tree, [`claim`] tests claims on events, until [`anytime`] says enough. [`paired`] compares trees on common seeds; what they do alike there is not played twice,
//! see [`trace`]; what their decisions led to is noted, see [`decisions`]. [`mod@test`] ticks a tree without a world. [`duel`] does so for two trees in different worlds.

pub mod anytime;
pub mod claim;
pub mod decisions;
pub mod duel;
pub mod learned;
pub mod paired;
pub mod play;
pub mod reached;
pub mod test;
pub mod trace;

pub use play::Unplayable;
