//! `btc check`

use super::report::Reporter;
use super::results::Found;
use super::store::manifest::Manifest;
use super::{Failure, files, results};
use crate::diagnostic::{Code, Diagnostic, render};
use crate::driver::load::Loaded;
use crate::driver::{check, load};
use crate::source::{Sources, Span};
use clap::{Args, ValueEnum};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::{fs, io};

/// How often fixes are applied to one file: one may bring another to light.
const ROUNDS: usize = 10;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The programs to check, or folders of them; `-` is standard input.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<String>,
    /// How to write diagnostics: for a person on standard error, or in another form on standard output.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Form,
    /// Warnings are errors.
    #[arg(long)]
    deny_warnings: bool,
    /// Apply the fixes that keep or restore what was meant.
    #[arg(long)]
    fix: bool,
    /// What standard input is called, which is also where its `use`s are looked for.
    #[arg(long, value_name = "PATH")]
    stdin_file_path: Option<String>,
}

/// How diagnostics are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Form {
    /// For a person, with the lines of the program.
    Human,
    /// One line each: `file:line:column: message`.
    Short,
    /// One JSON object each, a line.
    Json,
    /// Workflow commands, as GitHub shows them.
    Github,
    /// A SARIF log.
    Sarif,
}

/// What was found in one program.
struct Checked {
    name: String,
    sources: Sources,
    diagnostics: Vec<Diagnostic>,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let mut all: Vec<Checked> = Vec::new();
    for path in &arguments.files {
        for path in standing(programs(path)?) {
            all.push(found(arguments, &path)?);
        }
    }
    let wrong = |found: &Diagnostic| found.is_error() || arguments.deny_warnings;
    let clean = |found: &Checked| !found.diagnostics.iter().any(wrong);
    match arguments.format {
        Form::Sarif => {
            let parts = all.iter();
            let parts = parts.map(|found| (&found.sources, found.diagnostics.as_slice()));
            files::print(&render::sarif(parts))?;
        }
        Form::Human => {
            for found in &all {
                say.all(&found.sources, &found.diagnostics);
                if clean(found) && all.len() == 1 {
                    say.count(&found.diagnostics);
                    files::print("ok\n")?;
                } else if clean(found) {
                    files::print(&format!("{}: ok\n", render::on_one_line(&found.name)))?;
                }
            }
            if all.len() > 1 || !all.iter().all(clean) {
                say.count(all.iter().flat_map(|found| &found.diagnostics));
            }
        }
        Form::Short | Form::Json | Form::Github => {
            let render = match arguments.format {
                Form::Short => render::short,
                Form::Github => render::github,
                _ => render::json,
            };
            for found in &all {
                files::print(&render(&found.sources, &found.diagnostics))?;
            }
        }
    }
    if all.iter().all(clean) {
        Ok(())
    } else {
        Err(Failure::Input)
    }
}

/// The programs under a path: itself, or those in a folder and in its folders, in the order of their names. What begins
/// with a dot is left out, and so are the folders of results: what they hold was learned, and is checked where it is named.
///
/// # Errors
/// A folder cannot be read.
pub(super) fn programs(path: &str) -> Result<Vec<String>, Failure> {
    fn walk(folder: &Path, programs: &mut Vec<String>) -> Result<(), Failure> {
        let entries = std::fs::read_dir(folder).and_then(Iterator::collect::<io::Result<Vec<_>>>);
        let entries = entries.map_err(|error| {
            let folder = folder.to_string_lossy();
            files::complain(&format!("{folder}: {error}"))
        })?;
        let mut paths: Vec<PathBuf> = entries.iter().map(fs::DirEntry::path).collect();
        paths.sort();
        for path in paths {
            let hidden = path
                .file_name()
                .is_some_and(|name| name.to_string_lossy().starts_with('.'));
            if hidden || path.is_symlink() {
                continue;
            }
            if path.is_dir() {
                if Manifest::of_folder(&path).is_some() {
                    continue;
                }
                walk(&path, programs)?;
            } else if path.is_file() && path.extension().is_some_and(|of| of == "bt") {
                programs.push(path.to_string_lossy().into_owned());
            }
        }
        Ok(())
    }
    let mut programs = Vec::new();
    if path != files::DASH && Path::new(path).is_dir() {
        walk(Path::new(path), &mut programs)?;
        return Ok(programs);
    }
    Ok(vec![path.to_owned()])
}

/// The programs that stand for themselves: without the files that have mistakes alone and none in a sound program of the
/// same folder that uses them.
pub(super) fn standing(mut programs: Vec<String>) -> Vec<String> {
    if programs.len() < 2 {
        return programs;
    }
    let real = |path: &str| Path::new(path).canonicalize().ok();
    let (mut used, mut broken) = (BTreeSet::new(), BTreeSet::new());
    for path in &programs {
        let Ok((name, bytes)) = files::bytes(path, load::MOST as u64).map(|bytes| (path, bytes))
        else {
            continue;
        };
        let loaded = load::load(name, bytes, &mut Found::of(name));
        if loaded.has_errors() {
            broken.extend(real(path));
            continue;
        }
        let files = loaded.files.iter().filter(|file| **file != loaded.main);
        let files = files.filter_map(|file| loaded.sources.get(*file));
        used.extend(files.filter_map(|source| real(&source.name)));
    }
    programs.retain(|path| {
        real(path).is_none_or(|path| !(broken.contains(&path) && used.contains(&path)))
    });
    programs
}

/// What is found in the program at a path, after its fixes if they are to be applied.
fn found(arguments: &Arguments, path: &str) -> Result<Checked, Failure> {
    let (name, bytes) = match files::bytes(path, load::MOST as u64) {
        Ok(bytes) => {
            let called = arguments.stdin_file_path.as_deref();
            let called = called.filter(|_| path == files::DASH);
            (called.unwrap_or(files::shown(path)).to_owned(), bytes)
        }
        Err(why) => {
            let message = format!("{path}: {why}");
            let mut unread = Diagnostic::new(Code::E0208, Span::default(), message);
            unread.labels.clear();
            return Ok(Checked {
                name: path.to_owned(),
                sources: Sources::default(),
                diagnostics: vec![unread],
            });
        }
    };
    let mut reader = Found::of(&name);
    let mut loaded = load::load(&name, bytes, &mut reader);
    if arguments.fix && path != files::DASH && Path::new(path).is_file() {
        let mut mended = None;
        for _ in 0..ROUNDS {
            let Some(text) = fixed(mended.as_ref().unwrap_or(&loaded)) else {
                break;
            };
            mended = Some(load::load(&name, text.into(), &mut reader));
        }
        if let Some(mended) = mended {
            if let Some(source) = mended.sources.get(mended.main) {
                files::rewrite(&loaded, &[(name.clone(), source.text.clone())])?;
            }
            loaded = mended;
        }
    }
    loaded.diagnostics.extend(check::worlds(&loaded));
    loaded.diagnostics.extend(reader.changed());
    loaded.diagnostics.extend(results::torn(&name));
    Ok(Checked {
        name,
        sources: loaded.sources,
        diagnostics: loaded.diagnostics,
    })
}

/// The main file with the fixes that may be applied unseen; `None` if there are none.
fn fixed(loaded: &Loaded) -> Option<String> {
    let mut texts = loaded.texts(&check::fixes(loaded));
    Some(texts.remove(&loaded.main)?.text)
}
