//! `btc fmt`

use super::Failure;
use super::check::programs;
use super::files::{self, DASH};
use super::report::{Reporter, tell};
use crate::driver::format::format;
use crate::driver::load::MOST;
use clap::Args;
use std::path::Path;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The files to lay out in place, or folders of them; `-` lays standard input out on standard output.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// Change nothing; fail if a file is not laid out.
    #[arg(long)]
    check: bool,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let mut fine = true;
    let mut paths = Vec::new();
    for named in &arguments.files {
        paths.extend(programs(named)?);
    }
    for path in &paths {
        let Ok(file) = files::read_alone(path, MOST as u64) else {
            fine = false;
            continue;
        };
        let formatted = match format(file.text()) {
            Ok(formatted) => formatted,
            Err(refused) => {
                say.refused(&refused);
                say.count(&refused.diagnostics);
                fine = false;
                continue;
            }
        };
        let changed = formatted.as_bytes() != file.bytes;
        if arguments.check {
            if changed {
                tell(&format!("{} is not laid out", file.name));
                fine = false;
            }
        } else if path == DASH {
            files::print(&formatted)?;
        } else if changed {
            fine &= files::write(Path::new(path), &formatted).is_ok();
        }
    }
    if fine { Ok(()) } else { Err(Failure::Input) }
}
