//! Comma-separated tables: a header, then a row a line.

use super::rows::Truth;
use super::{Reading, Role};
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::records::{self, Records};
use std::ops::Range;

pub(super) fn read(text: &[u8], reading: &mut Reading) {
    let mut records = Records::new(text);
    let mut cells = Vec::new();
    match records.next(&mut cells) {
        Ok(true) => {}
        Ok(false) => return,
        Err(error) => return reading.stop(error),
    }
    let names = cells.iter().map(|cell| {
        let name = records::value(text, cell);
        (reading.text(&name, cell), cell.clone())
    });
    let names = names.collect();
    let roles = reading.columns(names, records::whole(&cells));
    while !reading.is_full() {
        match records.next(&mut cells) {
            Ok(true) => row(text, &cells, &roles, reading),
            Ok(false) => return,
            Err(error) => return reading.stop(error),
        }
    }
}

fn row(text: &[u8], cells: &[Range<usize>], roles: &[Role], reading: &mut Reading) {
    if cells.len() != roles.len() {
        return reading.mistake(TableError {
            span: records::whole(cells),
            kind: TableErrorKind::Ragged {
                found: cells.len(),
                expected: roles.len(),
            },
        });
    }
    reading.begin();
    for (cell, role) in cells.iter().zip(roles) {
        match role {
            Role::Atom(atom) => match truth(text, cell) {
                Some(truth) => reading.draft.say(*atom, truth),
                None => reading.unknown(text, cell, "`0`, `1` or `-`"),
            },
            Role::Behavior => reading.decided(&records::value(text, cell), cell),
            Role::Visits => match number(text, cell) {
                Some(visits) => reading.draft.visits = visits.unwrap_or(0),
                None => reading.unknown(text, cell, "a count"),
            },
            Role::Value(column) => match number(text, cell) {
                Some(q) => reading.draft.value(*column, q),
                None => reading.unknown(text, cell, "a number"),
            },
            Role::Ignored => {}
        }
    }
    let start = cells.first().map_or(0, |cell| cell.start);
    reading.end(start);
}

fn truth(text: &[u8], cell: &Range<usize>) -> Option<Truth> {
    match text.get(cell.clone()).unwrap_or_default() {
        b"0" => return Some(Truth::No),
        b"1" => return Some(Truth::Yes),
        b"-" => return Some(Truth::Either),
        _ => {}
    }
    match &*records::value(text, cell) {
        b"0" => Some(Truth::No),
        b"1" => Some(Truth::Yes),
        b"-" => Some(Truth::Either),
        word if word.eq_ignore_ascii_case(b"false") => Some(Truth::No),
        word if word.eq_ignore_ascii_case(b"true") => Some(Truth::Yes),
        _ => None,
    }
}

/// The number in a cell, nothing in an empty one; `None` if it is something else.
fn number<T: std::str::FromStr>(text: &[u8], cell: &Range<usize>) -> Option<Option<T>> {
    let value = records::value(text, cell);
    if value.is_empty() {
        return Some(None);
    }
    std::str::from_utf8(&value).ok()?.parse().ok().map(Some)
}
