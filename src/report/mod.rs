//! Results in words, and the same figures as JSON documents.

pub mod coverage;
pub mod curve;
pub mod decanonicalised;
pub mod difference;
pub mod ends;
pub mod episodes;
pub mod grown;
pub mod headline;
mod json;
pub mod learned;
pub mod metrics;
pub mod program;
pub mod results;
pub mod suggested;
pub mod tested;
pub mod trace;
pub mod tuned;
pub mod value;
pub mod verdict;
pub mod words;
