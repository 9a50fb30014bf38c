//! `btc completions`

use super::{Failure, files};
use clap::{Args, Command};
use clap_complete::{Shell, generate};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The shell that is to complete the words of a command.
    shell: Shell,
}

pub(super) fn run(arguments: &Arguments, mut btc: Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    generate(arguments.shell, &mut btc, "btc", &mut script);
    files::print(&String::from_utf8_lossy(&script))
}
