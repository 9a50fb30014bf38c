//! Diagnostics for programs: one JSON object a line.

use crate::diagnostic::{Applicability, Diagnostic, Severity};
use crate::source::{Source, Sources, Span};
use serde_json::{Value, json};

/// One line of JSON a diagnostic, each ended by a newline.
///
/// A place has its file, its half-open range of bytes, and the lines and columns of both ends, counted from one;
/// columns count characters, and UTF-16 code units where the key says so.
pub fn json(sources: &Sources, diagnostics: &[Diagnostic]) -> String {
    diagnostics
        .iter()
        .map(|diagnostic| format!("{}\n", object(sources, diagnostic)))
        .collect()
}

fn object(sources: &Sources, diagnostic: &Diagnostic) -> Value {
    let labels: Vec<Value> = diagnostic
        .labels
        .iter()
        .enumerate()
        .map(|(index, label)| {
            json!({
                "primary": index == 0,
                "message": label.message,
                "span": place(sources, label.span),
            })
        })
        .collect();
    let fixes: Vec<Value> = diagnostic
        .fixes
        .iter()
        .map(|fix| {
            let edits: Vec<Value> = fix
                .edits
                .iter()
                .map(|(span, new)| json!({ "span": place(sources, *span), "replacement": new }))
                .collect();
            let applicability = match fix.applicability {
                Applicability::Safe => "safe",
                Applicability::Unsafe => "unsafe",
            };
            json!({ "title": fix.title, "applicability": applicability, "edits": edits })
        })
        .collect();
    let severity = match diagnostic.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    json!({
        "code": diagnostic.code.name(),
        "severity": severity,
        "message": diagnostic.message,
        "labels": labels,
        "notes": diagnostic.notes,
        "help": diagnostic.help,
        "fixes": fixes,
    })
}

fn place(sources: &Sources, span: Span) -> Value {
    let Some(source) = sources.get(span.file) else {
        return Value::Null;
    };
    json!({
        "file": source.name,
        "bytes": [span.start, span.end],
        "start": position(source, span.start),
        "end": position(source, span.end),
    })
}

fn position(source: &Source, offset: u32) -> Value {
    let (line, column) = source.position(offset);
    let (_, column_utf16) = source.position_utf16(offset);
    json!({ "line": line + 1, "column": column + 1, "column_utf16": column_utf16 + 1 })
}
