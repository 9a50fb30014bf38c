//! Diagnostics as a SARIF log (Static Analysis Results Interchange Format 2.1.0).

use crate::diagnostic::{Code, Diagnostic, Severity};
use crate::source::{Sources, Span};
use serde_json::{Value, json};

/// The log of one run, over any number of programs.
pub fn sarif<'a>(found: impl IntoIterator<Item = (&'a Sources, &'a [Diagnostic])>) -> String {
    let results: Vec<Value> = found
        .into_iter()
        .flat_map(|(sources, diagnostics)| {
            diagnostics.iter().map(move |found| result(sources, found))
        })
        .collect();
    let rules: Vec<Value> = Code::ALL
        .iter()
        .map(|code| {
            json!({
                "id": code.name(),
                "shortDescription": { "text": code.title() },
                "help": { "text": code.explanation() },
            })
        })
        .collect();
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "btc",
                "version": env!("CARGO_PKG_VERSION"),
                "rules": rules,
            } },
            "columnKind": "unicodeCodePoints",
            "results": results,
        }],
    });
    format!("{log:#}\n")
}

fn result(sources: &Sources, found: &Diagnostic) -> Value {
    let level = match found.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    let said: Vec<&str> = std::iter::once(found.message.as_str())
        .chain(found.labels.first().map(|label| label.message.as_str()))
        .chain(found.notes.iter().chain(&found.help).map(String::as_str))
        .filter(|text| !text.is_empty())
        .collect();
    let mut places = found
        .labels
        .iter()
        .filter_map(|label| place(sources, label.span));
    json!({
        "ruleId": found.code.name(),
        "level": level,
        "message": { "text": said.join("\n") },
        "locations": places.next().into_iter().collect::<Vec<_>>(),
        "relatedLocations": places.collect::<Vec<_>>(),
    })
}

fn place(sources: &Sources, span: Span) -> Option<Value> {
    let source = sources.get(span.file)?;
    let (line, column) = source.position(span.start);
    let (end, last) = source.position(span.end);
    Some(json!({
        "physicalLocation": {
            "artifactLocation": { "uri": source.name },
            "region": {
                "startLine": line + 1,
                "startColumn": column + 1,
                "endLine": end + 1,
                "endColumn": last + 1,
            },
        },
    }))
}
