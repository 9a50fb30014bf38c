//! What btc writes, one file per form.

pub mod bt;
pub mod dot;
pub mod ir;
pub mod json;
