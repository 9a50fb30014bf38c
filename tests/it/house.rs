//! The walls of the house: which room may know which, read off the `use crate::` lines.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Each room with the rooms that it may use; `ARCHITECTURE.md` says the same.
const ROOMS: &[(&str, &[&str])] = &[
    ("source", &[]),
    ("math", &[]),
    ("random", &["math"]),
    ("logic", &[]),
    ("spelling", &[]),
    ("diagnostic", &["source"]),
    ("syntax", &["source", "spelling", "diagnostic"]),
    ("geometry", &["math"]),
    ("ir", &["math", "spelling", "geometry"]),
    (
        "check",
        &["source", "diagnostic", "syntax", "ir", "geometry", "math"],
    ),
    ("eval", &["ir", "math", "random"]),
    ("world", &["ir", "eval", "geometry", "math", "random"]),
    ("policy", &["ir", "spelling", "logic"]),
    ("learn", &["ir", "world", "policy", "math", "random"]),
    ("tree", &["ir", "policy", "logic"]),
    (
        "emit",
        &[
            "ir", "tree", "source", "spelling", "syntax", "geometry", "math",
        ],
    ),
    ("trial", &["ir", "world", "policy", "learn", "tree"]),
    ("simplify", &["ir", "learn", "tree", "trial"]),
    (
        "report",
        &[
            "ir", "geometry", "policy", "learn", "tree", "simplify", "emit",
        ],
    ),
    (
        "driver",
        &[
            "source",
            "diagnostic",
            "syntax",
            "check",
            "ir",
            "world",
            "policy",
            "learn",
            "logic",
            "tree",
            "emit",
            "trial",
            "simplify",
            "report",
        ],
    ),
    (
        "facade",
        &[
            "source",
            "diagnostic",
            "syntax",
            "ir",
            "tree",
            "emit",
            "report",
            "driver",
        ],
    ),
    (
        "cli",
        &[
            "source",
            "spelling",
            "diagnostic",
            "tree",
            "emit",
            "driver",
            "facade",
        ],
    ),
];

/// The Rust files of the crate, each with the room that it stands in.
fn files() -> Vec<(String, PathBuf, String)> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                walk(&path, found);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                found.push(path);
            }
        }
    }
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut paths = Vec::new();
    walk(&src, &mut paths);
    paths.sort();
    paths
        .into_iter()
        .map(|path| {
            let inside = path.strip_prefix(&src).unwrap();
            let first = inside.iter().next().unwrap().to_str().unwrap();
            let room = first.trim_end_matches(".rs").to_owned();
            let text = fs::read_to_string(&path).unwrap();
            (room, path, text)
        })
        .filter(|(room, ..)| room != "lib" && room != "main")
        .collect()
}

/// The rooms that a text names after `crate::`, alone or in braces.
fn used(text: &str) -> Vec<String> {
    let mut rooms = Vec::new();
    for (at, _) in text.match_indices("crate::") {
        let rest = &text[at + "crate::".len()..];
        let names: Vec<&str> = match rest.strip_prefix('{') {
            Some(list) => list.split('}').next().unwrap().split(',').collect(),
            None => vec![rest],
        };
        for name in names {
            let name: String = name
                .trim()
                .chars()
                .take_while(|c| c.is_ascii_alphanumeric() || *c == '_')
                .collect();
            if !name.is_empty() {
                rooms.push(name);
            }
        }
    }
    rooms
}

#[test]
fn no_room_imports_upwards() {
    let allowed: BTreeMap<&str, &[&str]> = ROOMS.iter().copied().collect();
    let mut wrong = Vec::new();
    for (room, path, text) in files() {
        let Some(may) = allowed.get(room.as_str()) else {
            wrong.push(format!(
                "{}: the room `{room}` is not in the plan",
                path.display()
            ));
            continue;
        };
        for name in used(&text) {
            if name != room && !may.contains(&name.as_str()) {
                wrong.push(format!("{} uses `crate::{name}`", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn every_room_of_the_plan_is_there() {
    let files = files();
    for (room, _) in ROOMS {
        assert!(
            files.iter().any(|(there, ..)| there == room),
            "no room `{room}`"
        );
    }
}

#[test]
fn only_the_command_line_and_the_facade_touch_files() {
    let facade = ["std::fs"];
    for (room, path, text) in files() {
        let touches = [
            "std::fs",
            "std::io::stdin",
            "std::env",
            "println!",
            "std::time",
        ];
        for word in touches {
            assert!(
                room == "cli" || room == "facade" && facade.contains(&word) || !text.contains(word),
                "{} says `{word}`",
                path.display()
            );
        }
    }
}

#[test]
fn the_grammar_stays_in_its_room() {
    for (room, path, text) in files() {
        let names_pest = text.contains("pest::") || text.contains("Rule::");
        assert!(
            room == "syntax" || !names_pest,
            "{} knows pest",
            path.display()
        );
    }
}

#[test]
fn transcendental_functions_have_one_place() {
    let calls = [
        ".sin()",
        ".cos()",
        ".tan()",
        ".asin()",
        ".acos()",
        ".atan()",
        ".atan2(",
        ".exp()",
        ".ln()",
        ".powf(",
        ".hypot(",
        ".sin_cos()",
        ".mul_add(",
        "libm::",
    ];
    for (room, path, text) in files() {
        for call in calls {
            assert!(
                room == "math" || !text.contains(call),
                "{} calls `{call}`",
                path.display()
            );
        }
    }
}
