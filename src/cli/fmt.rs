//! `btc fmt`

use super::Failure;
use super::files::{self, STDIN};
use super::report::{Reporter, tell};
use crate::driver::format;
use clap::Args;
use std::path::Path;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The files to lay out in place; `-` lays standard input out on standard output.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Change nothing; fail if a file is not laid out.
    #[arg(long)]
    check: bool,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let mut fine = true;
    for path in &arguments.files {
        let Ok((name, bytes)) = files::read(path) else {
            fine = false;
            continue;
        };
        let text = match format::format(&name, bytes.clone()) {
            Ok(text) => text,
            Err((sources, mistakes)) => {
                say.all(&sources, &mistakes);
                say.count(&mistakes);
                fine = false;
                continue;
            }
        };
        let changed = text.as_bytes() != bytes;
        if arguments.check {
            if changed {
                tell(&format!("{name} is not laid out"));
                fine = false;
            }
        } else if path == STDIN {
            files::print(&text)?;
        } else if changed {
            fine &= files::write(Path::new(path), &text).is_ok();
        }
    }
    if fine { Ok(()) } else { Err(Failure::Input) }
}
