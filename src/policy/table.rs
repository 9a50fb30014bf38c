//! Policy tables of any origin, read without a program.
//!
//! A table has a column for every predicate with `0`, `1`, or `-` for either, one for what is done (`behavior`,
//! `behaviour` or `action`), and as far as they are known `visits`, `q_gap` and `q:NAME` for the value of each
//! behaviour. `done(NAME)` and `failed(NAME)` ask the history of a behaviour. Comma-separated text has the names in its
//! first line; of JSON Lines each line is an object with the names as keys. A row may allow several behaviours: `go|dock`, in
//! JSON a list of names.
//!
//! Rows are packed into machine words as they are read: a million rows of 256 atoms take 40 MB.

mod behaviors;
mod columns;
mod csv;
pub(super) mod json;
mod merge;
mod overlap;
mod rows;

pub use super::names::AtomName;

use super::error::{TableError, TableErrorKind};
use super::reader::Format;
use super::records::{self, Records};
use super::{Field, Policy, Row};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::Atom;
pub(super) use behaviors::Behaviors;
use columns::Role;
pub(super) use columns::{BEHAVIOR, separated};
use rows::{Draft, Rows, Truth};
use std::borrow::Cow;
use std::ops::Range;

/// The most mistakes that are reported for one table; the rest of it is not read.
pub const MISTAKES: usize = 20;

/// A table that was read. Its rows do not contradict each other, and each minterm or cube stands once.
#[derive(Clone, Debug)]
pub struct Table {
    /// What the atoms are called, with the places of their columns.
    pub atoms: Vec<(AtomName, Range<usize>)>,
    /// What the behaviours are called, with the places where they are met first: those that have a column of values,
    /// then those that are done, then those that only the history knows.
    pub behaviors: Vec<(String, Range<usize>)>,
    /// The place of the header.
    pub header: Range<usize>,
    /// How many of the behaviours are chosen, or could be.
    pub chosen: usize,
    /// The behaviour of each column of values, by its number.
    values: Vec<u32>,
    /// The sets of several behaviours that rows allow.
    sets: Vec<Vec<u32>>,
    rows: Rows,
    /// Atoms that are free together in its cubes.
    pub(super) fields: Vec<Field>,
    /// The rows in the order of a policy.
    order: Vec<u32>,
}

impl Table {
    /// Reads a table.
    ///
    /// # Errors
    /// What is wrong with it, sorted by place: [`MISTAKES`] at most.
    pub fn read(text: &[u8], format: Format) -> Result<Self, Vec<TableError>> {
        let mut reading = Reading::default();
        match format {
            Format::Jsonl => json::read(text, &mut reading),
            _ => csv::read(text, &mut reading),
        }
        reading.finish(text)
    }

    /// How many rows it has, those that say the same counted once.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// Whether it has no rows; one that was read has some.
    pub fn is_empty(&self) -> bool {
        self.order.is_empty()
    }

    /// Whether some row leaves atoms free.
    pub fn has_cubes(&self) -> bool {
        self.rows.has_cubes()
    }

    /// Whether it has values of behaviours.
    pub fn has_values(&self) -> bool {
        !self.values.is_empty()
    }

    /// The first behaviour that a row chooses and that has no column of values, with its place.
    pub fn without_values(&self) -> Option<&(String, Range<usize>)> {
        self.behaviors.get(self.values.len()..self.chosen)?.first()
    }

    /// The rows in the order of a policy; their behaviours are those of the table by number.
    pub fn rows(&self) -> impl Iterator<Item = Row> {
        self.order.iter().map(|row| {
            let row = *row as usize;
            self.rows.row(row, self.first(row) as usize, &[])
        })
    }

    /// Whether some row allows several behaviours.
    pub fn has_sets(&self) -> bool {
        !self.sets.is_empty()
    }

    /// The behaviours that each row allows, in the order of a policy, by their numbers.
    pub fn allowed(&self) -> impl Iterator<Item = Vec<usize>> {
        self.order.iter().map(|row| {
            let number = self.rows.behavior.get(*row as usize).copied().unwrap_or(0);
            let set = behaviors::set(number).and_then(|at| self.sets.get(at));
            let all = set.map_or(vec![number], Clone::clone);
            all.into_iter().map(|number| number as usize).collect()
        })
    }

    /// The number of the first behaviour that a row allows.
    fn first(&self, row: usize) -> u32 {
        let number = self.rows.behavior.get(row).copied().unwrap_or(0);
        let set = behaviors::set(number).and_then(|at| self.sets.get(at));
        set.and_then(|set| set.first().copied()).unwrap_or(number)
    }

    /// The place of the row that stands `at` in the policy.
    pub fn place(&self, text: &[u8], at: usize) -> Range<usize> {
        let row = self.order.get(at).map_or(0, |row| *row as usize);
        place(&self.rows, text, row)
    }

    /// The rows as a policy over these atoms, one for each of the table's. `ids` are the table's behaviours, and
    /// `behaviors` those that could be chosen, in their order.
    pub fn policy(
        &self,
        atoms: Vec<Atom>,
        ids: &[Id<Behavior>],
        behaviors: Vec<Id<Behavior>>,
        history: Option<History>,
    ) -> Policy {
        let of = |number: u32| ids.get(number as usize).copied();
        let column = |id: &Id<Behavior>| {
            let mut columns = self.values.iter();
            columns.position(|number| of(*number) == Some(*id))
        };
        let columns: Vec<Option<usize>> = behaviors.iter().map(column).collect();
        let rows = self.order.iter().map(|row| {
            let row = *row as usize;
            let behavior = of(self.first(row)).map_or(0, Id::index);
            self.rows.row(row, behavior, &columns)
        });
        let rows: Vec<Row> = rows.collect();
        Policy {
            history: history.unwrap_or_else(|| window(&atoms, &rows)),
            atoms,
            behaviors,
            rows,
            fields: self.fields.clone(),
            starts: Vec::new(),
            transitions: Vec::new(),
        }
    }
}

/// The shortest window under which these rows can be seen.
fn window(atoms: &[Atom], rows: &[Row]) -> History {
    let remembered: Vec<usize> = (0..atoms.len())
        .filter(|i| !matches!(atoms.get(*i), None | Some(Atom::Predicate(_))))
        .collect();
    let held = |row: &Row| remembered.iter().filter(|i| row.minterm.get(**i)).count();
    let success = atoms.iter().any(|atom| matches!(atom, Atom::Done(_)));
    let failure = atoms.iter().any(|atom| matches!(atom, Atom::Failed(_)));
    let needed = rows.iter().map(held).max().unwrap_or(0);
    History {
        window: if success || failure { needed.max(1) } else { 0 },
        success,
        failure,
    }
}

/// The place of a row in its text.
fn place(rows: &Rows, text: &[u8], row: usize) -> Range<usize> {
    let start = rows.start.get(row).map_or(0, |start| *start as usize);
    if let Some(end) = rows.end.get(row) {
        return start..*end as usize;
    }
    let mut cells = Vec::new();
    if text.get(start) == Some(&b'{') {
        let rest = text.get(start..).unwrap_or_default();
        let end = rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        return start..start + end.unwrap_or(rest.len());
    }
    match Records::starting_at(text, start).next(&mut cells) {
        Ok(true) => records::whole(&cells),
        _ => start..start,
    }
}

/// A table that is being read.
#[derive(Debug, Default)]
pub(super) struct Reading {
    atoms: Vec<(AtomName, Range<usize>)>,
    behaviors: Behaviors,
    values: Vec<u32>,
    header: Range<usize>,
    rows: Rows,
    draft: Draft,
    /// Whether nothing is wrong with the present row.
    clean: bool,
    mistakes: Vec<TableError>,
    stopped: bool,
}

impl Reading {
    /// A table over atoms that follow from what has been read.
    pub(super) fn over(
        atoms: impl Iterator<Item = (AtomName, Range<usize>)>,
        behaviors: Behaviors,
        header: Range<usize>,
    ) -> Self {
        let atoms: Vec<_> = atoms.collect();
        Self {
            rows: Rows::new(atoms.len(), 0),
            atoms,
            behaviors,
            header,
            ..Self::default()
        }
    }

    /// A row of which everything is known: its atoms, those that are free, what is done, how often, and where it stands.
    pub(super) fn row(
        &mut self,
        (words, free): (&[u64], &[u64]),
        behavior: Option<u32>,
        visits: u64,
        place: &Range<usize>,
    ) {
        self.begin();
        self.draft.say_words(words, free);
        self.draft.behavior = behavior;
        self.draft.visits = visits;
        self.rows.push(&self.draft, place.start);
        let end = u32::try_from(place.end).unwrap_or(u32::MAX);
        self.rows.end.push(end);
    }

    /// Says what is wrong at a place.
    pub(super) fn report(&mut self, place: &Range<usize>, kind: TableErrorKind) {
        self.mistake(TableError {
            span: place.clone(),
            kind,
        });
    }

    pub(super) fn mistake(&mut self, error: TableError) {
        self.clean = false;
        if self.mistakes.len() < MISTAKES {
            self.mistakes.push(error);
        }
    }

    /// A mistake behind which nothing can be read.
    fn stop(&mut self, error: TableError) {
        self.mistake(error);
        self.stopped = true;
    }

    /// Whether nothing more is to be read.
    fn is_full(&self) -> bool {
        self.stopped || self.mistakes.len() >= MISTAKES
    }

    /// A row begins.
    fn begin(&mut self) {
        self.draft.clear(&self.rows);
        self.clean = true;
    }

    /// A row ends that began at this byte.
    fn end(&mut self, start: usize) {
        if self.clean {
            self.rows.push(&self.draft, start);
        }
    }

    /// The characters in a cell.
    fn text(&mut self, bytes: &[u8], place: &Range<usize>) -> String {
        let text = String::from_utf8_lossy(bytes);
        if matches!(text, Cow::Owned(_)) {
            self.report(place, TableErrorKind::NoText);
        }
        text.into_owned()
    }

    /// What a cell says is done.
    fn decided(&mut self, name: &[u8], place: &Range<usize>) {
        match self.behaviors.cell(name, place) {
            Ok(number) => self.draft.behavior = Some(number),
            Err(_) if name.is_empty() => self.report(
                place,
                TableErrorKind::UnknownValue {
                    found: String::new(),
                    expected: "a behaviour",
                },
            ),
            Err(kind) => self.report(place, kind),
        }
    }

    /// Which behaviours a list allows.
    fn allowed(&mut self, names: &[Cow<str>], place: &Range<usize>) {
        let named = names.iter();
        let numbers: Result<Vec<u32>, TableErrorKind> = named
            .map(|name| self.behaviors.named(name, place))
            .collect();
        match numbers {
            Ok(numbers) => self.draft.behavior = Some(self.behaviors.several(numbers)),
            Err(kind) => self.report(place, kind),
        }
    }

    /// A cell that says what it may not.
    fn unknown(&mut self, text: &[u8], cell: &Range<usize>, expected: &'static str) {
        let found = String::from_utf8_lossy(&records::value(text, cell)).into_owned();
        self.report(cell, TableErrorKind::UnknownValue { found, expected });
    }

    pub(super) fn finish(mut self, text: &[u8]) -> Result<Table, Vec<TableError>> {
        let chosen = self.behaviors.names.len();
        for (atom, place) in &self.atoms {
            if let Some(name) = atom.behavior() {
                self.behaviors.number(name, place.clone());
            }
        }
        self.shared_names();
        if self.rows.len() == 0 && self.mistakes.is_empty() {
            let from = records::start(text);
            let span = if self.header.is_empty() {
                from..from
            } else {
                self.header.clone()
            };
            self.mistake(TableError {
                span,
                kind: TableErrorKind::Empty,
            });
        }
        let order = self.contradictions(text);
        if !self.mistakes.is_empty() {
            self.mistakes
                .sort_by_key(|error| (error.span.start, error.span.end));
            return Err(self.mistakes);
        }
        Ok(Table {
            atoms: self.atoms,
            behaviors: self.behaviors.names,
            sets: self.behaviors.sets,
            header: self.header,
            chosen,
            values: self.values,
            rows: self.rows,
            fields: Vec::new(),
            order,
        })
    }

    /// The language has one name for one thing.
    fn shared_names(&mut self) {
        let behaviors = std::mem::take(&mut self.behaviors.names);
        for (name, place) in &behaviors {
            let predicate = AtomName::Predicate(name.clone());
            if self.atoms.iter().any(|(atom, _)| *atom == predicate) {
                self.report(place, TableErrorKind::SharedName(name.clone()));
            }
        }
        self.behaviors.names = behaviors;
    }

    /// Tells contradictions, and gives the order of the rows.
    fn contradictions(&mut self, text: &[u8]) -> Vec<u32> {
        // Rows may differ in a column that was left out.
        let lacks = |error: &TableError| {
            matches!(
                error.kind,
                TableErrorKind::UnusableName { .. }
                    | TableErrorKind::Nameless
                    | TableErrorKind::RepeatedColumn(_)
            )
        };
        let room = match self.mistakes.iter().any(lacks) {
            true => 0,
            false => MISTAKES.saturating_sub(self.mistakes.len()),
        };
        let merged = merge::merge(&mut self.rows, room);
        let exact = merged.contradictions.iter().map(|pair| (*pair, false));
        let overlaps = overlap::overlaps(&self.rows, &merged.order, room);
        let all: Vec<_> = exact
            .chain(overlaps.iter().map(|pair| (*pair, true)))
            .collect();
        for ((earlier, later), overlapping) in all {
            let overlap = overlapping.then(|| self.common(earlier, later));
            let error = TableError {
                span: place(&self.rows, text, later),
                kind: TableErrorKind::Contradiction {
                    earlier: place(&self.rows, text, earlier),
                    overlap,
                },
            };
            self.mistake(error);
        }
        merged.order
    }

    /// What holds in the minterms of both of two rows, in words.
    fn common(&self, a: usize, b: usize) -> String {
        let said = self.atoms.iter().enumerate().filter_map(|(i, (atom, _))| {
            match (self.rows.truth(a, i), self.rows.truth(b, i)) {
                (Truth::Yes, _) | (_, Truth::Yes) => Some(format!("{atom} = 1")),
                (Truth::No, _) | (_, Truth::No) => Some(format!("{atom} = 0")),
                (Truth::Either, Truth::Either) => None,
            }
        });
        said.collect::<Vec<_>>().join(", ")
    }
}
