//! The parser that is committed is the one of the grammar; it makes the trees that the corpus says, reads every sound program
//! of the repository, and what is coloured is what the queries say.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use tree_sitter::{Node, Query, QueryCursor, StreamingIterator, Tree};
use tree_sitter_behaviortree_check::{folder, generated, language, parsed};

#[test]
fn the_parser_is_up_to_date() {
    for (new, committed) in generated() {
        let same = fs::read(&new).unwrap() == fs::read(&committed).unwrap_or_default();
        assert!(
            same,
            "{}: `cargo run` in editors/tree-sitter-bt/check",
            committed.display()
        );
    }
}

/// The cases of a file of the corpus, as `tree-sitter test` reads it: name, text, tree.
fn cases(file: &str) -> Vec<(String, String, String)> {
    let lines: Vec<&str> = file.lines().collect();
    let heads: Vec<usize> = (0..lines.len().saturating_sub(2))
        .filter(|&at| lines[at].starts_with("===") && lines[at + 2].starts_with("==="))
        .collect();
    let ends = heads.iter().skip(1).copied().chain([lines.len()]);
    heads
        .iter()
        .zip(ends)
        .map(|(&head, end)| {
            let body = &lines[head + 3..end];
            let split = body.iter().position(|line| line.starts_with("---"));
            let split = split.unwrap_or_else(|| panic!("{} has no tree", lines[head + 1]));
            (
                lines[head + 1].to_owned(),
                body[..split].join("\n"),
                body[split + 1..].join("\n"),
            )
        })
        .collect()
}

/// A tree as the corpus writes it, without regard to blanks.
fn squeezed(tree: &str) -> String {
    let words: Vec<&str> = tree.split_whitespace().collect();
    words.join(" ").replace("( ", "(").replace(" )", ")")
}

#[test]
fn the_corpus_has_its_trees() {
    let mut seen = 0;
    for path in files(&folder().join("test/corpus"), "txt") {
        for (name, text, tree) in cases(&fs::read_to_string(&path).unwrap()) {
            let found = parsed(&text).root_node().to_sexp();
            assert_eq!(
                squeezed(&found),
                squeezed(&tree),
                "{}: {name}",
                path.display()
            );
            seen += 1;
        }
    }
    assert!(seen >= 19, "{seen}");
}

fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path, extension));
        } else if path.extension().is_some_and(|it| it == extension) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The programs of the repository in which nothing is wrong but what they mean: the sound ones, the wrong ones of which btc says
/// no mistake in how they are written (`E01…`), and the examples of the reference that are whole items.
fn programs() -> Vec<(String, String)> {
    let root = folder().join("../..");
    let sound = [
        "examples",
        "src/library",
        "tests/worlds",
        "tests/cases/diff",
        "tests/cases/export",
        "tests/cases/run",
        "tests/cases/sound",
        "tests/cases/suggest",
        "tests/cases/tested",
        "tests/cases/world",
    ];
    let mut paths: Vec<PathBuf> = sound
        .iter()
        .flat_map(|folder| files(&root.join(folder), "bt"))
        .collect();
    let mut wrong = files(&root.join("tests/cases/check"), "bt");
    wrong.retain(|path| {
        let name = path.file_name().unwrap().to_str().unwrap();
        let told = fs::read_to_string(root.join(format!("snapshots/check@{name}.snap"))).unwrap();
        !told.contains("[E01")
    });
    assert!(wrong.len() > 150, "{}", wrong.len());
    paths.extend(wrong);
    let read = |path: PathBuf| {
        (
            path.display().to_string(),
            fs::read_to_string(path).unwrap(),
        )
    };
    let mut programs: Vec<(String, String)> = paths.into_iter().map(read).collect();
    let mut chapters = files(&root.join("docs/book/src/language"), "md");
    chapters.push(root.join("docs/book/src/language.md"));
    let chapters = chapters
        .iter()
        .map(|path| fs::read_to_string(path).unwrap());
    let reference: String = chapters.collect();
    for (n, block) in reference.split("\n```bt").skip(1).enumerate() {
        let (kind, text) = block.split_once('\n').unwrap();
        if matches!(kind.trim().split(' ').next(), Some("" | "items" | "wrong")) {
            let text = text.split("```").next().unwrap().to_owned();
            programs.push((format!("example {} of the reference", n + 1), text));
        }
    }
    programs
}

/// The first node that is a mistake.
fn mistake(tree: &Tree) -> Option<Node<'_>> {
    fn first(node: Node<'_>) -> Option<Node<'_>> {
        if node.is_error() || node.is_missing() {
            return Some(node);
        }
        let children: Vec<Node> = (0..node.child_count())
            .filter_map(|at| node.child(at))
            .collect();
        children
            .into_iter()
            .filter(|child| child.has_error())
            .find_map(first)
    }
    first(tree.root_node())
}

#[test]
fn every_sound_program_is_read_without_a_mistake() {
    let programs = programs();
    assert!(programs.len() > 200, "{}", programs.len());
    let mut wrong = Vec::new();
    for (name, text) in &programs {
        let tree = parsed(text);
        if let Some(found) = mistake(&tree) {
            let (place, line) = (
                found.start_position(),
                text.lines().nth(found.start_position().row),
            );
            wrong.push(format!(
                "{name}:{}:{}: {}",
                place.row + 1,
                place.column + 1,
                line.unwrap_or_default()
            ));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The words of the grammar that is the language's own stand in this one, too.
#[test]
fn no_word_of_the_language_is_missing() {
    let pest = fs::read_to_string(folder().join("../../grammar/bt.pest")).unwrap();
    let grammar = fs::read_to_string(folder().join("grammar.js")).unwrap();
    let scanner = fs::read_to_string(folder().join("src/scanner.c")).unwrap();
    let mut words = 0;
    for line in pest
        .lines()
        .filter(|line| line.starts_with("kw_") || line.starts_with("factor_name"))
    {
        for word in line.split('"').skip(1).step_by(2) {
            let quoted = format!("\"{word}\"");
            assert!(
                grammar.contains(&quoted) || scanner.contains(&quoted),
                "{word}"
            );
            words += 1;
        }
    }
    assert!(words > 60, "{words}");
}

#[test]
fn what_is_coloured_is_what_the_queries_say() {
    let queries = fs::read_to_string(folder().join("queries/highlights.scm")).unwrap();
    let query = Query::new(&language(), &queries).unwrap();
    for path in files(&folder().join("test/highlight"), "bt") {
        let text = fs::read_to_string(&path).unwrap();
        let tree = parsed(&text);
        let mut cursor = QueryCursor::new();
        let mut captures = cursor.captures(&query, tree.root_node(), text.as_bytes());
        // Of several patterns the last one counts, as in Neovim and Helix.
        let mut colours: Vec<(tree_sitter::Range, String)> = Vec::new();
        while let Some((found, at)) = captures.next() {
            let capture = found.captures[*at];
            let name = query.capture_names()[capture.index as usize].to_owned();
            colours.push((capture.node.range(), name));
        }
        let mut lines = text.lines().enumerate();
        let (mut above, mut asked) = (0, BTreeSet::new());
        for (row, line) in &mut lines {
            // `//    ^^^^ keyword`, as `tree-sitter test` reads it.
            let Some((before, name)) = line
                .strip_prefix("//")
                .and_then(|rest| rest.rsplit_once("^ "))
            else {
                above = row;
                continue;
            };
            let column = 2 + before.find('^').unwrap_or(before.len());
            let here = colours.iter().rfind(|(range, _)| {
                let (from, to) = (range.start_point, range.end_point);
                (from.row, from.column) <= (above, column) && (above, column) < (to.row, to.column)
            });
            let here = here.map_or("nothing", |(_, name)| name.as_str());
            assert_eq!(
                here,
                name.trim(),
                "{}:{}: {}",
                path.display(),
                row + 1,
                line
            );
            asked.insert(name.trim().to_owned());
        }
        assert!(asked.len() > 15, "{asked:?}");
    }
}
