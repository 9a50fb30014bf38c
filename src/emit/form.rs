//! The forms that trees are written in: the one list, and what writes each.

use super::refusal::Refusal;
use super::steps::Steps;
use super::{bt, btcpp, dot, history, json, py_trees, svg};
use crate::ir::Program;
use crate::ir::tree::Tree;

/// A form that a tree is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum TreeForm {
    /// The language, laid out.
    Bt,
    /// Graphviz.
    Dot,
    /// JSON.
    Json,
    /// A picture.
    Svg,
    /// XML for BehaviorTree.CPP 4, Groot2 and Nav2.
    #[cfg_attr(feature = "cli", value(name = "btcpp"))]
    BtCpp,
    /// A header for C++: the history that the tree asks in BehaviorTree.CPP 4.
    #[cfg_attr(feature = "cli", value(name = "btcpp_history"))]
    BtCppHistory,
    /// A Python module for py_trees 2.
    #[cfg_attr(feature = "cli", value(name = "py_trees"))]
    PyTrees,
}

impl TreeForm {
    /// Whether a robot's library reads it.
    pub fn is_for_robots(self) -> bool {
        matches!(self, Self::BtCpp | Self::BtCppHistory | Self::PyTrees)
    }

    /// Writes a tree of a program; `steps` is for the libraries of robots.
    ///
    /// # Errors
    /// The first node that the form has no counterpart for.
    pub fn write(self, program: &Program, tree: &Tree, steps: Steps) -> Result<String, Refusal> {
        match self {
            Self::Bt => Ok(bt::tree(program, tree)),
            Self::Dot => Ok(dot::tree(program, tree)),
            Self::Json => Ok(json::tree(program, tree)),
            Self::Svg => Ok(svg::tree::tree(program, tree)),
            Self::BtCpp => btcpp::tree(program, tree, steps),
            Self::BtCppHistory => Ok(history::header(program, tree)),
            Self::PyTrees => py_trees::tree(program, tree, steps),
        }
    }
}
