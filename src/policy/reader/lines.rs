//! JSON Lines with numbers and words. JSON itself tells them apart; a key may say more, as a header does.

use super::Units;
use super::header::{Assumed, Role, decides, divided, role};
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::records;
use crate::policy::table::Table;
use crate::policy::table::json::Line;
use crate::policy::table::json::object::{Object, Value};
use crate::policy::valued::{Builder, Valued};
use std::collections::BTreeMap;

/// Whether the keys of a table of truth values say what they hold.
pub(super) fn are_declared(table: &Table) -> bool {
    let mut names = table.atoms.iter().map(|(name, _)| name.to_string());
    names.any(|name| divided(&name).is_some())
}

pub(super) fn read(text: &[u8], units: Units) -> Result<Valued, Vec<TableError>> {
    let mut builder = Builder::default();
    let assumed = assumed(text);
    let mut roles: Option<Vec<(Role, String)>> = None;
    let mut header = 0..0;
    for line in lines(text) {
        if builder.is_full() {
            break;
        }
        let place = line.whole();
        let object = match line.object() {
            Ok(object) => object,
            Err(error) => {
                builder.mistake(error);
                continue;
            }
        };
        if roles.is_none() {
            header = place.clone();
            let named = object.fields().filter(|(name, _)| *name != "q");
            let named = named.map(|(name, _)| {
                let kind = assumed.get(name).copied().unwrap_or(Assumed::Truth);
                let role = role(&mut builder, (name, &line.place(name)), kind, units);
                (role, name.to_owned())
            });
            let found: Vec<_> = named.collect();
            decides(&mut builder, &found, &place);
            roles = Some(found);
            if !builder.is_sound() {
                break;
            }
        }
        let roles = roles.as_deref().unwrap_or_default();
        row(&object, &line, (roles, &assumed), &mut builder);
    }
    builder.finish(header)
}

/// The lines that are not blank.
fn lines(text: &[u8]) -> impl Iterator<Item = Line<'_>> {
    let mut at = records::start(text);
    let lines = text.get(at..).unwrap_or_default().split(|b| *b == b'\n');
    lines.filter_map(move |line| {
        let start = at + line.len() - line.trim_ascii_start().len();
        at += line.len() + 1;
        let line = line.trim_ascii();
        (!line.is_empty()).then_some(Line { text: line, start })
    })
}

/// What the keys hold that hold more than truth values.
fn assumed(text: &[u8]) -> BTreeMap<String, Assumed> {
    let mut found = BTreeMap::new();
    for line in lines(text) {
        let Ok(object) = line.object() else {
            continue;
        };
        for (name, value) in object.fields() {
            let kind = match value {
                Value::Number(number) if !matches!(number.as_f64(), Some(0.0 | 1.0)) => {
                    Assumed::Number
                }
                Value::Text(text) if !matches!(text.as_ref(), "0" | "1" | "-") => Assumed::Category,
                _ => continue,
            };
            // A word among numbers is a mistake, which is told where it stands.
            found.entry(name.to_owned()).or_insert(kind);
        }
    }
    found
}

fn row(
    object: &Object,
    line: &Line,
    (roles, assumed): (&[(Role, String)], &BTreeMap<String, Assumed>),
    builder: &mut Builder,
) {
    builder.begin();
    for (name, value) in object.fields().filter(|(name, _)| *name != "q") {
        let place = &line.place(name);
        let Some((role, _)) = roles.iter().find(|(_, known)| known == name) else {
            if !name.starts_with("q:") {
                builder.report(place, TableErrorKind::UnknownKey(name.to_owned()));
            }
            continue;
        };
        match (role, value) {
            (Role::State(column), Value::Null) => builder.leave_open(*column),
            // Elsewhere the same key has words, or numbers.
            (Role::State(_), Value::Bool(_)) if assumed.contains_key(name) => {
                let expected = match assumed.get(name) {
                    Some(Assumed::Number) => "a number, as in other lines",
                    _ => "a word, as in other lines",
                };
                let found = value.to_string();
                builder.report(place, TableErrorKind::UnknownValue { found, expected });
            }
            (Role::State(column), Value::Bool(truth)) => {
                let digit = if *truth { "1" } else { "0" };
                builder.cell(*column, digit, place);
            }
            (Role::State(column), Value::Number(number)) => {
                builder.cell(*column, &number.to_string(), place);
            }
            (Role::State(column), Value::Text(text)) => builder.cell(*column, text, place),
            (Role::Behavior, Value::Text(text)) => builder.decide(text, place),
            (Role::Behavior, Value::Number(number)) => builder.decide(&number.to_string(), place),
            (Role::Behavior, Value::List(Some(names))) => {
                builder.allow(names.iter().map(|name| name.as_ref()), place);
            }
            (Role::Visits, Value::Null) | (Role::Ignored, _) => {}
            (Role::Visits, Value::Number(number)) if number.is_u64() => {
                builder.visits(number.as_u64().unwrap_or(0));
            }
            (role, value) => {
                let expected = match role {
                    Role::Behavior => "a behaviour, or a list of some",
                    Role::Visits => "a count",
                    _ => "a number, a word, true, false or null",
                };
                let found = value.to_string();
                builder.report(place, TableErrorKind::UnknownValue { found, expected });
            }
        }
    }
    builder.end(line.whole());
}
