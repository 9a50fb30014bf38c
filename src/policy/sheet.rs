//! Comma-separated tables with places: what the files of a policy have in common.

use super::Minterm;
use crate::ir::law::Behavior;
use crate::ir::tree::Atom;
use crate::ir::{Id, Program};
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// What is wrong with a table, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableError {
    /// The bytes of the text that it is about.
    pub span: Range<usize>,
    /// What is wrong.
    pub kind: TableErrorKind,
}

/// What can be wrong with a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TableErrorKind {
    /// It is not comma-separated text.
    Malformed(String),
    /// A row has another number of cells than the header.
    Ragged {
        /// Cells in the row.
        found: usize,
        /// Cells in the header.
        expected: usize,
    },
    /// A column names nothing that the program has.
    UnknownColumn(String),
    /// A column stands twice.
    RepeatedColumn(String),
    /// A column that has to be there is not.
    MissingColumn(String),
    /// A cell holds something else than it may.
    UnknownValue {
        /// What it holds.
        found: String,
        /// What it may hold.
        expected: &'static str,
    },
    /// A behaviour that the program does not have, or the policy cannot choose.
    UnknownBehavior(String),
    /// One minterm, two behaviours.
    Contradiction {
        /// The row that says otherwise.
        earlier: Range<usize>,
    },
    /// A minterm without a row among the decisions.
    Unseen,
    /// A row with so many `-` that it stands for too many minterms.
    Wide,
}

impl fmt::Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.kind {
            TableErrorKind::Malformed(why) => {
                write!(f, "this is not a comma-separated table: {why}")
            }
            TableErrorKind::Ragged { found, expected } => {
                write!(f, "this row has {found} cells, the header has {expected}")
            }
            TableErrorKind::UnknownColumn(name) => write!(f, "unknown column `{name}`"),
            TableErrorKind::RepeatedColumn(name) => write!(f, "column `{name}` stands twice"),
            TableErrorKind::MissingColumn(name) => write!(f, "column `{name}` is missing"),
            TableErrorKind::UnknownValue { found, expected } => {
                write!(f, "`{found}` is not {expected}")
            }
            TableErrorKind::UnknownBehavior(name) => write!(f, "unknown behavior `{name}`"),
            TableErrorKind::Contradiction { .. } => {
                write!(f, "an earlier row does something else in this minterm")
            }
            TableErrorKind::Unseen => write!(f, "no decision is known in this minterm"),
            TableErrorKind::Wide => write!(f, "this row stands for too many minterms"),
        }
    }
}

impl std::error::Error for TableError {}

/// A cell with its place.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub(super) text: String,
    pub(super) span: Range<usize>,
}

/// A table: cells with their places, rows as long as the header.
pub(super) struct Sheet {
    pub(super) header: Vec<Cell>,
    pub(super) rows: Vec<Vec<Cell>>,
}

impl Cell {
    pub(super) fn error(&self, kind: TableErrorKind) -> TableError {
        TableError {
            span: self.span.clone(),
            kind,
        }
    }

    /// The cell as a number of this kind.
    pub(super) fn number<T: FromStr>(&self, expected: &'static str) -> Result<T, TableError> {
        self.text.trim().parse().map_err(|_| {
            self.error(TableErrorKind::UnknownValue {
                found: self.text.clone(),
                expected,
            })
        })
    }

    /// `0`, `1`, or `-` for either.
    pub(super) fn truth(&self) -> Result<Option<bool>, TableError> {
        match self.text.trim() {
            "0" => Ok(Some(false)),
            "1" => Ok(Some(true)),
            "-" => Ok(None),
            _ => Err(self.error(TableErrorKind::UnknownValue {
                found: self.text.clone(),
                expected: "`0`, `1` or `-`",
            })),
        }
    }
}

impl Sheet {
    /// Reads a table.
    pub(super) fn read(text: &str) -> Result<Self, TableError> {
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .from_reader(text.as_bytes());
        let mut rows: Vec<Vec<Cell>> = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| malformed(text, &error))?;
            let start = record.position().map_or(0, |p| p.byte() as usize);
            // The position of a record is that of the line end before it, where there are blank lines.
            let rest = text.get(start..).unwrap_or_default();
            let start = start + (rest.len() - rest.trim_start_matches(['\r', '\n']).len());
            let spans = spans(text, start);
            let cells = record.iter().zip(spans).map(|(cell, span)| Cell {
                text: cell.to_owned(),
                span,
            });
            rows.push(cells.collect());
        }
        let mut rows = rows.into_iter();
        let header = rows.next().unwrap_or_default();
        let rows: Vec<Vec<Cell>> = rows.collect();
        for row in &rows {
            if row.len() != header.len() {
                return Err(TableError {
                    span: whole(row),
                    kind: TableErrorKind::Ragged {
                        found: row.len(),
                        expected: header.len(),
                    },
                });
            }
        }
        for (i, cell) in header.iter().enumerate() {
            if header
                .iter()
                .take(i)
                .any(|earlier| earlier.text == cell.text)
            {
                return Err(cell.error(TableErrorKind::RepeatedColumn(cell.text.clone())));
            }
        }
        Ok(Self { header, rows })
    }

    /// The position of a column.
    pub(super) fn find(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|cell| cell.text.trim() == name)
    }

    /// The position of a column that has to be there.
    pub(super) fn column(&self, name: &str) -> Result<usize, TableError> {
        self.find(name).ok_or_else(|| TableError {
            span: whole(&self.header),
            kind: TableErrorKind::MissingColumn(name.to_owned()),
        })
    }

    /// The positions of a column for each of these atoms.
    pub(super) fn columns(
        &self,
        prefix: &str,
        atoms: &[Atom],
        program: &Program,
    ) -> Result<Vec<usize>, TableError> {
        let names = atoms
            .iter()
            .map(|atom| format!("{prefix}{}", program.atom_name(*atom)));
        names.map(|name| self.column(&name)).collect()
    }
}

/// The cells of a row at these columns.
pub(super) fn at<'a>(row: &'a [Cell], columns: &[usize]) -> Vec<&'a Cell> {
    columns.iter().filter_map(|i| row.get(*i)).collect()
}

/// The minterm in these cells; each has a value.
pub(super) fn minterm(cells: &[&Cell]) -> Result<Minterm, TableError> {
    let values = cells.iter().map(|cell| {
        cell.truth()?.ok_or_else(|| {
            cell.error(TableErrorKind::UnknownValue {
                found: cell.text.clone(),
                expected: "`0` or `1`",
            })
        })
    });
    Ok(Minterm::new(values.collect::<Result<Vec<bool>, _>>()?))
}

/// The text that a row stands in.
pub(super) fn whole(row: &[Cell]) -> Range<usize> {
    let start = row.first().map_or(0, |cell| cell.span.start);
    start..row.last().map_or(start, |cell| cell.span.end)
}

/// The names of a program's behaviours.
pub(super) fn behaviors(program: &Program) -> BTreeMap<String, Id<Behavior>> {
    let behaviors = program.behaviors.iter();
    behaviors.map(|(id, b)| (b.name.clone(), id)).collect()
}

/// The names of a program's atoms.
pub(super) fn atoms(program: &Program) -> BTreeMap<String, Atom> {
    let predicates = program.predicates.ids().map(Atom::Predicate);
    let history = program
        .behaviors
        .ids()
        .flat_map(|b| [Atom::Done(b), Atom::Failed(b)]);
    predicates
        .chain(history)
        .map(|atom| (program.atom_name(atom), atom))
        .collect()
}

/// The behaviour that a cell names.
pub(super) fn behavior(
    cell: &Cell,
    names: &BTreeMap<String, Id<Behavior>>,
) -> Result<Id<Behavior>, TableError> {
    let name = cell.text.trim();
    names
        .get(name)
        .copied()
        .ok_or_else(|| cell.error(TableErrorKind::UnknownBehavior(name.to_owned())))
}

/// Writes rows of cells.
pub(super) fn write(rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut writer = csv::WriterBuilder::new()
        .flexible(true)
        .from_writer(Vec::new());
    for row in rows {
        // Writing to memory does not fail.
        if writer.write_record(&row).is_err() {
            break;
        }
    }
    let bytes = writer.into_inner().unwrap_or_default();
    String::from_utf8(bytes).unwrap_or_default()
}

/// The values of a minterm as cells.
pub(super) fn cells(minterm: &Minterm) -> impl Iterator<Item = String> {
    minterm.values().map(|value| u8::from(value).to_string())
}

fn malformed(text: &str, error: &csv::Error) -> TableError {
    let start = error.position().map_or(0, |p| p.byte() as usize);
    TableError {
        span: start.min(text.len())..text.len(),
        kind: TableErrorKind::Malformed(error.to_string()),
    }
}

/// Where the cells of the record that starts at `start` stand, quotes included (RFC 4180).
fn spans(text: &str, start: usize) -> Vec<Range<usize>> {
    let mut spans = Vec::new();
    let mut from = start;
    let mut quoted = false;
    let bytes = text.bytes().enumerate().skip(start);
    for (i, byte) in bytes.chain([(text.len(), b'\n')]) {
        match byte {
            b'"' => quoted = !quoted,
            b',' if !quoted => {
                spans.push(from..i);
                from = i + 1;
            }
            b'\r' | b'\n' if !quoted => {
                spans.push(from..i);
                return spans;
            }
            _ => {}
        }
    }
    spans.push(from..text.len());
    spans
}
