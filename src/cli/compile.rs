//! `btc compile`

use super::report::Reporter;
use super::{Failure, files};
use crate::driver::compile::{self, Form};
use crate::driver::export::Runtime;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program; `-` is standard input.
    file: String,
    /// The form to write; without it, a summary.
    #[arg(long, value_name = "FORM")]
    emit: Option<Emit>,
    /// The tree to write.
    #[arg(long, value_name = "NAME", requires = "emit")]
    tree: Option<String>,
    /// The file to write to, in the place of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Emit {
    /// The syntax tree.
    Ast,
    /// The checked program.
    Ir,
    /// The language, laid out.
    Bt,
    /// Graphviz.
    Dot,
    /// JSON.
    Json,
    /// A picture.
    Svg,
    /// XML for BehaviorTree.CPP 4, Groot2 and Nav2.
    Btcpp,
    /// A Python module for py_trees 2.
    #[value(name = "py_trees")]
    PyTrees,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let loaded = files::load(&arguments.file, say)?;
    let text = match arguments.emit {
        None => compile::summary(&loaded),
        Some(emit) => {
            let form = match emit {
                Emit::Ast => Form::Ast,
                Emit::Ir => Form::Ir,
                Emit::Bt => Form::Bt,
                Emit::Dot => Form::Dot,
                Emit::Json => Form::Json,
                Emit::Svg => Form::Svg,
                Emit::Btcpp => Form::Robot(Runtime::BtCpp),
                Emit::PyTrees => Form::Robot(Runtime::PyTrees),
            };
            compile::emit(&loaded, form, arguments.tree.as_deref())
                .map_err(|mistake| say.one(&loaded.sources, mistake))?
        }
    };
    files::put(arguments.output.as_deref(), &text)
}
