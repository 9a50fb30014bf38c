//! `btc tune`

use super::checkpoints::{self, Checkpoints};
use super::files::{self, DASH};
use super::learn::tuned_files;
use super::progress::Progress;
use super::report::{Format, Reporter, tell};
use super::store::checkpoint::Run;
use super::store::{Checkpoint, Folder, System};
use super::{Failure, PLAYED, effort, interrupt, paths};
use crate::checkpoint::{Forgetful, Keeper};
use crate::driver::load::Loaded;
use crate::driver::tune::{self, Options, Outcome};
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
    /// How many fresh episodes hold the values that were found against those in use, as far as the effort goes.
    #[arg(long, value_name = "N", default_value_t = Options::default().episodes, value_parser = clap::value_parser!(u64).range(2..=PLAYED))]
    episodes: u64,
    /// About how many ticks the search may take, with the fresh episodes; what is learned has an effort of its own.
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
    #[command(flatten)]
    checkpoints: Checkpoints,
    /// How to write the report.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Format,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    if arguments.fix && arguments.file == DASH {
        tell("error: standard input cannot be fixed: name a file");
        return Err(Failure::Usage);
    }
    let Some(place) = &arguments.output else {
        if arguments.checkpoints.resumes() {
            tell("error: `--resume` goes on from the folder of the results: name it with `-o`");
            return Err(Failure::Usage);
        }
        let loaded = files::load(&arguments.file, say)?;
        let tuned = search(&loaded, &arguments.options(&Forgetful), say)?;
        return say_all(arguments, &loaded, &tuned);
    };
    let loaded = files::load(&arguments.file, say)?;
    let folder = Folder::new(place);
    let missing = folder.missing();
    let whole = interrupt::uninterrupted(|| folder.probe(&System, &["tune.json"]))
        .map_err(|error| files::complain(&error.to_string()))?;
    let mut checkpoint = Checkpoint::new(
        &System,
        &whole,
        arguments.run(&loaded, &whole)?,
        arguments.checkpoints.every(),
        interrupt::guard,
    );
    arguments.checkpoints.begin(&mut checkpoint, place)?;
    let tuned = search(&loaded, &arguments.options(&checkpoint), say);
    let tuned = checkpoints::settle(tuned, &checkpoint, &missing)?;
    let files: Vec<(String, String)> = tuned_files(&tuned).collect();
    files::placed(interrupt::uninterrupted(|| folder.add(&System, &files)))?;
    say_all(arguments, &loaded, &tuned)
}

impl Arguments {
    fn options<'o>(&'o self, keeper: &'o dyn Keeper) -> Options<'o> {
        Options {
            tree: self.tree.as_deref(),
            learner: self.learner.as_deref(),
            effort: self.effort,
            episodes: self.episodes,
            seed: self.seed,
            keeper,
        }
    }

    /// All that the result depends on.
    fn run(&self, loaded: &Loaded, folder: &Path) -> Result<Run, Failure> {
        let program = match self.file == DASH {
            true => paths::program_by_name(loaded),
            false => paths::program_of(loaded, folder)?,
        };
        let mut run = checkpoints::run_of("tune", &program);
        let mut add = |name: &str, value: String| run.insert(name.to_owned(), value);
        add("--tree", self.tree.clone().unwrap_or_default());
        add("--learner", self.learner.clone().unwrap_or_default());
        add("--effort", self.effort.to_string());
        add("--episodes", self.episodes.to_string());
        add("--seed", self.seed.to_string());
        Ok(run)
    }
}

fn search(loaded: &Loaded, options: &Options, say: &Reporter) -> Result<Outcome, Failure> {
    let bar = Progress::new();
    let tuned = tune::tune(loaded, options, &|stage| bar.tune(stage));
    bar.finish();
    tuned.map_err(|refused| say.refused(&refused))
}

/// Fixes the program if that is asked for, and prints what was found.
fn say_all(arguments: &Arguments, loaded: &Loaded, tuned: &Outcome) -> Result<(), Failure> {
    if arguments.fix {
        files::rewrite(loaded, &tuned.fixed)?;
        for (name, _) in &tuned.fixed {
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
