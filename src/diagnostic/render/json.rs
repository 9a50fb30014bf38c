//! Diagnostics for programs: one JSON object a line.

use crate::diagnostic::{Applicability, Diagnostic, Severity};
use crate::source::{Source, Sources, Span};
use serde::Serialize;

/// One line of JSON a diagnostic, each ended by a newline.
///
/// A place has its file, its half-open range of bytes, and the lines and columns of both ends, counted from one;
/// columns count characters, and UTF-16 code units where the key says so.
pub fn json(sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    diagnostics
        .iter()
        // Strings, numbers and lists of them always have a JSON form.
        .filter_map(|diagnostic| serde_json::to_string(&object(sources, diagnostic)).ok())
        .map(|line| line + "\n")
        .collect()
}

#[derive(Serialize)]
struct Object<'a> {
    code: &'static str,
    severity: Severity,
    message: &'a str,
    labels: Vec<Label<'a>>,
    notes: &'a [String],
    help: &'a [String],
    fixes: Vec<Fix<'a>>,
}

#[derive(Serialize)]
struct Label<'a> {
    primary: bool,
    message: &'a str,
    span: Option<Place<'a>>,
}

#[derive(Serialize)]
struct Fix<'a> {
    title: &'a str,
    applicability: Applicability,
    edits: Vec<Edit<'a>>,
}

#[derive(Serialize)]
struct Edit<'a> {
    span: Option<Place<'a>>,
    replacement: &'a str,
}

#[derive(Serialize)]
struct Place<'a> {
    file: &'a str,
    bytes: [u32; 2],
    start: Position,
    end: Position,
}

#[derive(Serialize)]
struct Position {
    line: usize,
    column: usize,
    column_utf16: usize,
}

fn object<'a>(sources: &'a Sources, diagnostic: &'a Diagnostic) -> Object<'a> {
    let labels = diagnostic.labels.iter().enumerate();
    let labels = labels.map(|(index, label)| Label {
        primary: index == 0,
        message: &label.message,
        span: place(sources, label.span),
    });
    let fixes = diagnostic.fixes.iter().map(|fix| {
        let edits = fix.edits.iter().map(|(span, new)| Edit {
            span: place(sources, *span),
            replacement: new,
        });
        Fix {
            title: &fix.title,
            applicability: fix.applicability,
            edits: edits.collect(),
        }
    });
    Object {
        code: diagnostic.code.name(),
        severity: diagnostic.severity,
        message: &diagnostic.message,
        labels: labels.collect(),
        notes: &diagnostic.notes,
        help: &diagnostic.help,
        fixes: fixes.collect(),
    }
}

fn place(sources: &Sources, span: Span) -> Option<Place<'_>> {
    let source = sources.get(span.file)?;
    Some(Place {
        file: &source.name,
        bytes: [span.start, span.end],
        start: position(source, span.start),
        end: position(source, span.end),
    })
}

fn position(source: &Source, offset: u32) -> Position {
    let (line, column) = source.position(offset);
    let (_, column_utf16) = source.position_utf16(offset);
    Position {
        line: line + 1,
        column: column + 1,
        column_utf16: column_utf16 + 1,
    }
}
