//! `btc canonicalize`

use super::report::{Reporter, tell};
use super::{Failure, files, paths};
use crate::driver::canonicalize::{self, Form};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program; `-` is standard input.
    file: String,
    /// The tree.
    #[arg(long, value_name = "NAME")]
    tree: String,
    /// The form to write.
    #[arg(long, value_name = "FORM", default_value = "bt")]
    emit: Emit,
    /// The file to write to instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Emit {
    /// A program with the canonical tree: a selector of units, one for each behaviour.
    Bt,
    /// The policy table that the tree stands for: a row for each of its cubes, no two of which overlap.
    Csv,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    files::apart(&[arguments.output.as_deref()], &[Some(&arguments.file)])?;
    let loaded = files::load(&arguments.file, say)?;
    let path = paths::used_by(arguments.output.as_deref(), &arguments.file)?;
    let form = match arguments.emit {
        Emit::Bt => Form::Bt(path.as_deref()),
        Emit::Csv => Form::Csv,
    };
    let (text, warning) = canonicalize::canonicalize(&loaded, &arguments.tree, form)
        .map_err(|refused| say.refused(&refused))?;
    files::put(arguments.output.as_deref(), &text)?;
    warning.iter().for_each(|line| tell(line));
    Ok(())
}
