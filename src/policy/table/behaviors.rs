//! The behaviours of a table, numbered as they are met.

use crate::policy::error::TableErrorKind;
use crate::policy::names;
use crate::spelling::bare;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// Names with the places where they are met first.
#[derive(Clone, Debug, Default)]
pub(super) struct Behaviors {
    pub(super) names: Vec<(String, Range<usize>)>,
    numbers: FxHashMap<String, u32>,
    /// The last cell that was looked up: neighbours are often alike.
    last: (Vec<u8>, u32),
}

impl Behaviors {
    /// The number of a behaviour by its name.
    pub(super) fn number(&mut self, name: &str, place: Range<usize>) -> u32 {
        if let Some(number) = self.numbers.get(name) {
            return *number;
        }
        let number = u32::try_from(self.names.len()).unwrap_or(u32::MAX);
        self.names.push((name.to_owned(), place));
        self.numbers.insert(name.to_owned(), number);
        number
    }

    /// The number of the behaviour in a cell.
    ///
    /// # Errors
    /// Nothing can be called so.
    pub(super) fn cell(
        &mut self,
        text: &[u8],
        place: &Range<usize>,
    ) -> Result<u32, TableErrorKind> {
        if !text.is_empty() && self.last.0 == text {
            return Ok(self.last.1);
        }
        let name = std::str::from_utf8(text).map_err(|_| TableErrorKind::NoText)?;
        let name = bare(name);
        if !self.numbers.contains_key(name) {
            names::check(name)?;
        }
        let number = self.number(name, place.clone());
        self.last = (text.to_owned(), number);
        Ok(number)
    }
}
