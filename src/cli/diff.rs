//! `btc diff`

use super::files::{self, File};
use super::report::Reporter;
use super::{Failure, PLAYED};
use crate::driver::diff::{self, Side};
use crate::driver::load::Loaded;
use crate::report::difference::{Difference, Outcome};
use clap::{Args, ValueEnum};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The old tree or table: a program, or a policy table (`.csv`, `.jsonl`).
    old: String,
    /// The new tree or table.
    new: String,
    /// The tree to compare, if the files have several.
    #[arg(long, value_name = "NAME")]
    tree: Option<String>,
    /// The tree of the new file, if it is called otherwise there.
    #[arg(long, value_name = "NAME")]
    new_tree: Option<String>,
    /// How many episodes both play where they decide differently.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..=PLAYED))]
    episodes: u64,
    /// The seed of the episodes.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How to write what parts them.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Form,
}

/// The forms of a difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Form {
    /// For a person.
    Human,
    /// Workflow commands, as GitHub shows them.
    Github,
    /// A JSON document.
    Json,
    /// For a comment on a pull request.
    Markdown,
}

/// A side as it was read.
enum Read {
    Program(Box<Loaded>),
    Table(File),
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let (old, new) = (read(&arguments.old, say)?, read(&arguments.new, say)?);
    let name = arguments.tree.as_deref();
    let found = diff::diff(
        side(&old, name),
        side(&new, arguments.new_tree.as_deref().or(name)),
        arguments.episodes,
        arguments.seed,
    );
    let found = found.map_err(|refused| say.refused(&refused))?;
    files::print(&written(&found, arguments.format, &arguments.new))?;
    match &found.outcome {
        Outcome::Same(_) | Outcome::Equal(_) => Ok(()),
        Outcome::Other(_) | Outcome::Onward(..) | Outcome::Parts(_) => Err(Failure::Input),
        Outcome::Undecided(_) => Err(Failure::Undecided),
    }
}

/// A difference in a form; `file` is where it is found.
pub(super) fn written(found: &Difference, form: Form, file: &str) -> String {
    match form {
        Form::Human => found.human(),
        Form::Github => found.github(file),
        Form::Json => found.json(),
        Form::Markdown => found.markdown(),
    }
}

fn read(path: &str, say: &Reporter) -> Result<Read, Failure> {
    let is_table = [".csv", ".jsonl", ".ndjson"]
        .iter()
        .any(|ending| path.ends_with(ending));
    match is_table {
        true => files::read(path).map(Read::Table),
        false => files::load(path, say).map(|loaded| Read::Program(Box::new(loaded))),
    }
}

fn side<'r>(read: &'r Read, tree: Option<&'r str>) -> Side<'r> {
    match read {
        Read::Program(loaded) => Side::Program(loaded, tree),
        Read::Table(file) => Side::Table(file.text()),
    }
}
