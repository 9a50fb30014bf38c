//! What the header of a table would say whose columns hold numbers and words.

use super::header::{Assumed, divided};
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::records::{self, Records};
use crate::policy::table::BEHAVIOR;
use crate::policy::valued::Decimal;
use std::collections::BTreeSet;

/// The most values of a column that are written into its header.
const LISTED: usize = 64;

/// What has been met in a column.
#[derive(Default)]
struct Met {
    numbers: BTreeSet<String>,
    /// How many cells hold these numbers.
    counted: usize,
    /// Whether a cell is empty.
    lacks: bool,
    words: BTreeSet<String>,
    /// Whether `0`, `1` and their like appear.
    truths: bool,
}

impl Met {
    fn cell(&mut self, text: &str) {
        let truth = matches!(text, "0" | "1")
            || ["true", "false"]
                .iter()
                .any(|word| text.eq_ignore_ascii_case(word));
        self.truths |= truth;
        self.lacks |= text.is_empty();
        if text == "-" || truth || text.is_empty() {
        } else if Decimal::parse(text).is_some() {
            self.numbers.insert(text.to_owned());
            self.counted += 1;
        } else {
            self.words.insert(text.to_owned());
        }
    }

    /// What the column holds, if that is clear.
    fn kind(&self) -> Option<Assumed> {
        match (self.numbers.is_empty(), self.words.is_empty()) {
            // What an empty cell was to hold is told first.
            _ if self.lacks => None,
            (true, true) => Some(Assumed::Truth),
            // One other number among 0 and 1 is a slip.
            (false, true) if self.counted > 1 || !self.truths => Some(Assumed::Number),
            (_, false) if !self.truths && self.words.len() <= LISTED => Some(Assumed::Category),
            _ => None,
        }
    }
}

/// What is wrong with a table whose header does not say that columns hold numbers or words; `None` where it is not clear
/// that they do.
pub(super) fn header(text: &[u8]) -> Option<TableError> {
    let mut records = Records::new(text);
    let mut cells = Vec::new();
    records.next(&mut cells).ok()?;
    let names = cells.iter().map(|cell| {
        let name = records::value(text, cell);
        String::from_utf8_lossy(&name).into_owned()
    });
    let names: Vec<String> = names.collect();
    let places = cells.clone();
    let is_state = |name: &str| {
        let other = BEHAVIOR.contains(&name) || matches!(name, "visits" | "q_gap" | "");
        !other && !name.starts_with("q:") && divided(name).is_none()
    };
    let mut met: Vec<Met> = names.iter().map(|_| Met::default()).collect();
    while let Ok(true) = records.next(&mut cells) {
        if cells.len() != names.len() {
            continue;
        }
        for ((cell, met), name) in cells.iter().zip(&mut met).zip(&names) {
            let value = records::value(text, cell);
            if is_state(name) && met.words.len() <= LISTED {
                met.cell(&String::from_utf8_lossy(&value));
            }
        }
    }
    // Beside a column of numbers another one is hardly a slip.
    let numbers = met.iter().any(|met| met.kind() == Some(Assumed::Number));
    let mut first = None;
    let mut header = Vec::new();
    for ((name, place), met) in names.iter().zip(places).zip(&met) {
        if !is_state(name) {
            header.push(name.clone());
            continue;
        }
        let beside = numbers && !met.lacks && met.words.is_empty();
        let kind = met.kind().or(beside.then_some(Assumed::Number))?;
        header.push(match kind {
            Assumed::Truth => name.clone(),
            Assumed::Number => format!("{name}:number"),
            Assumed::Category => {
                let values: Vec<&str> = met
                    .words
                    .iter()
                    .chain(&met.numbers)
                    .map(String::as_str)
                    .collect();
                format!("{name}:{{{}}}", values.join(","))
            }
        });
        if kind != Assumed::Truth && first.is_none() {
            first = Some((name.clone(), kind == Assumed::Number, place));
        }
    }
    let (name, numbers, span) = first?;
    let header = header.join(",");
    Some(TableError {
        span,
        kind: TableErrorKind::Undeclared {
            name,
            numbers,
            header,
        },
    })
}
