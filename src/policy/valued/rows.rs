//! The rows of a table over truth values that are asked of its columns.

use super::{Kind, OPEN, Valued};
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::names::AtomName;
use crate::policy::table::{Reading, Table};
use rustc_hash::FxHashMap;
use std::ops::Range;

/// The most rows that stand for those which leave inputs open.
const WRITTEN_OUT: usize = 65_536;

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
    /// From that of one column: whether it holds by code. Codes beyond those of the column stand for values that it does not
    /// have, and that a cell which is left open may.
    One(usize, Vec<bool>),
    /// From those of these columns: whether it holds by row.
    Several(Vec<usize>, Vec<bool>),
}

impl Valued {
    /// The tests of the columns that hold truth values.
    pub fn truths(&self) -> impl Iterator<Item = Test> {
        let columns = self.columns.iter().enumerate();
        columns.filter_map(|(at, column)| match &column.kind {
            Kind::Truth(name) => Some(Test {
                name: name.clone(),
                place: column.place.clone(),
                of: Columns::One(at, vec![false, true]),
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
                let told = errors.into_iter().map(of_values);
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
}

/// A mistake in rows over atoms, as it is told of rows of values.
fn of_values(error: TableError) -> TableError {
    let kind = match error.kind {
        TableErrorKind::Contradiction { earlier, .. } => TableErrorKind::Disagreement { earlier },
        kind => kind,
    };
    TableError { kind, ..error }
}

/// The atoms that hold by the code of each column, in words.
struct Coded {
    width: usize,
    columns: Vec<Masks>,
}

/// The atoms that one column decides.
#[derive(Default)]
struct Masks {
    width: usize,
    /// All of them.
    atoms: Vec<u64>,
    /// Those that hold, by code.
    holds: Vec<u64>,
    /// The different ones of these, in the order of the codes.
    different: Vec<Vec<u64>>,
}

impl Masks {
    fn of(&self, code: u32) -> &[u64] {
        let start = code as usize * self.width;
        self.holds
            .get(start..start + self.width)
            .unwrap_or_default()
    }
}

impl Coded {
    fn new(valued: &Valued, tests: &[Test]) -> Self {
        let width = tests.len().div_ceil(64);
        let mut of: FxHashMap<usize, Vec<(usize, &[bool])>> = FxHashMap::default();
        for (atom, test) in tests.iter().enumerate() {
            if let Columns::One(column, holds) = &test.of {
                of.entry(*column).or_default().push((atom, holds));
            }
        }
        let columns = (0..valued.columns.len()).map(|column| {
            let Some(own) = of.get(&column) else {
                return Masks::default();
            };
            let codes = own.iter().map(|(_, holds)| holds.len()).max().unwrap_or(0);
            let mut masks = Masks {
                width,
                atoms: vec![0; width],
                holds: vec![0; width * codes],
                different: Vec::new(),
            };
            for (atom, holds) in own {
                set(&mut masks.atoms, *atom);
                for (code, _) in holds.iter().enumerate().filter(|(_, holds)| **holds) {
                    set(&mut masks.holds, code * width * 64 + atom);
                }
            }
            // A column of many values has a row open seldom; then its neighbours are mostly alike.
            let open = valued.columns.get(column);
            if open.is_some_and(|column| column.codes.contains(&OPEN)) {
                let mut known = std::collections::BTreeSet::new();
                for code in 0..codes {
                    let mask = masks.of(code as u32).to_vec();
                    if known.insert(mask.clone()) {
                        masks.different.push(mask);
                    }
                }
            }
            masks
        });
        let columns = columns.collect();
        Self { width, columns }
    }

    /// Whether a test asks a column.
    fn asks(&self, column: usize) -> bool {
        let masks = self.columns.get(column);
        masks.is_some_and(|masks| masks.width > 0)
    }

    /// Whether the rows that leave something open can be written out, up to what stays; else the row that is too much.
    fn written_out(&self, valued: &Valued, stays: impl Fn(usize) -> bool) -> Result<(), usize> {
        let mut all = 0_usize;
        for row in 0..valued.len() {
            let mut here = 1_usize;
            for (column, masks) in self.columns.iter().enumerate() {
                if valued.code(column, row) == OPEN && self.asks(column) && !stays(column) {
                    here = here.saturating_mul(masks.different.len());
                }
            }
            if here > 1 {
                all = all.saturating_add(here);
            }
            if all > WRITTEN_OUT {
                return Err(row);
            }
        }
        Ok(())
    }
}

fn set(words: &mut [u64], at: usize) {
    if let Some(word) = words.get_mut(at / 64) {
        *word |= 1 << (at % 64);
    }
}

fn join(words: &mut [u64], mask: &[u64]) {
    for (word, mask) in words.iter_mut().zip(mask) {
        *word |= mask;
    }
}
