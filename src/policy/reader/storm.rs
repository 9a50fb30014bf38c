//! Schedulers that Storm has exported as JSON, with `--buildstateval` for the variables of a state and `--buildchoiceorig`
//! for the action of a choice.
//!
//! A choice without an origin is a loop that Storm has added; a state that has no other says nothing.

use super::decoded;
use crate::ir::input::Measure;
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::names;
use crate::policy::records;
use crate::policy::valued::{Builder, Valued};
use serde::Deserialize;
use serde_json::value::RawValue;
use serde_json::{Map, Value};
use std::ops::Range;

const FLAGS: &str =
    "export it with `--exportscheduler FILE.json --buildstateval --buildchoiceorig`";

const LINES: &str = "rows of a table are JSON Lines: an object a line, without brackets around them or commas between them";

/// Whether an entry is an object of another kind: neither its state nor its choices are there.
fn is_of_a_table(entry: &str) -> bool {
    let object = serde_json::from_str::<Map<String, Value>>(entry);
    object.is_ok_and(|object| !object.contains_key("s") && !object.contains_key("c"))
}

/// What a scheduler says of a state.
#[derive(Deserialize)]
struct Entry {
    /// The variables of the state, or its number.
    s: Value,
    /// The state of its memory.
    m: Option<u64>,
    /// What is chosen.
    c: Value,
}

pub(super) fn read(text: &[u8]) -> Result<Valued, Vec<TableError>> {
    let whole = decoded(text)?;
    // A byte order mark says nothing; the places stay those of the file.
    let unmarked: String;
    let whole = match whole.strip_prefix('\u{feff}') {
        Some(rest) => {
            unmarked = format!("   {rest}");
            &unmarked
        }
        None => whole,
    };
    let mut builder = Builder::default();
    let start = whole.len() - whole.trim_start().len();
    let entries: Vec<&RawValue> = match serde_json::from_str(whole) {
        Ok(entries) => entries,
        Err(error) => {
            let line = whole
                .split_inclusive('\n')
                .take(error.line().saturating_sub(1));
            let line: usize = line.map(str::len).sum();
            let at = (line + error.column().saturating_sub(1)).min(whole.len());
            let at = records::character(whole.as_bytes(), at);
            let wrong = whole.get(at..).and_then(|rest| rest.chars().next());
            let why = error.to_string();
            let why = why.split(" at line ").next().unwrap_or_default().to_owned();
            builder.report(
                &(at..at + wrong.map_or(0, char::len_utf8)),
                TableErrorKind::Malformed(why),
            );
            return builder.finish(start..start);
        }
    };
    let mut variables: Option<Vec<(String, usize)>> = None;
    let mut unnamed: Vec<Value> = Vec::new();
    let mut header = start..start;
    let mut left_out = 0;
    let all = entries.len();
    for entry in entries {
        if builder.is_full() {
            break;
        }
        let raw = entry.get();
        // The entries are slices of the text.
        let at = raw.as_ptr() as usize - whole.as_ptr() as usize;
        let place = at..at + raw.len();
        let entry: Entry = match serde_json::from_str(raw) {
            Ok(entry) => entry,
            Err(_) if is_of_a_table(raw) => {
                let message = "an entry of a scheduler has a state `s` and choices `c`";
                builder.report(&place, foreign(message, Some(LINES)));
                break;
            }
            Err(_) => {
                let message = "an entry of a scheduler has a state `s` and choices `c`";
                builder.report(&place, foreign(message, None));
                continue;
            }
        };
        let Value::Object(state) = &entry.s else {
            let message = "the state is a number, and says nothing of its variables";
            builder.report(&place, foreign(message, Some(FLAGS)));
            break;
        };
        if entry.m.is_some() {
            let message = "the scheduler has memory, and a table has none";
            builder.report(&place, foreign(message, None));
            break;
        }
        let known = match &variables {
            Some(known) => known,
            None => {
                header = place.clone();
                variables.insert(declared(state, &place, &mut builder))
            }
        };
        match chosen(&entry.c, &mut unnamed) {
            Ok(Some(action)) => {
                builder.begin();
                row(state, known, &place, &mut builder);
                builder.allow([action.as_str()], &place);
                builder.end(place);
            }
            Ok(None) => left_out += 1,
            Err((message, help)) => builder.report(&place, foreign(&message, help)),
        }
    }
    if left_out == all && all > 0 {
        let message = "no choice says where it comes from, and so what is done";
        builder.report(&header, foreign(message, Some(FLAGS)));
    }
    builder.finish(header)
}

/// The columns of the variables: numbers, and truth values.
fn declared(
    state: &Map<String, Value>,
    place: &Range<usize>,
    builder: &mut Builder,
) -> Vec<(String, usize)> {
    let columns = state.iter().map(|(name, value)| {
        let called = names::foreign(name);
        let column = match value {
            Value::Bool(_) => builder.truth(&called, place),
            Value::String(_) => builder.category(&called, place, Vec::new()),
            _ => builder.number(&called, place, Measure::plain()),
        };
        (name.clone(), column)
    });
    columns.collect()
}

fn row(
    state: &Map<String, Value>,
    known: &[(String, usize)],
    place: &Range<usize>,
    builder: &mut Builder,
) {
    for (name, value) in state {
        let Some((_, column)) = known.iter().find(|(known, _)| known == name) else {
            builder.report(place, TableErrorKind::UnknownKey(name.clone()));
            continue;
        };
        match value {
            Value::String(text) => builder.cell(*column, text, place),
            other => builder.cell(*column, &other.to_string(), place),
        }
    }
}

type Why = (String, Option<&'static str>);

/// The action that is chosen; `None` where the state has none.
fn chosen(choices: &Value, unnamed: &mut Vec<Value>) -> Result<Option<String>, Why> {
    let Value::Array(choices) = choices else {
        // "undefined"
        return Ok(None);
    };
    let named = choices.iter().filter_map(|choice| {
        let origin = choice.get("origin")?;
        Some((choice, origin))
    });
    let named: Vec<(&Value, &Value)> = named.collect();
    let [(_, origin)] = named.as_slice() else {
        return match named.len() {
            0 => Ok(None),
            n => Err((
                format!("the scheduler draws one of {n} choices, and a tree has no dice"),
                Some("ask Storm for a deterministic scheduler"),
            )),
        };
    };
    let label = origin.get("action-label").and_then(Value::as_str);
    if let Some(label) = label.filter(|label| !label.is_empty()) {
        return Ok(Some(names::foreign(label)));
    }
    // A command without a name is known by its text.
    let at = unnamed.iter().position(|known| known == *origin);
    let at = at.unwrap_or_else(|| {
        unnamed.push((*origin).clone());
        unnamed.len() - 1
    });
    Ok(Some(format!("act{at}")))
}

fn foreign(message: &str, help: Option<&'static str>) -> TableErrorKind {
    TableErrorKind::Foreign {
        message: message.to_owned(),
        help,
    }
}
