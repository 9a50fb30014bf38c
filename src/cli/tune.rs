//! `btc tune`

use super::files::{self, STDIN};
use super::learn::tuned_files;
use super::progress::Progress;
use super::report::{Format, Reporter, tell};
use super::store::{Folder, System};
use super::{Failure, PLAYED, effort, interrupt};
use crate::driver::tune::{self, Options};
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program; `-` is standard input.
    file: String,
    /// The tree whose numbers are tuned; without it, the learner's, which is learned first.
    #[arg(long, value_name = "NAME", conflicts_with = "learner")]
    tree: Option<String>,
    /// The learner, if the program has several.
    #[arg(long, value_name = "NAME")]
    learner: Option<String>,
    /// How many fresh episodes hold the values that were found against those in use.
    #[arg(long, value_name = "N", default_value_t = Options::default().episodes, value_parser = clap::value_parser!(u64).range(2..=PLAYED))]
    episodes: u64,
    /// About how many ticks the search may take.
    #[arg(long, value_name = "TICKS", default_value_t = Options::default().effort, value_parser = effort)]
    effort: u64,
    /// The seed of the episodes.
    #[arg(long, value_name = "N", default_value_t = Options::default().seed)]
    seed: u64,
    /// Write the values that were found into the program.
    #[arg(long)]
    fix: bool,
    /// The folder for the report as JSON and the curves as SVG.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// How to write the report.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Format,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    if arguments.fix && arguments.file == STDIN {
        tell("error: standard input cannot be fixed: name a file");
        return Err(Failure::Usage);
    }
    let loaded = files::load(&arguments.file, say)?;
    let options = Options {
        tree: arguments.tree.as_deref(),
        learner: arguments.learner.as_deref(),
        effort: arguments.effort,
        episodes: arguments.episodes,
        seed: arguments.seed,
    };
    let bar = Progress::new();
    let tuned = tune::tune(&loaded, &options, &|stage| match stage {
        tune::Stage::Learning(stage) => bar.show(stage),
        tune::Stage::Tuning(_) => bar.stage("tuning"),
    });
    bar.finish();
    let tuned = tuned.map_err(|refused| say.refused(&refused))?;
    if let Some(folder) = &arguments.output {
        let folder = Folder::new(folder);
        let files: Vec<(String, String)> = tuned_files(&tuned).collect();
        interrupt::uninterrupted(|| folder.add(&System, &files))
            .map_err(|error| files::complain(&error.to_string()))?;
    }
    if arguments.fix {
        for (name, text) in &tuned.fixed {
            files::write(Path::new(name), text)?;
            tell(&format!("written to {name}"));
        }
    }
    match arguments.format {
        Format::Human => {
            files::print(&tuned.human)?;
            if let Some(text) = &tuned.text {
                files::print(&format!("\n{text}"))?;
            }
        }
        Format::Json => files::print(&tuned.json)?,
    }
    Ok(())
}
