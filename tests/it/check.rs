//! Wrong programs, one in each file of `tests/cases/check`, and what a person is shown of them.

use crate::program::{self, NoFiles};
use btc::diagnostic::{Applicability, Code, Diagnostic};
use btc::driver::load::{Loaded, load};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The wrong programs, in the order of their names.
fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/check");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

fn loaded(path: &Path) -> Loaded {
    program::named(path.file_name().unwrap().to_str().unwrap(), path)
}

#[test]
fn wrong_programs_show_their_mistakes() {
    crate::snapshot::settings().bind(|| {
        insta::glob!("..", "cases/check/*.bt", |path| {
            insta::assert_snapshot!("check", program::shown(&loaded(path)));
        });
    });
}

/// What a case is for: it provokes something, and nothing twice.
#[test]
fn every_case_has_a_mistake_and_none_twice() {
    for path in cases() {
        let loaded = loaded(&path);
        assert!(!loaded.diagnostics.is_empty(), "{}", path.display());
        let mut places = BTreeSet::new();
        for found in &loaded.diagnostics {
            let span = found.span();
            let missing = matches!(found.code, Code::E0402 | Code::E0502 | Code::E0406);
            assert!(
                places.insert((span.file, span.start, span.end)) || missing,
                "{}: two messages at one place: {}",
                path.display(),
                found.message
            );
        }
    }
}

/// A fix that may be applied unseen takes its mistake away and brings no other.
#[test]
fn safe_fixes_mend() {
    mended(Applicability::Safe, 3);
}

/// A likely guess takes its own mistake away as well; what it brings to light may be another.
#[test]
fn likely_fixes_mend() {
    mended(Applicability::Unsafe, 20);
}

fn mended(applicability: Applicability, least: usize) {
    let mut tried = 0;
    for path in cases() {
        let before = loaded(&path);
        for found in &before.diagnostics {
            for fix in &found.fixes {
                if fix.applicability != applicability {
                    continue;
                }
                tried += 1;
                let mut text = std::fs::read_to_string(&path).unwrap();
                let mut edits = fix.edits.clone();
                edits.sort_by_key(|(span, _)| std::cmp::Reverse(span.start));
                for (span, new) in &edits {
                    assert_eq!(span.file, before.main, "{}", path.display());
                    text.replace_range(span.range(), new);
                }
                let after = program::with_text(&path, text);
                let same = |other: &&Diagnostic| {
                    other.code == found.code && other.span().start == found.span().start
                };
                let left = after.diagnostics.iter().find(same);
                assert_eq!(left, None, "{}: {}", path.display(), fix.title);
                if applicability == Applicability::Safe {
                    assert!(
                        after.diagnostics.len() < before.diagnostics.len(),
                        "{}: {}",
                        path.display(),
                        fix.title
                    );
                }
            }
        }
    }
    assert!(tried >= least, "{tried} fixes were tried");
}

/// Six mistakes in syntax, names, units, tasks and trees are six messages, each on its token.
#[test]
fn six_planted_mistakes_are_six_diagnostics() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/check");
    let loaded = loaded(&folder.join("plants_six_mistakes.bt"));
    let found: Vec<(Code, &str)> = loaded
        .diagnostics
        .iter()
        .map(|found| (found.code, loaded.sources.text(found.span())))
        .collect();
    assert_eq!(
        found,
        [
            (Code::E0101, "bool"),
            (Code::E0301, "30"),
            (Code::E0202, "neer"),
            (Code::E0203, "low"),
            (Code::E0309, "1.5"),
            (Code::E0601, "battery <= 25%"),
        ]
    );
}

/// Names in backquotes are found under their declared names.
#[test]
fn quoted_names_are_names() {
    let text = "use std
world yard {
    tick  = 100 ms
    arena = rect((0 m, 0 m), (6 m, 4 m))
    place `the gate` = disc((1 m, 1 m), 15 cm) facing 0 deg
    wall `a wall` = line((2 m, 1 m), (2 m, 2 m))
    robot `r 2` {
        body  = disc(17 cm)
        drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)
        sensor `the eye` = range_finder(at = 0 deg, range = 2 m)
    }
}
state `is it` : bool = false
event `came in` = success(goto(`the gate`)) and not `is it`
on `came in` { `is it` = true }
predicate `near it` = distance(`a wall`) < distance(`the eye`)
task `the task` {
    observe `near it`
    choose goto(`the gate`), dock(`the gate`)
    end after 10 s
    reward { on `came in`: 1 otherwise: 0 }
}
learn `a tree` for `the task` { episodes = 10 }
tree `by hand` for `the task` = selector { `near it` => goto(`the gate`), dock(`the gate`) }
claim `by hand` equals `a tree`
claim `by hand` reaches `came in` within 5 s
";
    let loaded = load("quoted.bt", text.into(), &mut NoFiles);
    assert_eq!(program::shown(&loaded), "");
    let program = &loaded.program;
    assert_eq!(program.behaviors.len(), 2);
    assert_eq!(program.trees.len(), 1);
    assert_eq!(program.claims.len(), 2);
}
