//! `btc test`

use super::check::programs;
use super::diff::{Form, written};
use super::files;
use super::progress::Progress;
use super::report::{Reporter, tell};
use super::{Failure, PLAYED};
use crate::diagnostic::render;
use crate::driver::learn::Shape;
use crate::driver::load::Loaded;
use crate::driver::snapshot;
use clap::Args;
use std::io::{self, BufRead, IsTerminal};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The programs to test, or folders of them.
    #[arg(value_name = "PATH", default_value = ".")]
    paths: Vec<String>,
    /// Take every tree that is learned now for the expected one.
    #[arg(long, conflicts_with = "review")]
    accept: bool,
    /// Ask of each tree that has changed whether it is the expected one.
    #[arg(long)]
    review: bool,
    /// The tree that is wanted, as `btc learn` finds it.
    #[arg(long, value_name = "SHAPE", default_value = "grown")]
    shape: Shape,
    /// How many episodes an old tree and a new one play where they decide differently.
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..=PLAYED))]
    episodes: u64,
    /// How to write what parts a tree from its snapshot.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Form,
}

/// How many trees were as expected, and how many not.
#[derive(Default)]
struct Count {
    passed: usize,
    accepted: usize,
    failed: usize,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    if arguments.review && !io::stdin().is_terminal() {
        tell("error: `--review` asks questions, and standard input is no terminal");
        return Err(Failure::Usage);
    }
    let mut count = Count::default();
    let mut snapshots = Vec::new();
    let mut empty = Vec::new();
    for named in &arguments.paths {
        let programs = programs(named);
        let mut is_tested = false;
        for path in &programs {
            let Ok(loaded) = files::load(path, say) else {
                count.failed += 1;
                is_tested = true;
                continue;
            };
            for learner in snapshot::learners(&loaded) {
                one(arguments, path, &loaded, &learner, &mut count, say)?;
                snapshots.push(beside(path, &learner));
                is_tested = true;
            }
        }
        if !is_tested {
            empty.push((named, programs.len()));
        }
    }
    // A snapshot that is named beside its program is tested with it.
    let snapshots: Vec<PathBuf> = snapshots.iter().flat_map(|it| it.canonicalize()).collect();
    let is_snapshot = |named: &str| {
        let real = Path::new(named).canonicalize();
        real.is_ok_and(|real| snapshots.contains(&real))
    };
    empty.retain(|(named, _)| !is_snapshot(named));
    for (named, programs) in &empty {
        files::complain(&nothing(named, *programs));
    }
    let accepted = match count.accepted {
        0 => String::new(),
        n => format!(", {n} accepted"),
    };
    tell(&format!(
        "{} passed, {} failed{accepted}",
        count.passed, count.failed
    ));
    match count.failed + empty.len() {
        0 => Ok(()),
        _ => Err(Failure::Input),
    }
}

/// Why nothing can be tested at a path with so many programs.
fn nothing(named: &str, programs: usize) -> String {
    let why = match programs {
        _ if !Path::new(named).is_dir() => {
            "it has no `learn`, so no tree is learned from it".to_owned()
        }
        0 => "no file in this folder ends in `.bt`".to_owned(),
        1 => "the program in this folder has no `learn`".to_owned(),
        n => format!("none of the {n} programs in this folder has a `learn`"),
    };
    format!(
        "there is nothing to test in `{}`: {why}",
        render::visible(named)
    )
}

/// Learns one tree and holds it against its snapshot.
fn one(
    arguments: &Arguments,
    path: &str,
    loaded: &Loaded,
    learner: &str,
    count: &mut Count,
    say: &Reporter,
) -> Result<(), Failure> {
    let place = beside(path, learner);
    let shown = place.display().to_string();
    let source = Path::new(path).file_name().unwrap_or_default();
    let source = source.to_string_lossy().into_owned();
    let bar = Progress::new();
    let shape = arguments.shape;
    let learned = snapshot::learned(loaded, learner, &source, shape, &|stage| bar.show(stage));
    bar.finish();
    let learned = learned.map_err(|refused| say.refused(&refused))?;
    let new = snapshot::text(&learned, &source);
    if !place.exists() {
        if arguments.accept || arguments.review && agreed(&shown, &learned.text)? {
            files::write(&place, &new)?;
            count.accepted += 1;
        } else {
            files::print(&format!(
                "{shown}: there is no snapshot yet; `btc test --accept` writes it\n"
            ))?;
            count.failed += 1;
        }
        return Ok(());
    }
    let old = files::load(&shown, say)?;
    let found = snapshot::compared(loaded, &learned, &old, arguments.episodes, 1);
    let found = found.map_err(|refused| say.refused(&refused))?;
    if found.is_same() {
        count.passed += 1;
        return files::print(&format!("{shown}: ok\n"));
    }
    let text = written(&found, arguments.format, &shown);
    if arguments.accept || arguments.review && agreed(&text, &learned.text)? {
        files::write(&place, &new)?;
        count.accepted += 1;
        return Ok(());
    }
    count.failed += 1;
    files::print(&text)
}

/// The snapshot of a learner, beside its program: `world.learned.bt`.
fn beside(path: &str, learner: &str) -> PathBuf {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    let learner: String = learner
        .chars()
        .map(|c| if plain(c) { c } else { '_' })
        .collect();
    Path::new(path).with_extension(format!("{learner}.bt"))
}

/// Shows a difference and asks whether the new tree is the expected one.
fn agreed(difference: &str, tree: &str) -> Result<bool, Failure> {
    tell(&format!("{}\n{}", difference.trim_end(), tree.trim_end()));
    loop {
        tell("accept this tree? [y]es, [n]o");
        let mut answer = String::new();
        let read = io::stdin().lock().read_line(&mut answer);
        match (read, answer.trim().to_ascii_lowercase().as_str()) {
            (Err(_) | Ok(0), _) | (_, "n" | "no") => return Ok(false),
            (_, "y" | "yes") => return Ok(true),
            _ => {}
        }
    }
}
