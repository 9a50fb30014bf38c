//! Comma-separated text whose header says what the columns hold.

use super::Units;
use super::header::{Assumed, Role, decides, divided, is_open, role};
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::records::{self, Records};
use crate::policy::table::separated;
use crate::policy::valued::{Builder, Valued};
use std::ops::Range;

/// The names of a header, each with its place. The commas of a list of values divide no columns.
pub(super) fn names(text: &[u8], cells: &[Range<usize>]) -> Vec<(String, Range<usize>)> {
    let mut names: Vec<(String, Range<usize>)> = Vec::new();
    let mut open = false;
    for cell in cells {
        let name = records::value(text, cell);
        let name = String::from_utf8_lossy(&name);
        match names.last_mut() {
            Some((list, place)) if open => {
                list.push(',');
                list.push_str(&name);
                place.end = cell.end;
            }
            _ => names.push((name.into_owned(), cell.clone())),
        }
        let list = names.last().and_then(|(name, _)| divided(name));
        open = list.is_some_and(|(_, kind)| is_open(kind));
    }
    names
}

/// Whether a header says what some column holds.
pub(super) fn are_declared(text: &[u8]) -> bool {
    let mut cells = Vec::new();
    let first = Records::new(text).next(&mut cells);
    let names = names(text, &cells);
    first == Ok(true) && names.iter().any(|(name, _)| divided(name).is_some())
}

pub(super) fn read(text: &[u8], units: Units) -> Result<Valued, Vec<TableError>> {
    let mut records = Records::new(text);
    let mut builder = Builder::default();
    let mut cells = Vec::new();
    if let Err(error) = records.next(&mut cells) {
        return Err(vec![error]);
    }
    let header = records::whole(&cells);
    let names = names(text, &cells);
    if let Some(error) = separated(&names, &header) {
        return Err(vec![error]);
    }
    let roles = names.iter().map(|(name, place)| {
        let role = role(&mut builder, (name, place), Assumed::Truth, units);
        (role, name.clone())
    });
    let roles: Vec<(Role, String)> = roles.collect();
    decides(&mut builder, &roles, &header);
    if !builder.is_sound() {
        return builder.finish(header);
    }
    while !builder.is_full() {
        match records.next(&mut cells) {
            Ok(true) if cells.len() == roles.len() => row(text, &cells, &roles, &mut builder),
            Ok(true) => builder.mistake(TableError {
                span: records::whole(&cells),
                kind: TableErrorKind::Ragged {
                    found: cells.len(),
                    expected: roles.len(),
                },
            }),
            Ok(false) => break,
            Err(error) => {
                builder.mistake(error);
                break;
            }
        }
    }
    builder.finish(header)
}

fn row(text: &[u8], cells: &[Range<usize>], roles: &[(Role, String)], builder: &mut Builder) {
    builder.begin();
    for (cell, (role, _)) in cells.iter().zip(roles) {
        if *role == Role::Ignored {
            continue;
        }
        let value = records::value(text, cell);
        let Ok(value) = std::str::from_utf8(&value) else {
            builder.report(cell, TableErrorKind::NoText);
            continue;
        };
        match role {
            Role::State(column) => builder.cell(*column, value, cell),
            Role::Behavior => builder.decide(value, cell),
            Role::Visits => match value {
                "" => {}
                value => match value.parse() {
                    Ok(visits) => builder.visits(visits),
                    Err(_) => builder.report(
                        cell,
                        TableErrorKind::UnknownValue {
                            found: value.to_owned(),
                            expected: "a count",
                        },
                    ),
                },
            },
            Role::Ignored | Role::Open => {}
        }
    }
    builder.end(records::whole(cells));
}
