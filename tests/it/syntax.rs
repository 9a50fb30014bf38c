//! Texts that parse and texts that do not.

use btc::diagnostic::render;
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
