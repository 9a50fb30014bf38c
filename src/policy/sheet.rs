//! Comma-separated tables with places: what the files of a policy have in common.

use super::Minterm;
use super::error::{TableError, TableErrorKind};
use super::names::AtomName;
use super::records::{self, Records};
use crate::ir::law::Behavior;
use crate::ir::tree::Atom;
use crate::ir::{Id, Program};
use crate::spelling::bare;
use std::collections::BTreeMap;
use std::ops::Range;
use std::str::FromStr;

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
        self.text.parse().map_err(|_| self.unknown(expected))
    }

    /// The cell as a number that is neither undefined nor infinite.
    pub(super) fn finite(&self) -> Result<f64, TableError> {
        const EXPECTED: &str = "a finite number";
        let number: f64 = self.number(EXPECTED)?;
        Some(number)
            .filter(|number| number.is_finite())
            .ok_or_else(|| self.unknown(EXPECTED))
    }

    fn unknown(&self, expected: &'static str) -> TableError {
        self.error(TableErrorKind::UnknownValue {
            found: self.text.clone(),
            expected,
        })
    }
}

impl Sheet {
    /// Reads a table.
    pub(super) fn read(text: &str) -> Result<Self, TableError> {
        let text = text.as_bytes();
        let mut records = Records::new(text);
        let mut places = Vec::new();
        let mut rows: Vec<Vec<Cell>> = Vec::new();
        while records.next(&mut places)? {
            let cells = places.iter().map(|place| Cell {
                text: String::from_utf8_lossy(&records::value(text, place)).into_owned(),
                span: place.clone(),
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

    /// The position of a column that has to be there.
    pub(super) fn column(&self, name: &str) -> Result<usize, TableError> {
        let found = self.header.iter().position(|cell| cell.text == name);
        found.ok_or_else(|| self.missing(name))
    }

    fn missing(&self, name: &str) -> TableError {
        TableError {
            span: whole(&self.header),
            kind: TableErrorKind::MissingColumn {
                name: name.to_owned(),
                likely: None,
            },
        }
    }

    /// The positions of a column for each of these atoms.
    pub(super) fn columns(
        &self,
        prefix: &str,
        atoms: &[Atom],
        program: &Program,
    ) -> Result<Vec<usize>, TableError> {
        let mut known = BTreeMap::new();
        for (i, cell) in self.header.iter().enumerate() {
            if let Some(name) = cell.text.strip_prefix(prefix) {
                known.insert(AtomName::read(name), i);
            }
        }
        let atoms = atoms.iter();
        atoms
            .map(|atom| {
                let found = known.get(&AtomName::of(*atom, program)).copied();
                let name = || program.atom_name(*atom);
                found.ok_or_else(|| self.missing(&format!("{prefix}{}", name())))
            })
            .collect()
    }
}

/// The cells of a row at these columns.
pub(super) fn at<'a>(row: &'a [Cell], columns: &[usize]) -> Vec<&'a Cell> {
    columns.iter().filter_map(|i| row.get(*i)).collect()
}

/// The minterm in these cells; each has a value.
pub(super) fn minterm(cells: &[&Cell]) -> Result<Minterm, TableError> {
    let values = cells.iter().map(|cell| match cell.text.as_str() {
        "0" => Ok(false),
        "1" => Ok(true),
        _ => Err(cell.error(TableErrorKind::UnknownValue {
            found: cell.text.clone(),
            expected: "`0` or `1`",
        })),
    });
    values.collect()
}

/// The text that a row stands in.
pub(super) fn whole(row: &[Cell]) -> Range<usize> {
    let start = row.first().map_or(0, |cell| cell.span.start);
    start..row.last().map_or(start, |cell| cell.span.end)
}

/// The behaviour that a cell names.
pub(super) fn behavior(
    cell: &Cell,
    names: &BTreeMap<String, Id<Behavior>>,
) -> Result<Id<Behavior>, TableError> {
    let name = bare(&cell.text);
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
