//! A table of cubes, transposed.

use super::bits::Bits;
use super::cube::{Cover, Cube, Literal};
use super::packed::Packed;
use super::transpose::transpose;

/// Rows as columns of bits: bit r of column a tells whether atom a is fixed to 1 in row r.
///
/// A row is a minterm or, where some of its atoms are free, a cube: all minterms that agree with it in the others. Only
/// a table that has such rows stores the columns of what is fixed to 0.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    ones: Vec<Bits>,
    zeros: Option<Vec<Bits>>,
    rows: usize,
}

impl Columns {
    /// The table of minterms over `atoms` atoms, each given in machine words, atom 0 in the lowest bit of the first.
    pub fn new<'a>(atoms: usize, rows: impl ExactSizeIterator<Item = &'a [u64]>) -> Self {
        let count = rows.len();
        Self {
            ones: transpose(atoms, count, rows),
            zeros: None,
            rows: count,
        }
    }

    /// The table of rows that are given as their values and, where they have any, their free atoms. The value of a free
    /// atom does not matter.
    pub fn with_free<'a>(
        atoms: usize,
        rows: impl ExactSizeIterator<Item = (&'a [u64], Option<&'a [u64]>)> + Clone,
    ) -> Self {
        let count = rows.len();
        let mut ones = transpose(atoms, count, rows.clone().map(|(values, _)| values));
        if rows.clone().all(|(_, free)| free.is_none()) {
            return Self {
                ones,
                zeros: None,
                rows: count,
            };
        }
        let free = transpose(atoms, count, rows.map(|(_, free)| free.unwrap_or_default()));
        let all = Bits::full(count);
        let zeros = ones.iter_mut().zip(&free).map(|(ones, free)| {
            ones.subtract(free);
            let mut zeros = all.minus(ones);
            zeros.subtract(free);
            zeros
        });
        Self {
            zeros: Some(zeros.collect()),
            ones,
            rows: count,
        }
    }

    /// The table of these cubes.
    pub fn of(atoms: usize, cubes: &[Packed]) -> Self {
        let free: Vec<Box<[u64]>> = cubes.iter().map(|cube| cube.free(atoms)).collect();
        let rows = cubes.iter().zip(&free).map(|(cube, free)| {
            let is_cube = free.iter().any(|word| *word != 0);
            (cube.values(), is_cube.then_some(&**free))
        });
        Self::with_free(atoms, rows)
    }

    /// The number of atoms.
    pub fn atoms(&self) -> usize {
        self.ones.len()
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Whether every row is a minterm.
    pub fn are_minterms(&self) -> bool {
        self.zeros.is_none()
    }

    /// For each atom the rows in which it is fixed to 1.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &Bits)> {
        self.ones.iter().enumerate()
    }

    /// Whether the literal holds on all of the row.
    pub fn holds(&self, row: usize, literal: Literal) -> bool {
        let (column, inside) = self.inside(literal);
        row < self.rows && column.is_some_and(|column| column.contains(row) == inside)
    }

    /// The literals that hold on all of a row: one for each atom that is not free in it.
    pub fn literals_of(&self, row: usize) -> impl Iterator<Item = Literal> {
        (0..self.atoms()).filter_map(move |atom| {
            let literal = |positive| Literal { atom, positive };
            [literal(true), literal(false)]
                .into_iter()
                .find(|l| self.holds(row, *l))
        })
    }

    /// A row as a cube over so many atoms, of which the table may have the first alone.
    pub fn packed(&self, row: usize, atoms: usize) -> Packed {
        let mut cube = Packed::universe(atoms);
        for literal in self.literals_of(row) {
            cube.set(literal.atom, Some(literal.positive));
        }
        cube
    }

    /// The column, with the bit that it has where the literal holds on all of the row.
    pub(super) fn inside(&self, literal: Literal) -> (Option<&Bits>, bool) {
        match &self.zeros {
            Some(zeros) if !literal.positive => (zeros.get(literal.atom), true),
            _ => (self.ones.get(literal.atom), literal.positive),
        }
    }

    /// The column, with the bit that it has where the literal holds on some of the row.
    pub(super) fn meeting(&self, literal: Literal) -> (Option<&Bits>, bool) {
        match &self.zeros {
            Some(zeros) if literal.positive => (zeros.get(literal.atom), false),
            _ => (self.ones.get(literal.atom), literal.positive),
        }
    }

    /// Keeps the rows that lie wholly in the literal.
    pub fn restrict(&self, rows: &mut Bits, literal: Literal) {
        if let (Some(column), inside) = self.inside(literal) {
            rows.keep(column, inside);
        }
    }

    /// The rows among `among` that lie wholly in the cube: all of their minterms do.
    pub fn cube_rows(&self, cube: &Cube, among: &Bits) -> Bits {
        let mut rows = among.clone();
        for literal in cube.literals() {
            self.restrict(&mut rows, *literal);
        }
        rows
    }

    /// The rows among `among` that meet the cube: some of their minterms lie in it.
    pub fn cube_meets(&self, cube: &Cube, among: &Bits) -> Bits {
        let mut rows = among.clone();
        for literal in cube.literals() {
            if let (Some(column), inside) = self.meeting(*literal) {
                rows.keep(column, inside);
            }
        }
        rows
    }

    /// The rows among `among` that lie wholly in one of the cover's cubes.
    pub fn cover_rows(&self, cover: &Cover, among: &Bits) -> Bits {
        self.union(cover, |cube| self.cube_rows(cube, among))
    }

    /// The rows among `among` that meet the cover.
    pub fn cover_meets(&self, cover: &Cover, among: &Bits) -> Bits {
        self.union(cover, |cube| self.cube_meets(cube, among))
    }

    fn union(&self, cover: &Cover, rows: impl Fn(&Cube) -> Bits) -> Bits {
        let mut all = Bits::empty(self.rows);
        for cube in cover.cubes() {
            all.unite(&rows(cube));
        }
        all
    }

    /// The table of minterms without the atoms that do not divide its rows, or divide them as the atom before does, and with `most` of
    /// the others at most, evenly spread. Those that are left have other numbers.
    #[must_use]
    pub(super) fn dividing(mut self, most: usize) -> Self {
        if self.are_minterms() {
            let rows = self.rows;
            self.ones.dedup();
            self.ones
                .retain(|column| (1..rows).contains(&column.count()));
            let count = self.ones.len();
            let mut numbers = 0..count;
            self.ones.retain(|_| {
                let number = numbers.next().unwrap_or(0);
                count <= most || number * most / count != (number + 1) * most / count
            });
        }
        self
    }

    /// The table of these rows alone, in this order.
    #[must_use]
    pub fn pick(&self, rows: &[usize]) -> Self {
        let gather = |columns: &Vec<Bits>| -> Vec<Bits> {
            let column = |column: &Bits| {
                let words = rows.chunks(64).map(|chunk| {
                    let bits = chunk.iter().enumerate();
                    bits.fold(0, |word, (i, row)| {
                        word | u64::from(column.contains(*row)) << i
                    })
                });
                Bits::from_words(rows.len(), words.collect())
            };
            columns.iter().map(column).collect()
        };
        let ones = gather(&self.ones);
        let zeros = self.zeros.as_ref().map(gather);
        // Of cubes and minterms only minterms may have been picked.
        let fixed = |(ones, zeros): (&Bits, &Bits)| ones.count() + zeros.count() == rows.len();
        let zeros = zeros.filter(|zeros| !ones.iter().zip(zeros).all(fixed));
        Self {
            ones,
            zeros,
            rows: rows.len(),
        }
    }
}
