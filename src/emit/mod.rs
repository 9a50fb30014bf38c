//! What a program or a tree is written as: one file per form.

pub mod ast;
pub mod bt;
pub mod dot;
pub mod ir;
pub mod json;
pub mod svg;
