//! What is written on disk: single files whole or not at all, results of several files as one.
//!
//! Everything goes through a [`Disk`], so that the tests can let each of its calls fail.

pub mod checkpoint;
pub mod disk;
pub mod file;
pub mod folder;
pub mod manifest;
pub mod project;
mod stale;

pub use checkpoint::Checkpoint;
pub use disk::{Disk, System};
pub use folder::Folder;
