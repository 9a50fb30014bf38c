//! `btc compile`

use super::report::Reporter;
use super::{Failure, files};
use crate::driver::compile::{self, Form};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program; `-` is standard input.
    file: String,
    /// The form to write; without it, a summary.
    #[arg(long, value_name = "FORM")]
    emit: Option<Form>,
    /// The tree to write.
    #[arg(long, value_name = "NAME", requires = "emit")]
    tree: Option<String>,
    /// The file to write to instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let loaded = files::load(&arguments.file, say)?;
    let text = match arguments.emit {
        None => compile::summary(&loaded),
        Some(form) => compile::emit(&loaded, form, arguments.tree.as_deref())
            .map_err(|refused| say.refused(&refused))?,
    };
    files::put(arguments.output.as_deref(), &text)
}
