//! The tests that see the crate as its users do.
#![allow(
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test that meets the unexpected has failed"
)]

mod book;
mod changes;
mod check;
mod checking;
mod claims;
mod cli;
mod command;
mod corpus;
mod dependencies;
mod edits;
mod environment;
mod examples;
mod explain;
mod export;
mod functions;
mod grow;
mod house;
mod invented;
mod laws;
mod learn;
mod limits;
mod logic;
mod lsp;
mod meaning;
mod planted;
mod plausible;
mod program;
mod reference;
mod refused;
mod results;
mod robust;
mod run;
mod scaling;
mod slips;
mod snapshot;
mod suggest;
mod svg;
mod syntax;
mod tables;
mod tested;
mod tree;
mod tune;
mod verdicts;
mod verified;
mod world;
mod worlds;
