//! The outputs of a PLA as problems of minimisation.

use super::conflict::{Conflict, conflict};
use super::{Kind, Part, Pla};
use crate::logic::complement::complement;
use crate::logic::packed::Packed;
use crate::logic::{Bits, Columns};
use std::borrow::Cow;

/// One output: the rows on which it is 1, and those on which it is 0.
#[derive(Clone, Debug)]
pub struct Function<'a> {
    /// The rows.
    pub columns: Cow<'a, Columns>,
    /// Where it is 1.
    pub on: Bits,
    /// Where it is 0.
    pub off: Bits,
}

/// The complement has more cubes than the limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLarge;

impl Pla {
    /// All rows as a table.
    pub fn columns(&self) -> Columns {
        Columns::with_free(self.inputs, self.table())
    }

    /// The rows that say `part` of an output.
    fn rows_of(&self, output: usize, part: Part) -> Bits {
        let rows = (0..self.rows()).filter(|row| self.part(*row, output) == part);
        Bits::collect(self.rows(), rows)
    }

    /// Rows that say of an output that it is 1, and that it is 0.
    pub fn contradiction(&self, columns: &Columns, output: usize) -> Option<Conflict> {
        conflict(self, columns, |row| match self.part(row, output) {
            Part::On => Some(1),
            Part::Off => Some(0),
            _ => None,
        })
    }

    /// An output as a problem; `columns` is the table of all rows.
    ///
    /// Where the file does not say where the output is 0, that is the complement of what it says. Of what is both 1 and
    /// free, Espresso keeps nothing in the cover that it does not need: so it is free here.
    ///
    /// # Errors
    /// Where the complement has more than `limit` cubes.
    pub fn function<'a>(
        &self,
        columns: &'a Columns,
        output: usize,
        limit: usize,
    ) -> Result<Function<'a>, TooLarge> {
        let on = self.rows_of(output, Part::On);
        let free = self.rows_of(output, Part::Free);
        let given = matches!(self.kind, Kind::Fr | Kind::Fdr);
        if given && free.is_empty() {
            return Ok(Function {
                columns: Cow::Borrowed(columns),
                on,
                off: self.rows_of(output, Part::Off),
            });
        }
        let cubes = |rows: &Bits| {
            rows.iter()
                .map(|row| self.cube(row))
                .collect::<Vec<Packed>>()
        };
        let (ones, frees) = (cubes(&on), cubes(&free));
        let zeros = if given {
            cubes(&self.rows_of(output, Part::Off))
        } else {
            let said: Vec<Packed> = ones.iter().chain(&frees).cloned().collect();
            complement(self.inputs, &said, limit).ok_or(TooLarge)?
        };
        let mut rows = Vec::new();
        for one in ones {
            rows.extend(without(one, &frees, limit.saturating_sub(rows.len())).ok_or(TooLarge)?);
        }
        let ones = rows.len();
        rows.extend(zeros);
        Ok(Function {
            columns: Cow::Owned(Columns::of(self.inputs, &rows)),
            on: Bits::collect(rows.len(), 0..ones),
            off: Bits::collect(rows.len(), ones..rows.len()),
        })
    }

    /// The rows of each output for a decision list over the outputs: those that say that it is 1.
    ///
    /// # Errors
    /// The first row of which not exactly one output is 1.
    pub fn classes(&self) -> Result<Vec<Bits>, usize> {
        let mut classes = vec![Bits::empty(self.rows()); self.outputs];
        for row in 0..self.rows() {
            match (self.class(row), classes.as_mut_slice()) {
                (Some(class), classes) => {
                    if let Some(rows) = classes.get_mut(class) {
                        rows.insert(row);
                    }
                }
                (None, _) => return Err(row),
            }
        }
        Ok(classes)
    }

    /// Rows of different outputs with a minterm in common.
    pub fn class_conflict(&self, columns: &Columns) -> Option<Conflict> {
        conflict(self, columns, |row| self.class(row))
    }

    /// The one output that is 1.
    fn class(&self, row: usize) -> Option<usize> {
        let mut ones = (0..self.outputs).filter(|output| self.part(row, *output) == Part::On);
        let class = ones.next()?;
        ones.next().is_none().then_some(class)
    }
}

/// The cube without what lies in others, in no more than `limit` parts.
fn without(cube: Packed, others: &[Packed], limit: usize) -> Option<Vec<Packed>> {
    let mut parts = vec![cube];
    for other in others {
        parts = parts.iter().flat_map(|part| part.minus(other)).collect();
        if parts.len() > limit {
            return None;
        }
    }
    Some(parts)
}
