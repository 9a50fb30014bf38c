//! Controllers as dtControl reads them: `#PERMISSIVE` or `#NON-PERMISSIVE`, perhaps `#CATEGORICAL` with the numbers of columns,
//! `#BEGIN` with how many columns are the state and how many what is done, then a row of numbers a line.
//!
//! The columns have no names. The state is `x_0`, `x_1`, …; what is done is called by its numbers, `u = 0.5`. A permissive
//! controller has a row for each of what it allows in a state.

use super::decoded;
use crate::ir::input::Measure;
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::records;
use crate::policy::valued::{Builder, Decimal, Valued};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Whether a text is of this kind: one of its first lines says so, all of which begin with `#`.
pub(super) fn is_one(text: &[u8]) -> bool {
    let words = [
        &b"#PERMISSIVE"[..],
        b"#NON-PERMISSIVE",
        b"#BEGIN",
        b"#CATEGORICAL",
    ];
    let lines = text.split(|b| *b == b'\n').map(<[u8]>::trim_ascii);
    let mut head = lines.take(HEAD).take_while(|line| line.starts_with(b"#"));
    head.any(|line| words.iter().any(|word| line.starts_with(word)))
}

/// In how many lines a file says of what kind it is.
const HEAD: usize = 4;

/// What the lines before the rows say.
#[derive(Default)]
struct Head {
    permissive: Option<bool>,
    categorical: Vec<usize>,
    /// Where these are listed.
    listed: Option<Range<usize>>,
    /// The columns of the state and of what is done, with the place.
    sizes: Option<(usize, usize, Range<usize>)>,
}

pub(super) fn read(text: &[u8]) -> Result<Valued, Vec<TableError>> {
    let from = records::start(text);
    let whole = decoded(text)?;
    let mut builder = Builder::default();
    let mut head = Head::default();
    let mut rows: Vec<(&str, Range<usize>)> = Vec::new();
    let mut at = from;
    for line in whole.get(from..).unwrap_or_default().split('\n') {
        let start = at + line.len() - line.trim_start().len();
        at += line.len() + 1;
        let line = line.trim();
        let place = start..start + line.len();
        match line.strip_prefix('#') {
            Some(said) => head.line(said, &place, &mut builder),
            None if line.is_empty() => {}
            None => rows.push((line, place)),
        }
    }
    let Some((state, done, place)) = head.sizes.clone() else {
        if builder.is_sound() {
            builder.report(
                &(from..from),
                foreign("a line `#BEGIN` with two numbers is missing"),
            );
        }
        return builder.finish(from..from);
    };
    let (unknown, listed) = (
        head.categorical.iter().find(|column| **column >= state),
        head.listed.clone().unwrap_or(from..from),
    );
    if let Some(column) = unknown {
        let message = format!("there is no column {column}: the state has {state}, counted from 0");
        builder.report(&listed, foreign(message));
        return builder.finish(place);
    }
    let columns = (0..state).map(|column| {
        let name = format!("x_{column}");
        match head.categorical.contains(&column) {
            true => builder.category(&name, &place, Vec::new()),
            false => builder.number(&name, &place, Measure::plain()),
        }
    });
    let columns: Vec<usize> = columns.collect();
    let mut states: Vec<(Vec<&str>, Vec<String>, Range<usize>)> = Vec::new();
    let mut known: FxHashMap<Vec<Decimal>, usize> = FxHashMap::default();
    for (line, row) in rows {
        if builder.is_full() {
            break;
        }
        let cells: Vec<&str> = line.split(',').map(str::trim).collect();
        if cells.len() != state + done {
            builder.report(&row, ragged(line, cells.len(), state + done));
            continue;
        }
        let numbers = cells.iter().map(|cell| Decimal::parse(cell).ok_or(*cell));
        let mut numbers = match numbers.collect::<Result<Vec<Decimal>, &str>>() {
            Ok(numbers) => numbers,
            Err(cell) => {
                let kind = TableErrorKind::UnknownValue {
                    found: cell.to_owned(),
                    expected: "a number",
                };
                builder.report(&row, kind);
                continue;
            }
        };
        let action = called(&numbers.split_off(state));
        let cells = cells.into_iter().take(state).collect();
        // A controller that is not permissive and says two things of a state contradicts itself.
        let next = states.len();
        let at = match head.permissive {
            Some(false) => next,
            _ => *known.entry(numbers).or_insert(next),
        };
        match states.get_mut(at) {
            Some((_, actions, _)) => actions.push(action),
            None => states.push((cells, vec![action], row)),
        }
    }
    for (cells, actions, row) in states {
        builder.begin();
        for (column, cell) in columns.iter().zip(cells) {
            builder.cell(*column, cell, &row);
        }
        builder.allow(actions.iter().map(String::as_str), &row);
        builder.end(row);
    }
    builder.finish(place)
}

impl Head {
    fn line(&mut self, said: &str, place: &Range<usize>, builder: &mut Builder) {
        // A spreadsheet fills each line up with commas.
        let said = said.trim_end_matches(|letter: char| letter == ',' || letter.is_whitespace());
        let mut words = said.split_whitespace();
        let word = words.next().unwrap_or_default();
        let numbers: Option<Vec<usize>> = words.map(|word| word.parse().ok()).collect();
        match (word, numbers.as_deref()) {
            ("PERMISSIVE", _) => self.permissive = Some(true),
            ("NON-PERMISSIVE", _) => self.permissive = Some(false),
            ("CATEGORICAL", Some(numbers)) => {
                self.categorical = numbers.to_vec();
                self.listed = Some(place.clone());
            }
            ("BEGIN", Some(&[state @ 1..=4096, done @ 1..=64])) => {
                self.sizes = Some((state, done, place.clone()));
            }
            ("BEGIN" | "CATEGORICAL", _) => {
                let message = match word {
                    "BEGIN" => {
                        "`#BEGIN` says how many columns are the state and how many what is done"
                    }
                    _ => "`#CATEGORICAL` lists numbers of columns",
                };
                builder.report(place, foreign(message));
            }
            // Whatever else stands behind a `#` is a remark, unless it was to be one of these.
            (word, _) if is_meant(word) => {
                let message = format!("`#{word}` says nothing of a controller");
                builder.report(place, foreign(message));
            }
            _ => {}
        }
    }
}

/// Whether a word in capitals was likely to be one of the words before the rows.
fn is_meant(word: &str) -> bool {
    let ends = ["PERMI", "NON", "BEG", "CATEG"];
    let capital = word.chars().all(|c| c.is_ascii_uppercase() || c == '-');
    capital && ends.iter().any(|begin| word.starts_with(begin))
}

/// What is done, by its numbers.
fn called(numbers: &[Decimal]) -> String {
    let numbers: Vec<String> = numbers.iter().map(Decimal::to_string).collect();
    match numbers.as_slice() {
        [one] => format!("u = {one}"),
        several => format!("u = ({})", several.join(", ")),
    }
}

/// A row that has other cells than `#BEGIN` says.
fn ragged(line: &str, found: usize, expected: usize) -> TableErrorKind {
    let cells = if found == 1 { "cell" } else { "cells" };
    let help = match (line.ends_with(','), line.contains(',')) {
        (true, _) => Some("no comma stands behind the last number"),
        (_, false) if expected > 1 => Some("the numbers are parted by commas"),
        _ => None,
    };
    TableErrorKind::Foreign {
        message: format!("this row has {found} {cells}, by `#BEGIN` it has {expected}"),
        help,
    }
}

fn foreign(message: impl Into<String>) -> TableErrorKind {
    TableErrorKind::Foreign {
        message: message.into(),
        help: Some("a file of dtControl begins with `#NON-PERMISSIVE` and `#BEGIN 2 1`"),
    }
}
