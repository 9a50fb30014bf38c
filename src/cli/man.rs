//! `btc man`

use super::{Failure, files};
use clap::{Args, Command};
use clap_mangen::Man;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The folder to write the pages to, such as `~/.local/share/man/man1`.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

pub(super) fn run(arguments: &Arguments, btc: Command) -> Result<(), Failure> {
    let folder = &arguments.output;
    let failed = |error| files::complain(&format!("{}: {error}", folder.display()));
    let mut btc = btc.disable_help_subcommand(true);
    // Names the pages of the commands: `btc-learn`.
    btc.build();
    let commands = btc.get_subcommands().cloned();
    let pages: Vec<Man> = commands.chain([btc.clone()]).map(Man::new).collect();
    let mut written = Vec::new();
    for page in pages {
        let mut text = Vec::new();
        page.render(&mut text).map_err(failed)?;
        written.push((folder.join(page.get_filename()), text));
    }
    std::fs::create_dir_all(folder).map_err(failed)?;
    files::write_each(&written)
}
