//! Diagnostics in one line each: for editors and for the annotations of GitHub.

use super::on_one_line;
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::{Source, Sources};

/// `file:line:column: error[E0202]: message`, a line for each diagnostic; lines and columns are counted from one.
pub fn short(sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    let line = |found: &Diagnostic| {
        let place = place(sources, found).map_or(String::new(), |(source, [line, column, ..])| {
            format!("{}:{line}:{column}: ", source.name)
        });
        let (severity, code, message) = (word(found), found.code, &found.message);
        format!(
            "{}\n",
            on_one_line(&format!("{place}{severity}[{code}]: {message}"))
        )
    };
    diagnostics.iter().map(line).collect()
}

/// Workflow commands, which GitHub shows as annotations beside the changed lines.
pub fn github(sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    let line = |found: &Diagnostic| {
        let place =
            place(sources, found).map_or(String::new(), |(source, [line, column, end, last])| {
                let file = property(&source.name);
                format!("file={file},line={line},col={column},endLine={end},endColumn={last},")
            });
        let (severity, code, message) = (word(found), found.code, data(&found.message));
        format!("::{severity} {place}title={code}::{message}\n")
    };
    diagnostics.iter().map(line).collect()
}

/// The source of the primary place, with the line and the column of its start and of its end.
fn place<'s>(sources: &'s Sources, found: &Diagnostic) -> Option<(&'s Source, [usize; 4])> {
    let span = found.labels.first()?.span;
    let source = sources.get(span.file)?;
    let (line, column) = source.position(span.start);
    let (end, last) = source.position(span.end);
    Some((source, [line + 1, column + 1, end + 1, last + 1]))
}

fn word(found: &Diagnostic) -> &'static str {
    match found.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    }
}

/// A text as the data of a workflow command.
fn data(text: &str) -> String {
    text.replace('%', "%25")
        .replace('\r', "%0D")
        .replace('\n', "%0A")
}

/// A text as a property of a workflow command.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
