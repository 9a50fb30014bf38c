//! A table of values that is being read: what every reader says in its own words.

use super::{Column, Decimal, Kind, OPEN, Valued};
use crate::ir::input::Measure;
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::names::{self, AtomName};
use crate::policy::table::{Behaviors, MISTAKES};
use crate::spelling;
use rustc_hash::FxHashMap;
use std::ops::Range;
use std::sync::Arc;

/// A table of values that is being read.
#[derive(Debug, Default)]
pub struct Builder {
    columns: Vec<Open>,
    behaviors: Behaviors,
    decided: Vec<u32>,
    visits: Vec<u64>,
    places: Vec<Range<u32>>,
    /// The codes of the present row; `None` where it has not said anything yet.
    row: Vec<Option<u32>>,
    decision: Option<u32>,
    visited: u64,
    clean: bool,
    mistakes: Vec<TableError>,
}

/// A column that is being read.
#[derive(Debug)]
struct Open {
    column: Column,
    /// The codes of what has been met: of numbers by their bits, of values by their names.
    numbers: FxHashMap<u64, u32>,
    names: FxHashMap<String, u32>,
    /// The values that it may have alone, where they were listed.
    listed: Option<Arc<[String]>>,
}

impl Builder {
    /// Says what is wrong at a place.
    pub fn report(&mut self, place: &Range<usize>, kind: TableErrorKind) {
        self.mistake(TableError {
            span: place.clone(),
            kind,
        });
    }

    /// Says what is wrong.
    pub fn mistake(&mut self, error: TableError) {
        self.clean = false;
        let mut known = self.mistakes.iter_mut();
        let counted = known.any(|known| known.counts(&error));
        if !counted && self.mistakes.len() < MISTAKES {
            self.mistakes.push(error);
        }
    }

    /// Whether so much is wrong that nothing more is to be read.
    pub fn is_full(&self) -> bool {
        self.mistakes.len() >= MISTAKES
    }

    /// Whether nothing is wrong so far.
    pub fn is_sound(&self) -> bool {
        self.mistakes.is_empty()
    }

    /// A column of truth values.
    pub fn truth(&mut self, name: &str, place: &Range<usize>) -> usize {
        self.column(name, place, Kind::Truth(AtomName::read(name)), None)
    }

    /// A column of numbers.
    pub fn number(&mut self, name: &str, place: &Range<usize>, measure: Measure) -> usize {
        self.column(name, place, Kind::Number(measure, Vec::new()), None)
    }

    /// A column that has one of these values, or if there are none, one of those that appear.
    pub fn category(&mut self, name: &str, place: &Range<usize>, values: Vec<String>) -> usize {
        let listed = (!values.is_empty()).then(|| values.clone().into());
        let mut known: FxHashMap<String, u32> = FxHashMap::default();
        for (value, code) in values.iter().zip(0..) {
            if let Some(why) = spelling::unusable(value) {
                let name = value.clone();
                self.report(place, TableErrorKind::UnusableName { name, why });
            }
            if known.insert(value.clone(), code).is_some() {
                self.report(place, TableErrorKind::RepeatedValue(value.clone()));
            }
        }
        let at = self.column(name, place, Kind::Category(values), listed);
        if let Some(open) = self.columns.get_mut(at) {
            open.names = known;
        }
        at
    }

    fn column(
        &mut self,
        name: &str,
        place: &Range<usize>,
        kind: Kind,
        listed: Option<Arc<[String]>>,
    ) -> usize {
        let name = match &kind {
            Kind::Truth(atom) => atom.to_string(),
            _ => spelling::bare(name).to_owned(),
        };
        let checked = match &kind {
            Kind::Truth(atom) => atom.check(),
            _ => names::check(&name),
        };
        if let Err(kind) = checked {
            self.report(place, kind);
        }
        if self.columns.iter().any(|open| open.column.name == name) {
            self.report(place, TableErrorKind::RepeatedColumn(name.clone()));
        }
        self.columns.push(Open {
            column: Column {
                name,
                place: place.clone(),
                kind,
                codes: Vec::new(),
                rounded: FxHashMap::default(),
            },
            numbers: FxHashMap::default(),
            names: FxHashMap::default(),
            listed,
        });
        self.columns.len() - 1
    }

    /// A row begins.
    pub fn begin(&mut self) {
        self.row.clear();
        self.row.resize(self.columns.len(), None);
        self.decision = None;
        self.visited = 0;
        self.clean = true;
    }

    /// What a cell says of a column; `-` leaves it open.
    pub fn cell(&mut self, column: usize, text: &str, place: &Range<usize>) {
        let Some(open) = self.columns.get_mut(column) else {
            return;
        };
        if let Some(Some(_)) = self.row.get(column) {
            let name = open.column.name.clone();
            return self.report(place, TableErrorKind::RepeatedColumn(name));
        }
        let row = self.decided.len();
        match open.code(text, row) {
            Ok(code) => self.say(column, code),
            Err(kind) => self.report(place, kind),
        }
    }

    /// Leaves a column open.
    pub fn leave_open(&mut self, column: usize) {
        self.say(column, OPEN);
    }

    fn say(&mut self, column: usize, code: u32) {
        if let Some(cell) = self.row.get_mut(column) {
            *cell = Some(code);
        }
    }

    /// What is done: a behaviour, or several with `|` between them.
    pub fn decide(&mut self, text: &str, place: &Range<usize>) {
        let decided = match text {
            "" => Err(TableErrorKind::UnknownValue {
                found: String::new(),
                expected: "a behaviour",
            }),
            _ => self.behaviors.cell(text.as_bytes(), place),
        };
        match decided {
            Ok(number) => self.decision = Some(number),
            Err(kind) => self.report(place, kind),
        }
    }

    /// What may be done, one of these.
    pub fn allow<'n>(&mut self, names: impl IntoIterator<Item = &'n str>, place: &Range<usize>) {
        let named = names.into_iter();
        let numbers: Result<Vec<u32>, TableErrorKind> = named
            .map(|name| self.behaviors.named(name, place))
            .collect();
        match numbers {
            Ok(numbers) if numbers.is_empty() => {}
            Ok(numbers) => self.decision = Some(self.behaviors.several(numbers)),
            Err(kind) => self.report(place, kind),
        }
    }

    /// How many decisions stand behind the row.
    pub fn visits(&mut self, visits: u64) {
        self.visited = visits;
    }

    /// A row ends, which stands at a place.
    pub fn end(&mut self, place: Range<usize>) {
        let silent = self.row.iter().position(Option::is_none);
        if let (Some(at), true) = (silent, self.clean) {
            let name = self.columns.get(at).map(|open| open.column.name.clone());
            let kind = TableErrorKind::MissingKey(name.unwrap_or_default());
            self.report(&place, kind);
        }
        let Some(decision) = self.decision.filter(|_| self.clean) else {
            return;
        };
        for (open, code) in self.columns.iter_mut().zip(&self.row) {
            open.column.codes.push(code.unwrap_or(OPEN));
        }
        self.decided.push(decision);
        if self.visited > 0 || !self.visits.is_empty() {
            self.visits.resize(self.decided.len() - 1, 0);
            self.visits.push(self.visited);
        }
        let at = |at: usize| u32::try_from(at).unwrap_or(u32::MAX);
        self.places.push(at(place.start)..at(place.end));
    }

    /// The table; `header` is the place of its header.
    ///
    /// # Errors
    /// What is wrong with it, sorted by place.
    pub fn finish(mut self, header: Range<usize>) -> Result<Valued, Vec<TableError>> {
        if self.decided.is_empty() && self.is_sound() {
            self.report(&header, TableErrorKind::Empty);
        }
        if !self.is_sound() {
            let place = |error: &TableError| (error.span.start, error.span.end);
            self.mistakes.sort_by_key(place);
            return Err(self.mistakes);
        }
        let columns = self.columns.into_iter().map(Open::closed);
        Ok(Valued {
            columns: columns.collect(),
            header,
            behaviors: self.behaviors,
            decided: self.decided,
            visits: self.visits,
            places: self.places,
        })
    }
}

impl Open {
    /// The code of what the cell of a row says.
    fn code(&mut self, text: &str, row: usize) -> Result<u32, TableErrorKind> {
        let unknown = |expected| TableErrorKind::UnknownValue {
            found: text.to_owned(),
            expected,
        };
        match &mut self.column.kind {
            Kind::Truth(_) => match text {
                "0" => Ok(0),
                "1" => Ok(1),
                "-" => Ok(OPEN),
                _ if text.eq_ignore_ascii_case("false") => Ok(0),
                _ if text.eq_ignore_ascii_case("true") => Ok(1),
                _ => Err(unknown("`0`, `1` or `-`")),
            },
            Kind::Number(_, _) if text == "-" => Ok(OPEN),
            Kind::Number(measure, values) => {
                let number = Decimal::parse(text);
                let number = number.ok_or_else(|| unknown(Decimal::wanted(text)))?;
                // There is no minus zero.
                let value = measure.unit.si(number.value()) + 0.0;
                let next = u32::try_from(values.len()).unwrap_or(OPEN);
                let code = *self.numbers.entry(value.to_bits()).or_insert(next);
                match values.get(code as usize) {
                    None => values.push((number, value)),
                    Some((known, _)) if *known != number => {
                        self.column.rounded.insert(row, number);
                    }
                    Some(_) => {}
                }
                Ok(code)
            }
            Kind::Category(values) => {
                let value = spelling::bare(text);
                if let Some(code) = self.names.get(value) {
                    return Ok(*code);
                }
                if text == "-" {
                    return Ok(OPEN);
                }
                if let Some(listed) = &self.listed {
                    return Err(TableErrorKind::NoValue {
                        found: value.to_owned(),
                        column: self.column.name.clone(),
                        values: listed.clone(),
                        cells: 1,
                    });
                }
                if let Some(why) = spelling::unusable(value) {
                    let name = value.to_owned();
                    return Err(TableErrorKind::UnusableName { name, why });
                }
                let code = u32::try_from(values.len()).unwrap_or(OPEN);
                values.push(value.to_owned());
                self.names.insert(value.to_owned(), code);
                Ok(code)
            }
        }
    }

    /// The column with its numbers in ascending order.
    fn closed(self) -> Column {
        let mut column = self.column;
        if let Kind::Number(_, values) = &mut column.kind {
            let mut order: Vec<usize> = (0..values.len()).collect();
            let value = |at: &usize| values.get(*at).map_or(0.0, |(_, value)| *value);
            order.sort_by(|a, b| value(a).total_cmp(&value(b)));
            let mut codes = vec![0; values.len()];
            for (code, at) in (0..).zip(&order) {
                if let Some(slot) = codes.get_mut(*at) {
                    *slot = code;
                }
            }
            let sorted = order.iter().filter_map(|at| values.get(*at).cloned());
            *values = sorted.collect();
            for code in &mut column.codes {
                *code = codes.get(*code as usize).copied().unwrap_or(OPEN);
            }
        }
        column
    }
}
