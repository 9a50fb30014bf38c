//! `btc check`

use super::report::{Format, Reporter};
use super::{Failure, files};
use crate::diagnostic::{Diagnostic, render};
use crate::driver::{check, load};
use crate::facade::disk::Disk;
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The programs to check; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// How to write diagnostics: for a person on standard error, or as JSON lines on standard output.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Format,
    /// Warnings are errors.
    #[arg(long)]
    deny_warnings: bool,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let mut fine = true;
    for path in &arguments.files {
        let Ok(files::File { name, bytes }) = files::read(path) else {
            fine = false;
            continue;
        };
        let mut loaded = load::load(&name, bytes, &mut Disk);
        loaded.diagnostics.extend(check::worlds(&loaded));
        let wrong = |d: &Diagnostic| d.is_error() || arguments.deny_warnings;
        let clean = !loaded.diagnostics.iter().any(wrong);
        fine &= clean;
        match arguments.format {
            Format::Json => {
                files::print(&render::json(&loaded.sources, &loaded.diagnostics))?;
            }
            Format::Human => {
                say.all(&loaded.sources, &loaded.diagnostics);
                say.count(&loaded.diagnostics);
                if clean && arguments.files.len() == 1 {
                    files::print("ok\n")?;
                } else if clean {
                    files::print(&format!("{name}: ok\n"))?;
                }
            }
        }
    }
    if fine { Ok(()) } else { Err(Failure::Input) }
}
