//! What a program or a tree is written as: one file per form.

pub mod dot;
pub mod json;
