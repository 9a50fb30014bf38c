//! `--checkpoint` and `--resume`: what a command that runs long keeps in the folder of its results.

use super::report::tell;
use super::store::checkpoint::{Run, Unlike};
use super::store::{Checkpoint, Folder, System};
use super::{Failure, files};
use crate::diagnostic::render;
use clap::Args;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Duration;

#[derive(Debug, Args)]
pub(super) struct Checkpoints {
    /// How often the state of the run is kept in the folder of the results, such as `60s` or `10min`; or `never`.
    #[arg(long, value_name = "TIME", default_value = "60s", value_parser = every)]
    checkpoint: Every,
    /// Go on where a run with the same options was stopped; the results are those of a run that was not.
    #[arg(long)]
    resume: bool,
}

impl Checkpoints {
    /// The time between two states; nothing is kept without it.
    pub(super) fn every(&self) -> Option<Duration> {
        self.checkpoint.0
    }

    /// Whether the run is to go on.
    pub(super) fn resumes(&self) -> bool {
        self.resume
    }

    /// Looks for the states of this run, and goes on from them if that is asked for.
    ///
    /// # Errors
    /// The states there are of another run, or one that is not over keeps its own there.
    pub(super) fn begin(&self, checkpoint: &mut Checkpoint, place: &Path) -> Result<(), Failure> {
        let place = place.to_string_lossy();
        let place = render::on_one_line(&place);
        match (self.resume, checkpoint.found()) {
            (true, Ok(())) => checkpoint.resume(),
            (true, Err(Unlike::Nothing)) => tell(&format!(
                "note: there is no checkpoint in {place}: the run begins at the beginning"
            )),
            (true, Err(Unlike::Damaged)) => tell(&format!(
                "note: the checkpoint in {place} is damaged: the run begins at the beginning"
            )),
            (_, Err(Unlike::Busy)) => {
                let why = format!("another run is at work in {place}");
                let failure = files::complain(&why);
                tell("  wait until it has ended, or name another folder with `-o`");
                return Err(failure);
            }
            (true, Err(Unlike::Other(differences))) => {
                let failure =
                    files::complain(&format!("the checkpoint in {place} is of another run"));
                list(differences);
                tell("  ask for the same, or leave out `--resume` to begin anew");
                return Err(failure);
            }
            (false, Ok(())) => tell(&format!(
                "note: {place} has a checkpoint of this run; `--resume` would have gone on from there"
            )),
            (false, Err(Unlike::Other(differences))) => {
                tell(&format!(
                    "note: {place} has a checkpoint of another run, which this one replaces"
                ));
                list(differences);
                tell("  stop now, and ask for the same with `--resume`, to go on with that run");
            }
            (false, Err(Unlike::Nothing | Unlike::Damaged)) => {}
        }
        Ok(())
    }
}

/// Tells in what two runs differ.
fn list(differences: Vec<[String; 3]>) {
    let or_none = |value: String| match value.is_empty() {
        true => "nothing".to_owned(),
        false => value,
    };
    for [what, there, here] in differences {
        let (there, here) = (or_none(there), or_none(here));
        tell(&render::visible(&format!(
            "  {what}: {there} there, {here} here"
        )));
    }
}

/// Ends a run. Of one that is refused nothing is left, and none of the folders that were
/// missing before.
///
/// # Errors
/// Those of the run.
pub(super) fn settle<T>(
    made: Result<T, Failure>,
    checkpoint: &Checkpoint,
    missing: &[PathBuf],
) -> Result<T, Failure> {
    if made.is_err() {
        checkpoint.remove();
        Folder::unmake(&System, missing);
    }
    checkpoint.release();
    made
}

/// What each run is of: the command, this btc, the files of the program with their hashes.
pub(super) fn run_of(command: &str, program: &BTreeMap<String, String>) -> Run {
    let files = program.iter();
    let mut run: Run = files
        .map(|(path, hash)| (format!("program {path}"), hash.clone()))
        .collect();
    run.insert("btc".to_owned(), env!("CARGO_PKG_VERSION").to_owned());
    run.insert("command".to_owned(), command.to_owned());
    run
}

/// How often states are kept.
#[derive(Clone, Copy, Debug)]
struct Every(Option<Duration>);

/// A time between two states: `60s`, `10min`, `1h`, or `never`.
fn every(text: &str) -> Result<Every, String> {
    if text == "never" {
        return Ok(Every(None));
    }
    let split = text.find(|c: char| c.is_ascii_alphabetic());
    let (digits, unit) = text.split_at(split.unwrap_or(text.len()));
    let scale = match unit {
        "ms" => 0.001,
        "s" => 1.0,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        _ => f64::NAN,
    };
    let time = digits.trim().parse().map(|number: f64| number * scale).ok();
    let time = time.and_then(|time| Duration::try_from_secs_f64(time).ok());
    match time {
        Some(time) => Ok(Every(Some(time))),
        None => Err(
            "a time between two checkpoints is such as `60s`, `10min`, `1h` or `never`".to_owned(),
        ),
    }
}
