//! The rows of a table over truth values that are asked of its columns.

use super::coded::{Coded, join, set};
use super::{Asks, Kind, OPEN, Valued};
use crate::policy::Field;
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::names::AtomName;
use crate::policy::table::{Reading, Table};
use std::collections::BTreeSet;
use std::ops::Range;

/// The most rows that stand for those which leave inputs open.
const WRITTEN_OUT: usize = 16_384;

/// The most rows times tests: each row has a bit for each test.
const CELLS: usize = 1 << 30;

/// How many rows one that leaves inputs open may stand for, if those which stand for more are cubes.
fn most_written_out(mut counts: Vec<usize>) -> usize {
    counts.retain(|count| *count > 1);
    counts.sort_unstable();
    let mut all = 0_usize;
    // Those that stand for as many are written out together, or none of them is.
    let alike = counts.chunk_by(|a, b| a == b).filter_map(|alike| {
        let count = *alike.first()?;
        Some((count, count.saturating_mul(alike.len())))
    });
    let fit = alike.take_while(|(_, together)| {
        all = all.saturating_add(*together);
        all <= WRITTEN_OUT
    });
    fit.last().map_or(1, |(count, _)| count)
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

    /// The rows over the atoms that are tested. A row that leaves inputs open stands for one with each of their values that a test
    /// tells from others, or is a cube where these would be many.
    ///
    /// # Errors
    /// Rows that contradict each other, names that do not go together, or more tests than there is room for.
    pub fn table(&self, tests: &[Test]) -> Result<Table, Vec<TableError>> {
        let most = CELLS / self.len().max(1);
        if tests.len() > most {
            let kind = TableErrorKind::Numerous {
                comparisons: tests.len(),
                most,
            };
            let span = self.header.clone();
            return Err(vec![TableError { span, kind }]);
        }
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
        let coded = Coded::new(self, tests);
        let is_truth = |column: &usize| {
            let column = self.columns.get(*column);
            matches!(column.map(|column| &column.kind), Some(Kind::Truth(_)))
        };
        let count = |open: &[usize]| {
            let out = open.iter().filter(|column| !is_truth(column));
            out.fold(1_usize, |all, column| {
                all.saturating_mul(coded.different(*column).len())
            })
        };
        let mut counts: Vec<usize> = Vec::new();
        let each = self.each(&coded, tests, |_, _, open| counts.push(count(open)));
        let most = most_written_out(counts);
        let mut cubes: BTreeSet<usize> = BTreeSet::new();
        let each = each.and_then(|()| {
            self.each(&coded, tests, |row, words, open| {
                let behavior = self.decided.get(row).copied();
                let visits = self.visits.get(row).copied().unwrap_or(0);
                let (mut stay, mut out): (Vec<usize>, Vec<usize>) =
                    open.iter().partition(|column| is_truth(column));
                if count(open) > most {
                    cubes.extend(&out);
                    stay.append(&mut out);
                }
                let mut free = vec![0; coded.width];
                for column in stay {
                    join(&mut free, coded.atoms(column));
                }
                for words in coded.written_out(words, &out) {
                    reading.row((&words, &free), behavior, visits, &self.place(row));
                }
            })
        });
        each.map_err(|error| vec![error])?;
        let mut table = reading.finish(&[]).map_err(|errors| {
            let told = errors.into_iter().map(|error| self.told(error));
            told.collect::<Vec<TableError>>()
        })?;
        table.fields = coded.fields(&cubes.into_iter().collect::<Vec<usize>>());
        Ok(table)
    }

    /// Goes through the rows: the number of each, the atoms that hold, and the atoms of each column that it leaves open.
    ///
    /// # Errors
    /// A row leaves open what several columns decide.
    pub fn cubes(
        &self,
        tests: &[Test],
        mut say: impl FnMut(usize, &[u64], &[Field]),
    ) -> Result<(), TableError> {
        let coded = Coded::new(self, tests);
        self.each(&coded, tests, |row, words, open| {
            say(row, words, &coded.fields(open));
        })
    }

    /// Goes through the rows: the number of each, the atoms that hold, and the columns that it leaves open and a test asks.
    fn each(
        &self,
        coded: &Coded,
        tests: &[Test],
        mut say: impl FnMut(usize, &[u64], &[usize]),
    ) -> Result<(), TableError> {
        let several: Vec<(usize, &[usize], &[bool])> = tests
            .iter()
            .enumerate()
            .filter_map(|(atom, test)| match &test.of {
                Columns::Several(of, holds) => Some((atom, &**of, &**holds)),
                Columns::One(..) => None,
            })
            .collect();
        for row in 0..self.len() {
            let mut words = vec![0; coded.width];
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
            open.retain(|column| coded.asks(*column));
            say(row, &words, &open);
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

#[cfg(test)]
mod tests {
    use super::{WRITTEN_OUT, most_written_out};
    use proptest::prelude::*;

    proptest! {
        /// However many rows stand for as many, all that are written out keep the limit.
        #[test]
        fn what_is_written_out_keeps_its_limit(counts in prop::collection::vec(prop_oneof![1_usize..40, 1_usize..9000], 0..600)) {
            let most = most_written_out(counts.clone());
            let out = counts.iter().filter(|count| **count > 1 && **count <= most);
            prop_assert!(out.sum::<usize>() <= WRITTEN_OUT);
            // One more kind of row would not.
            if let Some(next) = counts.iter().filter(|count| **count > most).min() {
                let out = counts.iter().filter(|count| **count > 1 && *count <= next);
                prop_assert!(out.sum::<usize>() > WRITTEN_OUT);
            }
        }
    }
}
