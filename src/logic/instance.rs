//! What is to be covered and what is to be avoided, apart.

use super::bits::Bits;
use super::columns::Columns;
use super::cube::Cube;

/// A problem of minimisation: the rows on which a cover holds, and those that it does not meet.
#[derive(Clone, Debug)]
pub(super) struct Instance {
    /// The rows that lie in the cover.
    pub(super) on: Columns,
    /// The rows that the cover does not meet.
    pub(super) off: Columns,
}

impl Instance {
    /// The problem over these rows of a table.
    pub(super) fn new(columns: &Columns, on: &[usize], off: &[usize]) -> Self {
        Self {
            on: columns.pick(on),
            off: columns.pick(off),
        }
    }

    /// The number of rows.
    pub(super) fn rows(&self) -> usize {
        self.on.rows() + self.off.rows()
    }

    /// The number of words that going through all columns once takes.
    pub(super) fn words(&self) -> usize {
        (self.on.rows().div_ceil(64) + self.off.rows().div_ceil(64)) * self.on.atoms()
    }

    /// All ON rows.
    pub(super) fn all_on(&self) -> Bits {
        Bits::full(self.on.rows())
    }

    /// All OFF rows.
    pub(super) fn all_off(&self) -> Bits {
        Bits::full(self.off.rows())
    }

    /// The ON rows that lie in a cube.
    pub(super) fn covered(&self, cube: &Cube) -> Bits {
        self.on.cube_rows(cube, &self.all_on())
    }
}
