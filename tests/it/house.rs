//! The walls of the house: which room may know which, read off the `use crate::` lines.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The table of `ARCHITECTURE.md`: each room of the crate with the rooms that it may use.
fn plan() -> BTreeMap<String, BTreeSet<String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("ARCHITECTURE.md");
    let text = fs::read_to_string(path).unwrap();
    let rows = text.lines().filter_map(|line| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let [_, place, _, uses, _] = cells.as_slice() else {
            return None;
        };
        let place = place.strip_prefix("`src/")?;
        let room = place.split(['/', '.', '`']).next().unwrap().to_owned();
        let uses = uses.split(',').map(|room| room.trim().to_owned());
        let uses = uses
            .filter(|room| !room.is_empty() && room != "–")
            .collect();
        (room != "library").then_some((room, uses))
    });
    rows.collect()
}

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

/// A room uses what its row says: no other room, and none that the row names in vain.
#[test]
fn rooms_use_what_the_plan_says() {
    let plan = plan();
    let mut there: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (room, _, text) in files() {
        let used = used(&text).into_iter();
        let others = used.filter(|other| *other != room && plan.contains_key(other));
        let others: Vec<String> = others.collect();
        there.entry(room).or_default().extend(others);
    }
    let rooms: Vec<&String> = there.keys().collect();
    assert_eq!(rooms, plan.keys().collect::<Vec<_>>());
    for (room, uses) in &plan {
        assert_eq!(
            &there[room], uses,
            "{room} uses (left), and the plan (right)"
        );
    }
}

/// No room uses, through others, itself.
#[test]
fn no_room_imports_upwards() {
    let mut plan = plan();
    while !plan.is_empty() {
        let free = plan
            .iter()
            .find(|(_, uses)| uses.iter().all(|room| !plan.contains_key(room)));
        let free = free.map(|(room, _)| room.clone());
        let free = free.unwrap_or_else(|| panic!("a circle among {:?}", plan.keys()));
        plan.remove(&free);
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
