//! `btc run`

use super::report::Reporter;
use super::{Failure, PLAYED, files};
use crate::driver::run::{self, Subject};
use crate::driver::{load, picture, table, target};
use clap::{Args, ValueEnum};
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

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For a person.
    Human,
    /// JSON.
    Json,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let mut loaded = files::load(&arguments.file, say)?;
    let policy = match &arguments.policy {
        None => None,
        Some(path) => {
            let (name, bytes) = files::read(path)?;
            let (file, mistake) = load::decode(&mut loaded.sources, &name, bytes);
            if let Some(mistake) = mistake {
                return Err(say.one(&loaded.sources, mistake));
            }
            let task = target::task_of(&loaded, None)
                .map_err(|mistake| say.one(&loaded.sources, mistake))?;
            let policy = table::policy(&loaded, file, task)
                .map_err(|mistakes| say.several(&loaded.sources, &mistakes))?;
            Some((policy, task))
        }
    };
    let subject = match (&policy, &arguments.tree) {
        (Some((policy, task)), _) => Subject::Policy(policy, *task),
        (None, Some(name)) => Subject::Tree(
            target::tree(&loaded, name).map_err(|mistake| say.one(&loaded.sources, mistake))?,
        ),
        // clap asks for one of the two.
        (None, None) => return Err(Failure::Usage),
    };
    let ran = run::run(&loaded, subject, arguments.episodes, arguments.seed)
        .map_err(|mistake| say.one(&loaded.sources, mistake))?;
    if let Some(path) = &arguments.svg {
        let picture = picture::draw(&loaded, subject, arguments.seed, arguments.svg_ticks)
            .map_err(|mistake| say.one(&loaded.sources, mistake))?;
        files::write(path, &picture)?;
    }
    match arguments.format {
        Format::Human => files::print(&ran.human()),
        Format::Json => files::print(&format!("{:#}\n", ran.json())),
    }
}
