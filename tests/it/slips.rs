//! Slips of the pen in sound programs, as strangers make them: each is told once, at its place, with its code.
//!
//! A case is a file of `tests/cases/slips`: the name of the sound program beside it, then hunks parted by empty lines.
//! Lines with `-` are replaced by those with `+`; lines with `=` stay. Below a line, `^^^ E0101` says what is told of it:
//! the code, and the columns of the first line of the place.

use crate::program::{self, NoFiles};
use btc::diagnostic::{Applicability, Diagnostic};
use btc::driver::check;
use btc::driver::load::{Loaded, load};
use btc::source::Span;
use rayon::prelude::*;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// A line, its first and last column in characters, and a code.
type Told = (usize, usize, usize, String);

/// A program with slips, and what should be told of it.
struct Case {
    text: String,
    told: BTreeSet<Told>,
}

fn case(path: &Path) -> Case {
    let case = fs::read_to_string(path).unwrap();
    let (base, hunks) = case.split_once('\n').unwrap();
    let base = path.with_file_name(format!("{base}.bt"));
    let mut text = fs::read_to_string(&base).unwrap();
    let mut marks = Vec::new();
    for hunk in hunks.split("\n\n") {
        let of = |signs: &[&str]| -> String {
            let lines = hunk.lines().filter_map(|line| {
                let (sign, rest) = line.split_at_checked(1)?;
                let rest = rest.strip_prefix(' ').unwrap_or(rest);
                signs.contains(&sign).then(|| format!("{rest}\n"))
            });
            lines.collect()
        };
        let (old, new) = (of(&["-", "="]), of(&["+", "="]));
        let at = text.find(&old).unwrap_or_else(|| {
            panic!("{}: not in the program:\n{old}", path.display());
        });
        assert_eq!(text.matches(&old).count(), 1, "{}: {old}", path.display());
        text.replace_range(at..at + old.len(), &new);
        marks.push(hunk.to_owned());
    }
    let mut told = BTreeSet::new();
    for hunk in marks {
        let mut new = String::new();
        let mut above = 0;
        let mut found = Vec::new();
        for line in hunk.lines() {
            match line.split_at_checked(2) {
                Some(("+ " | "= ", rest)) => {
                    new.push_str(rest);
                    new.push('\n');
                    above += 1;
                }
                Some(("  ", mark)) => {
                    let start = mark.find('^').unwrap();
                    let width = mark.matches('^').count();
                    let code = mark.split_whitespace().next_back().unwrap();
                    found.push((above, start + 1, start + width, code.to_owned()));
                }
                _ if line == "+" => {
                    new.push('\n');
                    above += 1;
                }
                _ => {}
            }
        }
        let at = text.find(&new).unwrap();
        let before = text[..at].matches('\n').count();
        told.extend(
            found
                .into_iter()
                .map(|(line, from, to, code)| (before + line, from, to, code)),
        );
    }
    Case { text, told }
}

/// What is told of a program, by place.
fn told(loaded: &Loaded, path: &Path) -> BTreeSet<Told> {
    let text = loaded.sources.get(loaded.main).unwrap().text.as_str();
    let found: Vec<Told> = loaded
        .diagnostics
        .iter()
        .map(|found| {
            let range = found.span().range();
            assert_eq!(found.span().file, loaded.main, "{}", path.display());
            let before = &text[..range.start];
            let line = before.matches('\n').count() + 1;
            let start = before.rfind('\n').map_or(0, |at| at + 1);
            let from = text[start..range.start].chars().count() + 1;
            let first = text[range].lines().next().unwrap_or_default();
            let to = from + first.chars().count().max(1) - 1;
            (line, from, to, found.code.to_string())
        })
        .collect();
    let set: BTreeSet<Told> = found.iter().cloned().collect();
    assert_eq!(set.len(), found.len(), "{}: told twice", path.display());
    set
}

/// What came of a slip.
struct Tried {
    path: PathBuf,
    expected: BTreeSet<Told>,
    found: BTreeSet<Told>,
    shown: String,
    /// How many fixes are offered.
    offered: usize,
    /// Whether there is a fix for all that is wrong that may be applied unseen.
    fixed: bool,
    /// What is wrong with the fixes.
    unfit: Vec<String>,
}

/// Each slip, tried once.
static TRIED: LazyLock<Vec<Tried>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/slips");
    let paths = fs::read_dir(folder).unwrap();
    let paths = paths.map(|entry| entry.unwrap().path());
    let mut paths: Vec<PathBuf> = paths
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "slip")
        })
        .collect();
    paths.sort();
    paths.into_par_iter().map(tried).collect()
});

fn tried(path: PathBuf) -> Tried {
    let Case {
        text,
        told: expected,
    } = case(&path);
    let loaded = load("slip.bt", text.into(), &mut NoFiles);
    let (found, shown) = (told(&loaded, &path), program::shown(&loaded));
    let fixes = loaded.diagnostics.iter().flat_map(|found| &found.fixes);
    let offered = fixes.clone().count();
    let mut unfit = Vec::new();
    for fix in fixes {
        let after = edited(&loaded, &fix.edits);
        if errors(&after) > errors(&loaded) {
            unfit.push(format!("{}\n{}", fix.title, program::shown(&after)));
        }
    }
    let safe = |found: &Diagnostic| {
        let mut fixes = found.fixes.iter();
        fixes.any(|fix| fix.applicability == Applicability::Safe)
    };
    let mut wrong = loaded.diagnostics.iter().filter(|found| found.is_error());
    let fixed = errors(&loaded) > 0 && wrong.all(safe);
    if fixed {
        let mut after = loaded;
        for _ in 0..ROUNDS {
            let edits = check::fixes(&after);
            if !edits.is_empty() {
                after = edited(&after, &edits);
            }
        }
        if errors(&after) > 0 {
            unfit.push(program::shown(&after));
        }
    }
    Tried {
        path,
        expected,
        found,
        shown,
        offered,
        fixed,
        unfit,
    }
}

/// How many times the fixes are applied that may be applied unseen.
const ROUNDS: usize = 8;

/// The text after edits, which do not overlap.
fn edited(loaded: &Loaded, edits: &[(Span, String)]) -> Loaded {
    let texts = loaded.texts(edits);
    let text = texts[&loaded.main].text.clone();
    load("slip.bt", text.into(), &mut NoFiles)
}

fn errors(loaded: &Loaded) -> usize {
    let found = loaded.diagnostics.iter();
    found.filter(|found| found.is_error()).count()
}

#[test]
fn each_slip_is_told_at_its_place() {
    let (mut single, mut several) = (0, 0);
    let mut wrong = Vec::new();
    for Tried {
        path,
        expected,
        found,
        ..
    } in TRIED.iter()
    {
        match expected.len() {
            0 => panic!("{}: nothing is expected", path.display()),
            1 => single += 1,
            _ => several += 1,
        }
        if found != expected {
            let name = path.file_name().unwrap();
            wrong.push(format!("{name:?}: {expected:?}, but told was {found:?}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(single >= 80 && several >= 20, "{single} and {several}");
}

#[test]
fn slips_are_told_in_these_words() {
    crate::snapshot::settings().bind(|| {
        insta::glob!("..", "cases/slips/*.slip", |path| {
            let tried = TRIED
                .iter()
                .find(|tried| tried.path.file_name() == path.file_name());
            insta::assert_snapshot!("slip", tried.unwrap().shown);
        });
    });
}

/// What `btc check --fix` does leaves nothing wrong where it has a fix for all that is wrong; and no fix that is offered
/// makes more mistakes than there were.
#[test]
fn fixes_lead_to_sound_programs() {
    let (mut fixed, mut offered) = (0, 0);
    for tried in TRIED.iter() {
        let path = tried.path.display();
        assert!(tried.unfit.is_empty(), "{path}: {}", tried.unfit.join("\n"));
        fixed += usize::from(tried.fixed);
        offered += tried.offered;
    }
    assert!(fixed >= 30 && offered >= 200, "{fixed} and {offered}");
}

/// Nothing is said against sound programs: those that the slips are made in, and forty of many kinds.
#[test]
fn sound_programs_are_not_warned_of() {
    let mut sound = 0;
    for folder in ["slips", "sound"] {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests/cases")
            .join(folder);
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "bt") {
                let text = fs::read_to_string(&path).unwrap();
                let loaded = load("sound.bt", text.into(), &mut NoFiles);
                assert_eq!(program::shown(&loaded), "", "{}", path.display());
                sound += 1;
            }
        }
    }
    assert!(sound >= 42, "{sound}");
}
