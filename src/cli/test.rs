//! `btc test`

mod scripted;

use super::check::{programs, standing};
use super::diff::{Form, written};
use super::files;
use super::progress::Progress;
use super::report::{Reporter, tell};
use super::{Failure, PLAYED};
use crate::diagnostic::render;
use crate::driver::learn::{Learned, Shape};
use crate::driver::load::{Loaded, MOST};
use crate::driver::{snapshot, test};
use clap::Args;
use std::io::{self, BufRead, IsTerminal};
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The programs to test, or folders of them.
    #[arg(value_name = "PATH", default_value = ".")]
    paths: Vec<String>,
    /// Run the tests that stand in programs, and learn nothing.
    #[arg(long, conflicts_with_all = ["accept", "review"])]
    no_learn: bool,
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
    /// How to write what the tests find, and what parts a tree from its snapshot.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Form,
}

/// How many tests and trees were as expected, and how many not.
#[derive(Default)]
struct Count {
    passed: usize,
    accepted: usize,
    failed: usize,
    skipped: usize,
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
        let programs = snapshots_last(standing(programs(named)?));
        let mut is_tested = false;
        for path in &programs {
            if is_one_of(path, &snapshots) {
                continue;
            }
            let Ok(loaded) = files::load(path, say) else {
                count.failed += 1;
                is_tested = true;
                continue;
            };
            let learners = snapshot::learners(&loaded);
            let is_learned = |due: &test::Due| {
                let learner = due.learner(&loaded);
                learner.is_some_and(|learner| learners.contains(&learner))
            };
            let (later, now): (Vec<_>, Vec<_>) =
                test::due(&loaded).into_iter().partition(is_learned);
            is_tested |= !now.is_empty() || !later.is_empty();
            scripted::run(arguments, path, &loaded, (&now, &[]), &mut count, say)?;
            if arguments.no_learn {
                scripted::skip(arguments, path, &later, &mut count)?;
                continue;
            }
            let mut learned = Vec::new();
            for learner in learners {
                learned.push(one(arguments, path, &loaded, &learner, &mut count, say)?);
                snapshots.push(beside(path, &learner));
                is_tested = true;
            }
            scripted::run(
                arguments,
                path,
                &loaded,
                (&later, &learned),
                &mut count,
                say,
            )?;
        }
        if !is_tested {
            empty.push((named, programs.len()));
        }
    }
    // A snapshot that is named beside its program is tested with it.
    empty.retain(|(named, _)| !is_one_of(named, &snapshots));
    for (named, programs) in &empty {
        files::complain(&nothing(named, *programs, arguments.no_learn));
    }
    let skipped = match count.skipped {
        0 => String::new(),
        n => format!(", {n} skipped"),
    };
    let accepted = match count.accepted {
        0 => String::new(),
        n => format!(", {n} accepted"),
    };
    tell(&format!(
        "{} passed, {} failed{accepted}{skipped}",
        count.passed, count.failed
    ));
    match count.failed + empty.len() {
        0 => Ok(()),
        _ => Err(Failure::Input),
    }
}

/// The programs, those last that by their names are snapshots of others: `world.learned.bt` after `world.bt`.
fn snapshots_last(programs: Vec<String>) -> Vec<String> {
    let is_snapshot = |path: &String| {
        let stem = path
            .strip_suffix(".bt")
            .and_then(|path| path.rsplit_once('.'));
        stem.is_some_and(|(stem, _)| programs.contains(&format!("{stem}.bt")))
    };
    let (last, mut sorted): (Vec<String>, Vec<String>) =
        programs.iter().cloned().partition(is_snapshot);
    sorted.extend(last);
    sorted
}

/// Whether a path leads to one of these files.
fn is_one_of(path: &str, files: &[PathBuf]) -> bool {
    let real = Path::new(path).canonicalize();
    let mut files = files.iter().flat_map(|file| file.canonicalize());
    real.is_ok_and(|real| files.any(|file| file == real))
}

/// Why nothing can be tested at a path with so many programs.
fn nothing(named: &str, programs: usize, no_learn: bool) -> String {
    let (no, has_no) = match no_learn {
        true => ("no `test`", "a `test`"),
        false => ("neither a `test` nor a `learn`", "a `test` or a `learn`"),
    };
    let why = match programs {
        _ if !Path::new(named).is_dir() => format!("it has {no}"),
        0 => "no file in this folder ends in `.bt`".to_owned(),
        1 => format!("the program in this folder has {no}"),
        n => format!("none of the {n} programs in this folder has {has_no}"),
    };
    format!(
        "there is nothing to test in `{}`: {why}",
        render::on_one_line(named)
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
) -> Result<Learned, Failure> {
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
    let text = match place.exists() {
        true => read(&shown, count),
        false => Some(String::new()),
    };
    let Some(text) = text else {
        return Ok(learned);
    };
    if text.trim().is_empty() {
        if arguments.accept || arguments.review && agreed(&shown, &learned.text)? {
            files::write(&place, &new)?;
            count.accepted += 1;
        } else {
            files::print(&match arguments.format {
                Form::Json => scripted::missing(&shown),
                _ => {
                    format!(
                        "{}: there is no snapshot yet; `btc test --accept` writes it\n",
                        render::on_one_line(&shown)
                    )
                }
            })?;
            count.failed += 1;
        }
        return Ok(learned);
    }
    let found = files::load(&shown, say).and_then(|old| {
        let found = snapshot::compared(loaded, &learned, &old, arguments.episodes, 1);
        found.map_err(|refused| say.refused(&refused))
    });
    let found = match found {
        Ok(found) => found,
        Err(_) if arguments.accept => {
            files::write(&place, &new)?;
            count.accepted += 1;
            return Ok(learned);
        }
        Err(_) => {
            count.failed += 1;
            return Ok(learned);
        }
    };
    let text = written(&found, arguments.format, &shown);
    if found.is_same() {
        count.passed += 1;
        files::print(&match arguments.format {
            Form::Json => text,
            _ => format!("{}: ok\n", render::on_one_line(&shown)),
        })?;
        return Ok(learned);
    }
    if arguments.accept || arguments.review && agreed(&text, &learned.text)? {
        files::write(&place, &new)?;
        count.accepted += 1;
        return Ok(learned);
    }
    count.failed += 1;
    files::print(&text)?;
    Ok(learned)
}

/// The text of a snapshot. A file that is none, or cannot be read, is a failure, and is left as it is.
fn read(shown: &str, count: &mut Count) -> Option<String> {
    let text = files::read_alone(shown, MOST as u64).ok();
    let text = text.map(|file| String::from_utf8_lossy(&file.bytes).into_owned());
    let text = text.filter(|text| {
        let is_one = snapshot::is_one(text);
        if !is_one {
            files::complain(&format!(
                "{shown}: this is not a snapshot, but stands where that of the learned tree belongs; give it another name"
            ));
        }
        is_one
    });
    count.failed += usize::from(text.is_none());
    text
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
