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
    let leading = roles
        .iter()
        .take_while(|role| matches!(role, Role::Atom(_)));
    let leading = leading.count();
    let behind = roles.get(leading..).unwrap_or_default();
    while !reading.is_full() {
        let start = records.next_start();
        reading.begin();
        if let Some(at) = packed(text, start, leading, reading) {
            let mut rest = Records::starting_at(text, at);
            if rest.rest(&mut cells).is_ok() && cells.len() == behind.len() {
                records = rest;
                row(text, &cells, behind, reading);
                reading.end(start);
                continue;
            }
        }
        match records.next(&mut cells) {
            Ok(true) if cells.len() == roles.len() => {
                reading.begin();
                row(text, &cells, &roles, reading);
                reading.end(start);
            }
            Ok(true) => reading.mistake(TableError {
                span: records::whole(&cells),
                kind: TableErrorKind::Ragged {
                    found: cells.len(),
                    expected: roles.len(),
                },
            }),
            Ok(false) => return,
            Err(error) => return reading.stop(error),
        }
    }
}

/// Reads the first `count` cells of the row that starts at a byte and gives the start of the cell after them; `None` if
/// one is not just `0` or `1`. Nearly all of a large table is read here.
fn packed(text: &[u8], start: usize, count: usize, reading: &mut Reading) -> Option<usize> {
    let end = start + 2 * count;
    let cells = text.get(start..end).filter(|_| count > 0)?;
    for (number, cells) in cells.chunks(2 * 64).enumerate() {
        let mut word = 0;
        let mut other = 0;
        for cell in cells.chunks_exact(2) {
            if let [digit, comma] = cell {
                word = word >> 1 | u64::from(digit & 1) << 63;
                other |= (digit ^ b'0') & !1 | (comma ^ b',');
            }
        }
        if other != 0 {
            return None;
        }
        reading
            .draft
            .say_word(number, word >> (64 - cells.len() / 2));
    }
    Some(end)
}

/// Reads cells by what their columns say.
fn row(text: &[u8], cells: &[Range<usize>], roles: &[Role], reading: &mut Reading) {
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
            Role::Value(column) => match number::<f64>(text, cell) {
                Some(q) if q.is_none_or(f64::is_finite) => reading.draft.value(*column, q),
                _ => reading.unknown(text, cell, "a finite number"),
            },
            Role::Ignored => {}
        }
    }
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
