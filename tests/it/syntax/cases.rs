//! Texts that parse and texts that do not.

use btc::diagnostic::{Code, render};
use btc::source::{FileId, Source, Sources};
use btc::syntax;

/// What a person is shown for `text`.
fn shown(name: &str, text: &str) -> String {
    let (_, diagnostics) = syntax::parse(FileId(0), text);
    let mut sources = Sources::default();
    sources.add(Source::new(name, text));
    render::human(&sources, &diagnostics, false)
}

#[test]
fn the_examples_parse() {
    for name in ["delivery_small.bt", "delivery_large.bt"] {
        let path = format!("{}/examples/{name}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        assert_eq!(shown(name, &text), "");
    }
}

#[test]
fn each_explanation_shows_its_mistake() {
    // A file that is not text, or too much of it, is refused before the parser sees it.
    let before = [Code::E0130, Code::E0132];
    let of_syntax = |code: &&Code| code.name().starts_with("E01") && !before.contains(code);
    for &code in Code::ALL.iter().filter(of_syntax) {
        let explanation = code.explanation();
        assert!(
            explanation.starts_with(&format!("# {code}: {}\n", code.title())),
            "{code}"
        );
        let example = |after: &str| {
            let start = explanation.find(after).unwrap() + after.len();
            let end = explanation[start..].find("\n```").unwrap();
            &explanation[start..start + end]
        };
        let wrong = example("Wrong:\n\n```bt\n");
        let codes: Vec<Code> = syntax::parse(FileId(0), wrong)
            .1
            .iter()
            .map(|mistake| mistake.code)
            .collect();
        println!("{}", shown("wrong", wrong));
        assert!(
            !codes.is_empty() && codes.iter().all(|&found| found == code),
            "{code} provokes {codes:?}"
        );
        assert_eq!(shown("right", example("Right:\n\n```bt\n")), "", "{code}");
    }
}

#[test]
fn the_examples_are_formatted() {
    for name in ["delivery_small.bt", "delivery_large.bt"] {
        let path = format!("{}/examples/{name}", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(path).unwrap();
        let formatted = syntax::print::format(&text).unwrap();
        assert_eq!(formatted, text);
    }
}

/// Six mistakes, each reported once, on its own token.
#[test]
fn six_mistakes_are_six_diagnostics() {
    let text = "\
state carrying bool = false
event low = battery <= 25 pct
behaviour rest { succeed when low }
tree expert = fallback {
    low => rest
    goto(A),
}
each tick { battery -= 0.1%
";
    let mut sources = Sources::default();
    let id = sources.add(Source::new("six.bt", text));
    let found: Vec<(usize, usize, &str, &str)> = syntax::parse(id, text)
        .1
        .iter()
        .map(|mistake| {
            let (line, column) = sources.get(id).unwrap().position(mistake.span().start);
            (
                line + 1,
                column + 1,
                &text[mistake.span().range()],
                mistake.code.name(),
            )
        })
        .collect();
    let expected = [
        (1, 16, "bool", "E0101"),
        (2, 27, "pct", "E0114"),
        (3, 1, "behaviour", "E0105"),
        (4, 15, "fallback", "E0120"),
        (6, 5, "goto", "E0112"),
        (8, 11, "{", "E0102"),
    ];
    assert_eq!(found, expected);
}

#[test]
fn programs_read_json() {
    let text = "// λ𝄞\nstate a == 1";
    let mut sources = Sources::default();
    let id = sources.add(Source::new("a.bt", text));
    let line = render::json(&sources, &syntax::parse(id, text).1);
    let value: serde_json::Value = serde_json::from_str(&line).unwrap();
    assert_eq!(value["code"], "E0108");
    assert_eq!(
        value["labels"][0]["span"]["start"],
        serde_json::json!({"line": 2, "column": 9, "column_utf16": 9})
    );
    assert_eq!(
        value["labels"][0]["span"]["bytes"],
        serde_json::json!([18, 20])
    );
    assert_eq!(value["fixes"][0]["edits"][0]["replacement"], "=");
}

/// One file a case: what a person is shown, or the formatted text if nothing is wrong.
#[test]
fn cases() {
    crate::snapshot::settings().bind(|| {
        insta::glob!("../../cases/syntax", "*.bt", |path| {
            let text = std::fs::read_to_string(path).unwrap();
            let name = path.file_name().unwrap().to_string_lossy();
            let answer = match syntax::print::format(&text) {
                Ok(formatted) => formatted,
                Err(_) => shown(&name, &text),
            };
            insta::assert_snapshot!("syntax", answer);
        });
    });
}
