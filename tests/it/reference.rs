//! The examples of the book's chapters on the language, `docs/book/src/language.md` and `language/`.
//!
//! The words after `bt` say what a block is: nothing, a whole program; `items`, added to the program of the first
//! chapter, as everything below; `wrong CODE`, items with that one mistake; else what it is a part of, or `expressions`,
//! one a line.

use crate::book::pages::{blocks, pages};
use crate::program::{NoFiles, shown};
use btc::diagnostic::{Code, Diagnostic};
use btc::driver::Text;
use btc::driver::format::format;
use btc::driver::load::{Loaded, load};

/// A block of a chapter.
struct Example {
    /// The chapter, and the line that it begins after.
    place: String,
    /// The words after `bt`.
    kind: String,
    text: String,
}

/// The chapters, the first one first.
fn chapters() -> Vec<(String, String)> {
    let chapters = pages().into_iter().map(|page| (page.name, page.text));
    let chapters: Vec<_> = chapters
        .filter(|(name, _)| name.starts_with("language"))
        .collect();
    assert_eq!(chapters[0].0, "language.md");
    chapters
}

/// All that they say.
fn text() -> String {
    chapters().into_iter().map(|(_, text)| text).collect()
}

fn examples() -> Vec<Example> {
    let mut examples = Vec::new();
    for (name, text) in chapters() {
        for block in blocks(&text) {
            if let Some(kind) = block.info.strip_prefix("bt") {
                examples.push(Example {
                    place: format!("{name}:{}", block.line),
                    kind: kind.trim().to_owned(),
                    text: block.text.to_owned(),
                });
            }
        }
    }
    examples
}

/// A robot that says all it must.
const ROBOT: &str =
    "body = disc(17 cm) drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)";

/// The program that an example stands in.
fn program(example: &Example, world: &str) -> String {
    let text = &example.text;
    let field = "tick = 100 ms";
    let arena = "arena = rect((0 m, 0 m), (6 m, 4 m)) place nest = disc((1 m, 1 m), 20 cm)";
    match example.kind.split(' ').next().unwrap() {
        "" => text.clone(),
        "items" | "wrong" => format!("{world}\n{text}"),
        "world" => format!("world w {{ {field}\n{text}\nrobot r {{ {ROBOT} }} }}"),
        "robot" => format!("world w {{ {field} {arena} robot r {{\n{text}}} }}"),
        "task" => {
            let rest =
                "choose goto(shed), goto(gate), dock(charger) history last 1 success, failure";
            let reward = match text.contains("reward {") {
                true => "",
                false => "reward { otherwise: -1 }",
            };
            let more = format!("end after 1 h {reward}");
            format!("{world}\ntask example {{ {rest}\n{text}\n{more} }}")
        }
        "learner" => format!("{world}\nlearn haul {{\n{text}}}"),
        "statements" => format!("{world}\non charged {{\n{text}}}"),
        "expressions" => {
            let lines = text.lines().enumerate();
            let items = lines.map(|(i, line)| format!("let example_{i} = {line}\n"));
            format!("{world}\n{}", items.collect::<String>())
        }
        kind => panic!("{}: no block is `bt {kind}`", example.place),
    }
}

fn loaded(example: &Example, world: &str) -> Loaded {
    load("example.bt", program(example, world).into(), &mut NoFiles)
}

fn world() -> String {
    let first = examples()
        .into_iter()
        .find(|example| example.kind.is_empty());
    first.expect("the first chapter has a program").text
}

#[test]
fn the_examples_are_right() {
    let world = world();
    for example in examples() {
        let loaded = loaded(&example, &world);
        // What a part of a program declares, others would use.
        let whole = example.kind.is_empty();
        let counts = |found: &&Diagnostic| {
            whole || found.is_error() || example.kind.contains(found.code.name())
        };
        let found = loaded.diagnostics.iter().filter(counts);
        let found: Vec<Code> = found.map(|found| found.code).collect();
        match example.kind.strip_prefix("wrong ") {
            None => assert!(found.is_empty(), "{}:\n{}", example.place, shown(&loaded)),
            Some(code) => {
                let expected = Code::parse(code).expect("a code");
                let said = shown(&loaded);
                assert_eq!(found, [expected], "{}:\n{said}", example.place);
            }
        }
    }
}

#[test]
fn the_examples_are_laid_out() {
    for example in examples() {
        if matches!(example.kind.split(' ').next(), Some("" | "items" | "wrong")) {
            let text = format(Text {
                name: "example.bt",
                bytes: example.text.as_bytes(),
            })
            .expect("it parses");
            assert_eq!(example.text, text, "{}", example.place);
        }
    }
}

/// Every built-in name and every setting that the checker offers is in them.
#[test]
fn the_chapters_name_everything() {
    let settings = "method episodes rate initial objective discount explore unseen dwell seed";
    let words = "selector sequence parallel invert succeed fail retry repeat timeout memory";
    let page = text();
    for word in settings.split(' ').chain(words.split(' ')) {
        assert!(page.contains(&format!("`{word}")), "{word}");
    }
    let names: Vec<&str> = btc::check::built_in_names().collect();
    assert!(names.len() > 50, "{names:?}");
    for name in names {
        assert!(page.contains(name), "{name}");
    }
}

/// The table of library behaviours holds what the library declares.
#[test]
fn the_chapters_list_the_library() {
    let library = include_str!("../../src/library/std.bt");
    let page = text();
    let heads = library
        .lines()
        .filter_map(|line| line.strip_prefix("behavior "));
    for head in heads {
        let head = head.trim_end_matches('{').trim();
        assert!(page.contains(&format!("| `{head}` |")), "{head}");
    }
}
