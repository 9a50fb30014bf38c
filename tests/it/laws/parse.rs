//! No text makes the parser panic, or stay silent about what it does not understand.

use btc::diagnostic::Diagnostic;
use btc::source::FileId;
use btc::syntax::ast::{ItemKind, WorldEntryKind};
use btc::syntax::{parse, print};

/// The law.
pub fn holds(bytes: &[u8]) {
    swallow(&String::from_utf8_lossy(bytes));
}

/// Parses a text, and formats what parses.
pub(crate) fn swallow(text: &str) {
    let (file, diagnostics) = parse(FileId(0), text);
    for diagnostic in &diagnostics {
        for label in &diagnostic.labels {
            assert!(
                text.get(label.span.range()).is_some(),
                "{:?} of {text:?}",
                label.span
            );
        }
        for (span, _) in diagnostic.fixes.iter().flat_map(|fix| &fix.edits) {
            assert!(text.get(span.range()).is_some(), "{span:?} of {text:?}");
        }
    }
    let has_error = file.items.iter().any(|item| match &item.kind {
        ItemKind::Error => true,
        ItemKind::World(world) => world
            .entries
            .iter()
            .any(|entry| entry.kind == WorldEntryKind::Error),
        _ => false,
    });
    // What is not understood is an error, not what is warned of only.
    let told = diagnostics.iter().any(Diagnostic::is_error);
    assert!(told || !has_error, "a silent error in {text:?}");
    if diagnostics.is_empty() {
        print::format(text).unwrap();
    }
}
