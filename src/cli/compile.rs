//! `btc compile`

use super::report::Reporter;
use super::{Failure, files};
use crate::driver::compile::{self, Form};
use crate::emit::form::TreeForm;
use crate::emit::steps::Steps;
use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program; `-` is standard input.
    file: String,
    /// The form to write; without it, a summary.
    #[arg(long, value_name = "FORM")]
    emit: Option<Form>,
    /// For a robot: begin the next child of a memory node in the tick in which the one before ends. The tree is shorter,
    /// and such steps come one tick earlier than in btc.
    #[arg(long, requires = "emit")]
    same_tick: bool,
    /// The tree to write.
    #[arg(long, value_name = "NAME", requires = "emit")]
    tree: Option<String>,
    /// The file to write to instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    files::apart(&[arguments.output.as_deref()], &[Some(&arguments.file)])?;
    let loaded = files::load(&arguments.file, say)?;
    let steps = match arguments.same_tick {
        true => Steps::SameTick,
        false => Steps::Exact,
    };
    let text = match arguments.emit {
        None => compile::summary(&loaded),
        Some(form) => compile::emit_in_steps(&loaded, form, arguments.tree.as_deref(), steps)
            .map_err(|refused| say.refused(&refused))?,
    };
    files::put(arguments.output.as_deref(), &text)
}

impl ValueEnum for Form {
    fn value_variants<'a>() -> &'a [Self] {
        &[
            Self::Ast,
            Self::Ir,
            Self::Tree(TreeForm::Bt),
            Self::Tree(TreeForm::Dot),
            Self::Tree(TreeForm::Json),
            Self::Tree(TreeForm::Svg),
            Self::Tree(TreeForm::BtCpp),
            Self::Tree(TreeForm::BtCppHistory),
            Self::Tree(TreeForm::PyTrees),
        ]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        match self {
            Self::Ast => Some(PossibleValue::new("ast").help("The syntax tree")),
            Self::Ir => Some(PossibleValue::new("ir").help("The checked program")),
            Self::Tree(form) => form.to_possible_value(),
        }
    }
}
