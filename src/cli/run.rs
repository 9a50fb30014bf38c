//! `btc run`

use super::report::{Format, Reporter};
use super::{Failure, PLAYED, files};
use crate::driver::picture;
use crate::driver::run::{self, Subject};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("subject").required(true).args(["tree", "policy"]))]
pub(super) struct Arguments {
    /// The program; `-` is standard input.
    file: String,
    /// The tree to run.
    #[arg(long, value_name = "NAME")]
    tree: Option<String>,
    /// The policy to run, as `btc learn` writes it.
    #[arg(long, value_name = "FILE")]
    policy: Option<String>,
    /// How many episodes.
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..=PLAYED))]
    episodes: u64,
    /// The seed of the episodes.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How to write the figures.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Format,
    /// Draw the world with the way of the robot in the first episode, as SVG.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// How many ticks of it to draw.
    #[arg(long, value_name = "N", default_value_t = 2_000, requires = "svg")]
    svg_ticks: u64,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let loaded = files::load(&arguments.file, say)?;
    let subject = match (&arguments.policy, &arguments.tree) {
        (Some(path), _) => Subject::policy(&loaded, files::read(path)?.text()),
        (None, Some(name)) => Subject::tree(&loaded, name),
        // clap asks for one of the two.
        (None, None) => return Err(Failure::Usage),
    };
    let subject = subject.map_err(|refused| say.refused(&refused))?;
    let ran = run::run(&loaded, &subject, arguments.episodes, arguments.seed)
        .map_err(|refused| say.refused(&refused))?;
    if let Some(path) = &arguments.svg {
        let picture = picture::draw(&loaded, &subject, arguments.seed, arguments.svg_ticks)
            .map_err(|refused| say.refused(&refused))?;
        files::write(path, &picture)?;
    }
    match arguments.format {
        Format::Human => files::print(&ran.human()),
        Format::Json => files::print(&ran.json()),
    }
}
