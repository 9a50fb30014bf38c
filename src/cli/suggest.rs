//! `btc suggest`

use super::files;
use super::progress::Progress;
use super::report::{Format, Reporter};
use super::{Failure, PLAYED, effort};
use crate::driver::suggest::{self, Options};
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program; `-` is standard input.
    file: String,
    /// The learner, if the program has several.
    #[arg(long, value_name = "NAME")]
    learner: Option<String>,
    /// About how many ticks the search for one tree may take.
    #[arg(long, value_name = "TICKS", default_value_t = Options::default().effort, value_parser = effort)]
    effort: u64,
    /// How many conditions are learned with, at most.
    #[arg(long, value_name = "N", default_value_t = Options::default().tries as u64, value_parser = clap::value_parser!(u64).range(1..=1000))]
    tries: u64,
    /// How many fresh episodes hold the trees against each other.
    #[arg(long, value_name = "N", default_value_t = Options::default().episodes, value_parser = clap::value_parser!(u64).range(2..=PLAYED))]
    episodes: u64,
    /// The seed of everything.
    #[arg(long, value_name = "N", default_value_t = Options::default().seed)]
    seed: u64,
    /// How to write the report.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Format,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let loaded = files::load(&arguments.file, say)?;
    let options = Options {
        learner: arguments.learner.as_deref(),
        effort: arguments.effort,
        tries: arguments.tries as usize,
        episodes: arguments.episodes,
        seed: arguments.seed,
    };
    let bar = Progress::new();
    let suggested = suggest::suggest(&loaded, &options, &|stage| match stage {
        suggest::Stage::Learning(stage) => bar.show(stage),
        suggest::Stage::Probing => bar.stage("probing"),
    });
    bar.finish();
    let suggested = suggested.map_err(|refused| say.refused(&refused))?;
    match arguments.format {
        Format::Human => files::print(&suggested.human),
        Format::Json => files::print(&suggested.json),
    }
}
