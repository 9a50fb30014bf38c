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
    for &code in Code::ALL.iter().filter(|code| code.name().contains("01")) {
        if !code.name()[1..].starts_with("01") {
            continue;
        }
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
        std::fs::write(format!("/tmp/fmt_{name}"), &formatted).unwrap();
        assert_eq!(formatted, text);
    }
}
