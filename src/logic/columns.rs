//! A table of minterms, transposed.

use super::bits::Bits;
use super::cube::{Cover, Cube, Literal};

/// Minterms as one column of bits per atom: bit r of column a is the value of atom a in row r.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    columns: Vec<Bits>,
    rows: usize,
}

impl Columns {
    /// The table of `atoms` columns whose rows are given in machine words, atom 0 in the lowest bit of the first.
    pub fn new<'a>(atoms: usize, rows: impl ExactSizeIterator<Item = &'a [u64]>) -> Self {
        let count = rows.len();
        let mut columns = vec![Bits::empty(count); atoms];
        for (r, row) in rows.enumerate() {
            for (a, column) in columns.iter_mut().enumerate() {
                if row
                    .get(a / 64)
                    .is_some_and(|word| word >> (a % 64) & 1 == 1)
                {
                    column.insert(r);
                }
            }
        }
        Self {
            columns,
            rows: count,
        }
    }

    /// The number of atoms.
    pub fn atoms(&self) -> usize {
        self.columns.len()
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The columns, atom by atom.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &Bits)> {
        self.columns.iter().enumerate()
    }

    /// The value of an atom in a row; false outside the table.
    pub fn value(&self, row: usize, atom: usize) -> bool {
        self.columns.get(atom).is_some_and(|c| c.contains(row))
    }

    /// The literals that hold in a row.
    pub fn literals_of(&self, row: usize) -> impl Iterator<Item = Literal> {
        self.iter().map(move |(atom, column)| Literal {
            atom,
            positive: column.contains(row),
        })
    }

    /// Drops from `rows` those in which the literal does not hold.
    pub fn restrict(&self, rows: &mut Bits, literal: Literal) {
        if let Some(column) = self.columns.get(literal.atom) {
            rows.keep(column, literal.positive);
        }
    }

    /// The rows among `among` in which the cube holds.
    pub fn cube_rows(&self, cube: &Cube, among: &Bits) -> Bits {
        let mut rows = among.clone();
        for literal in cube.literals() {
            self.restrict(&mut rows, *literal);
        }
        rows
    }

    /// The rows among `among` in which the cover holds.
    pub fn cover_rows(&self, cover: &Cover, among: &Bits) -> Bits {
        cover
            .cubes()
            .iter()
            .fold(Bits::empty(self.rows), |rows, cube| {
                rows.or(&self.cube_rows(cube, among))
            })
    }
}
