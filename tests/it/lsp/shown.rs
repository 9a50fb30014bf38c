//! Answers of the server as the snapshots show them.

use serde_json::{Value, json};
use std::path::Path;

/// An answer for a person: ranges as `line:column-line:column` from 1, files by their names, what is not said left out.
pub(super) fn short(answer: &Value, root: &Path) -> String {
    let folder = format!("file://{}/", root.to_str().unwrap());
    let shown = match (answer.get("result"), answer.get("error")) {
        (Some(result), _) => result,
        (None, Some(error)) => {
            let message = error["message"].as_str().unwrap();
            return format!("refused: {}", message.replace(&folder, ""));
        }
        (None, None) => answer,
    };
    let text = serde_json::to_string_pretty(&shortened(shown)).unwrap();
    text.replace(&folder, "").replace("\\n", "\n        ")
}

fn shortened(value: &Value) -> Value {
    let place = |it: &Value| {
        Some((
            it.get("line")?.as_u64()? + 1,
            it.get("character")?.as_u64()? + 1,
        ))
    };
    match value {
        Value::Object(fields) => {
            if let (2, Some(start), Some(end)) =
                (fields.len(), fields.get("start"), fields.get("end"))
                && let (Some((a, b)), Some((c, d))) = (place(start), place(end))
            {
                return json!(if a == c {
                    format!("{a}:{b}-{d}")
                } else {
                    format!("{a}:{b}-{c}:{d}")
                });
            }
            if let Some((line, column)) = place(value) {
                return json!(format!("{line}:{column}"));
            }
            let mut fields: Vec<(String, Value)> = (fields.iter())
                .filter(|(name, _)| *name != "sortText")
                .map(|(name, value)| (library(name), shortened(value)))
                .collect();
            fields.sort_by(|a, b| a.0.cmp(&b.0));
            Value::Object(fields.into_iter().collect())
        }
        Value::Array(list) => Value::Array(list.iter().map(shortened).collect()),
        Value::String(text) => json!(library(text)),
        other => other.clone(),
    }
}

/// The library's text lies somewhere among the files of the moment.
fn library(text: &str) -> String {
    match text
        .strip_prefix("file://")
        .and_then(|path| path.rsplit_once("/btc-"))
    {
        Some((_, rest)) if rest.ends_with("std.bt") => "(library) std.bt".to_owned(),
        _ => text.to_owned(),
    }
}
