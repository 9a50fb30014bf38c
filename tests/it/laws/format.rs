//! What the formatter lays out is the same program, with the same comments, and stays as it is.

use btc::source::FileId;
use btc::syntax::{ast, parse, print};

/// The law.
pub fn holds(bytes: &[u8]) {
    kept(&String::from_utf8_lossy(bytes));
}

/// A text that parses keeps its tree and its comments, and so it does without them.
pub(crate) fn kept(text: &str) {
    let Some(tree) = items(text) else {
        return;
    };
    let once = print::format(text).unwrap();
    let again = items(&once);
    let changed = first_difference(&tree, &again.unwrap_or_default());
    assert!(
        changed.is_empty(),
        "the tree changed:\n{changed}\n{}",
        first_difference(text, &once)
    );
    assert_eq!(comments(text), comments(&once));
    let twice = print::format(&once).unwrap();
    assert!(
        once == twice,
        "not a fixed point:\n{}",
        first_difference(&once, &twice)
    );
    let (file, _) = parse(FileId(0), text);
    let bare = print::file(&file, None);
    let changed = first_difference(&tree, &items(&bare).unwrap_or_default());
    assert!(
        changed.is_empty(),
        "the bare tree changed:\n{changed}\n{bare}"
    );
}

/// The items of a text that parses, without their places.
fn items(text: &str) -> Option<String> {
    let (file, diagnostics) = parse(FileId(0), text);
    diagnostics.is_empty().then(|| without_places(&file))
}

fn without_places(file: &ast::File) -> String {
    let shown = format!("{:#?}", file.items);
    let is_place = |word: &str| {
        word.split_once("..")
            .is_some_and(|(start, end)| [start, end].iter().all(|part| part.parse::<u32>().is_ok()))
    };
    shown
        .lines()
        .filter(|line| {
            !is_place(
                line.trim()
                    .trim_start_matches("span: ")
                    .trim_end_matches(','),
            )
        })
        .collect::<Vec<_>>()
        .join("\n")
}

/// The comments of a text, without their slashes, in the order of the alphabet.
fn comments(text: &str) -> Vec<String> {
    let (file, _) = parse(FileId(0), text);
    let mut texts: Vec<String> = file
        .comments
        .iter()
        .map(|comment| {
            comment
                .text
                .trim_start_matches(['/', '!'])
                .trim()
                .to_owned()
        })
        .collect();
    texts.sort();
    texts
}

/// The first lines in which two texts differ, with those before them.
fn first_difference(left: &str, right: &str) -> String {
    if left == right {
        return String::new();
    }
    let (left, right): (Vec<&str>, Vec<&str>) = (left.lines().collect(), right.lines().collect());
    let at = left.iter().zip(&right).take_while(|(a, b)| a == b).count();
    let part = |lines: &[&str]| lines[at.saturating_sub(3)..lines.len().min(at + 3)].join("\n");
    format!("{}\n--- became\n{}", part(&left), part(&right))
}
