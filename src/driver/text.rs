//! A text as a command gets it.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{FileId, Source, Sources, Span};

/// The bytes of a file with its name.
#[derive(Clone, Copy, Debug)]
pub struct Text<'t> {
    /// The name in diagnostics.
    pub name: &'t str,
    /// The bytes, which may not be UTF-8.
    pub bytes: &'t [u8],
}

/// Adds a text to the sources, with a diagnostic if its bytes are not UTF-8.
pub(super) fn decode(sources: &mut Sources, text: Text) -> (FileId, Option<Diagnostic>) {
    match std::str::from_utf8(text.bytes) {
        Ok(valid) => (sources.add(Source::new(text.name, valid)), None),
        Err(error) => {
            let at = error.valid_up_to();
            let lossy = String::from_utf8_lossy(text.bytes);
            let file = sources.add(Source::new(text.name, lossy));
            let span = Span::new(file, at, at + '\u{fffd}'.len_utf8());
            let marked =
                text.bytes.starts_with(&[0xff, 0xfe]) || text.bytes.starts_with(&[0xfe, 0xff]);
            let diagnostic = if marked {
                Diagnostic::new(Code::E0130, span, "the file is in UTF-16, not in UTF-8")
                    .label("this mark at its beginning says so")
                    .help("save it as UTF-8")
            } else {
                Diagnostic::new(Code::E0130, span, "the file is not text (UTF-8)")
                    .label("this byte is not part of a character")
            };
            (file, Some(diagnostic))
        }
    }
}
