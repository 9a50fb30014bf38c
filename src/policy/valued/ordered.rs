//! Rows in the order of their values, column by column: sorted once, and divided ever after.

use super::{OPEN, Valued};
use crate::logic::Bits;

/// The value of a row in a column, by its code; those that leave it open come last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Cell {
    pub(super) code: u32,
    pub(super) row: u32,
}

/// Rows in the order of each column.
#[derive(Clone, Debug)]
pub(super) struct Ordered(Vec<Vec<Cell>>);

impl Ordered {
    /// These rows of a table.
    pub(super) fn new(valued: &Valued, rows: &[u32]) -> Self {
        let columns = valued.columns.iter().map(|column| {
            let cells = rows.iter().map(|row| {
                let code = column.codes.get(*row as usize).copied();
                let code = code.unwrap_or(OPEN);
                Cell { code, row: *row }
            });
            let mut cells: Vec<Cell> = cells.collect();
            cells.sort_unstable();
            cells
        });
        Self(columns.collect())
    }

    /// The columns, each with the cells of all rows, the least value first.
    pub(super) fn columns(&self) -> impl Iterator<Item = &[Cell]> {
        self.0.iter().map(Vec::as_slice)
    }

    /// Keeps these rows.
    pub(super) fn retain(&mut self, wanted: &Bits) {
        for cells in &mut self.0 {
            cells.retain(|cell| wanted.contains(cell.row as usize));
        }
    }

    /// These of the rows.
    pub(super) fn only(&self, wanted: &Bits) -> Self {
        let columns = self.0.iter().map(|cells| {
            let cells = cells.iter();
            let wanted = cells.filter(|cell| wanted.contains(cell.row as usize));
            wanted.copied().collect()
        });
        Self(columns.collect())
    }
}
