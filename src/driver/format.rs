//! `btc fmt`

use crate::diagnostic::Diagnostic;
use crate::source::Sources;
use crate::syntax;

use super::load::decode;

/// A file as the formatter lays it out.
///
/// # Errors
/// What keeps it from being parsed; a file with mistakes in its syntax is not formatted.
pub fn format(name: &str, bytes: Vec<u8>) -> Result<String, (Sources, Vec<Diagnostic>)> {
    let mut sources = Sources::default();
    let (file, mistake) = decode(&mut sources, name, bytes);
    if let Some(mistake) = mistake {
        return Err((sources, vec![mistake]));
    }
    let text = sources.get(file).map_or("", |source| &source.text);
    let (ast, mistakes) = syntax::parse(file, text);
    if mistakes.iter().any(Diagnostic::is_error) {
        return Err((sources, mistakes));
    }
    Ok(syntax::print::file(&ast, Some(text)))
}
