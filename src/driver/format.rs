//! `btc fmt`

use super::load::{MOST, too_large};
use super::refused::Refused;
use super::text::{Text, decode};
use crate::diagnostic::Diagnostic;
use crate::source::{Sources, Span};
use crate::syntax;

/// A file as the formatter lays it out.
///
/// # Errors
/// The mistakes that keep it from being parsed: a file with mistakes in its syntax is not formatted.
pub fn format(text: Text) -> Result<String, Refused> {
    let mut sources = Sources::default();
    let (file, broken) = decode(&mut sources, text);
    let text = sources.get(file).map_or("", |source| &source.text);
    if text.len() > MOST {
        let mistake = too_large(Span::new(file, 0, 0));
        return Err(Refused {
            sources,
            diagnostics: vec![mistake],
        });
    }
    let (ast, mistakes) = syntax::parse(file, text);
    let diagnostics = broken.map_or(mistakes, |broken| vec![broken]);
    if diagnostics.iter().any(Diagnostic::is_error) {
        return Err(Refused {
            sources,
            diagnostics,
        });
    }
    Ok(syntax::print::file(&ast, Some(text)))
}
