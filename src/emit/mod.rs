//! What a program or a tree is written as: one file per form.

pub mod ast;
pub mod bt;
pub mod btcpp;
mod calls;
pub mod dot;
pub mod form;
pub mod history;
pub mod ir;
pub mod json;
mod leaves;
mod notes;
pub mod py_trees;
pub mod refusal;
pub mod steps;
pub mod svg;
mod xml;
