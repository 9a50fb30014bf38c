//! The laws that the fuzz targets hold, which are those of the tests.
#![allow(
    dead_code,
    clippy::all,
    reason = "what the tests alone need of these files is unused here"
)]

#[path = "../../tests/it/laws/mod.rs"]
pub mod laws;
