//! The rows of a table over truth values that are asked of its columns.

use super::coded::{Coded, join, set};
use super::{Asks, Kind, OPEN, Valued};
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::names::AtomName;
use crate::policy::table::{Reading, Table};
use std::ops::Range;

/// What becomes of cells that leave something open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Opens {
    /// A truth value stays free, all else is written out.
    Stay,
    /// Every one is written out.
    Out,
}

/// An atom, with how it follows from a row.
#[derive(Clone, Debug)]
pub struct Test {
    /// Its name.
    pub name: AtomName,
    /// The place of the column that it is asked of.
    pub place: Range<usize>,
    /// How it follows.
    pub of: Columns,
}

/// How an atom follows from the cells of a row.
#[derive(Clone, Debug)]
pub enum Columns {
    /// From that of one column.
    One(usize, Holds),
    /// From those of these columns: whether it holds by row.
    Several(Vec<usize>, Vec<bool>),
}

/// For which codes of a column an atom holds.
#[derive(Clone, Debug)]
pub enum Holds {
    /// Where this does.
    Asked(Asks),
    /// Where this says so. Codes beyond those of the column stand for values that it does not have, and that a cell which is left
    /// open may.
    Listed(Vec<bool>),
}

impl Holds {
    /// Whether the atom holds for a code.
    pub(super) fn at(&self, code: u32) -> bool {
        match self {
            Self::Asked(asks) => asks.holds(code),
            Self::Listed(holds) => holds.get(code as usize) == Some(&true),
        }
    }
}

impl Valued {
    /// The tests of the columns that hold truth values.
    pub fn truths(&self) -> impl Iterator<Item = Test> {
        let columns = self.columns.iter().enumerate();
        columns.filter_map(|(at, column)| match &column.kind {
            Kind::Truth(name) => Some(Test {
                name: name.clone(),
                place: column.place.clone(),
                of: Columns::One(at, Holds::Listed(vec![false, true])),
            }),
            _ => None,
        })
    }

    /// The rows over the atoms that are tested.
    ///
    /// # Errors
    /// Rows that contradict each other, or names that do not go together; rows that leave too much open.
    pub fn table(&self, tests: &[Test]) -> Result<Table, Vec<TableError>> {
        let mut reading = Reading::over(
            tests
                .iter()
                .map(|test| (test.name.clone(), test.place.clone())),
            self.behaviors.clone(),
            self.header.clone(),
        );
        for (_, column) in self.inputs() {
            if self.behaviors().any(|behavior| behavior == column.name) {
                let kind = TableErrorKind::SharedInput(column.name.clone());
                reading.report(&column.place, kind);
            }
        }
        let each = self.each(tests, Opens::Stay, |row, words, free| {
            let behavior = self.decided.get(row).copied();
            let visits = self.visits.get(row).copied().unwrap_or(0);
            reading.row((words, free), behavior, visits, &self.place(row));
        });
        match each {
            Ok(()) => reading.finish(&[]).map_err(|errors| {
                let told = errors.into_iter().map(|error| self.told(error));
                told.collect()
            }),
            Err(error) => Err(vec![error]),
        }
    }

    /// Goes through the rows: the number of each, the atoms that hold, and those that are free. A row that leaves inputs open
    /// stands for one with each of their values that a test tells from others.
    ///
    /// # Errors
    /// The rows that are to be written out are too many, or a row leaves open what several columns decide.
    pub fn each(
        &self,
        tests: &[Test],
        opens: Opens,
        mut say: impl FnMut(usize, &[u64], &[u64]),
    ) -> Result<(), TableError> {
        let coded = Coded::new(self, tests);
        let several: Vec<(usize, &[usize], &[bool])> = tests
            .iter()
            .enumerate()
            .filter_map(|(atom, test)| match &test.of {
                Columns::Several(of, holds) => Some((atom, &**of, &**holds)),
                Columns::One(..) => None,
            })
            .collect();
        let stays = |column: usize| {
            let truth = matches!(
                self.columns.get(column).map(|column| &column.kind),
                Some(Kind::Truth(_))
            );
            opens == Opens::Stay && truth
        };
        if let Err(row) = coded.written_out(self, stays) {
            return Err(TableError {
                span: self.place(row),
                kind: TableErrorKind::Wide,
            });
        }
        for row in 0..self.len() {
            let mut words = vec![0; coded.width];
            let mut free = vec![0; coded.width];
            let mut open: Vec<usize> = Vec::new();
            for (column, masks) in coded.columns.iter().enumerate() {
                match self.code(column, row) {
                    OPEN => open.push(column),
                    code => join(&mut words, masks.of(code)),
                }
            }
            for (atom, of, holds) in &several {
                if of.iter().any(|column| open.contains(column)) {
                    let name = tests.get(*atom).map(|test| test.name.to_string());
                    return Err(TableError {
                        span: self.place(row),
                        kind: TableErrorKind::Open(name.unwrap_or_default()),
                    });
                }
                if holds.get(row) == Some(&true) {
                    set(&mut words, *atom);
                }
            }
            let mut all = vec![words];
            for column in open.into_iter().filter(|column| coded.asks(*column)) {
                let Some(masks) = coded.columns.get(column) else {
                    continue;
                };
                if stays(column) {
                    join(&mut free, &masks.atoms);
                    continue;
                }
                let each = all.iter().flat_map(|words| {
                    masks.different.iter().map(|mask| {
                        let mut words = words.clone();
                        join(&mut words, mask);
                        words
                    })
                });
                all = each.collect();
            }
            for words in all {
                say(row, &words, &free);
            }
        }
        Ok(())
    }

    /// The code of a cell.
    pub fn code(&self, column: usize, row: usize) -> u32 {
        let column = self.columns.get(column);
        let code = column.and_then(|column| column.codes.get(row));
        code.copied().unwrap_or(OPEN)
    }

    /// The place of a row.
    pub fn place(&self, row: usize) -> Range<usize> {
        let place = self.places.get(row);
        place.map_or(0..0, |place| place.start as usize..place.end as usize)
    }

    /// A mistake in rows over atoms, as it is told of rows of values.
    fn told(&self, error: TableError) -> TableError {
        let kind = match error.kind {
            TableErrorKind::Contradiction { earlier, .. } => TableErrorKind::Disagreement {
                rounded: self.rounded(&earlier, &error.span),
                earlier,
            },
            kind => kind,
        };
        TableError { kind, ..error }
    }

    /// The first numbers that the rows at two places write differently and that are one in 64 bits.
    fn rounded(&self, one: &Range<usize>, other: &Range<usize>) -> Option<[String; 2]> {
        let at = |place: &Range<usize>| (0..self.len()).find(|row| self.place(*row) == *place);
        let rows = [at(one)?, at(other)?];
        self.columns.iter().find_map(|column| {
            let Kind::Number(_, values) = &column.kind else {
                return None;
            };
            let written = rows.map(|row| {
                let first = || values.get(*column.codes.get(row)? as usize);
                let number = column.rounded.get(&row);
                number.or_else(|| first().map(|(number, _)| number))
            });
            let [Some(one), Some(other)] = written else {
                return None;
            };
            let same = rows.map(|row| column.codes.get(row));
            let [a, b] = same;
            (a == b && one != other).then(|| [one.to_string(), other.to_string()])
        })
    }
}
