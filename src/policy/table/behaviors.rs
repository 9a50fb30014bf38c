//! The behaviours of a table, numbered as they are met.

use crate::policy::error::TableErrorKind;
use crate::policy::names;
use crate::spelling::bare;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// The bit that a set of behaviours has in its number.
const SET: u32 = 1 << 31;

/// The place of a set among all by its number; `None` for the number of a behaviour.
pub(super) fn set(number: u32) -> Option<usize> {
    (number & SET != 0).then_some((number & !SET) as usize)
}

/// The names in a cell: `|` divides them, outside of backquotes.
fn alternatives(text: &str) -> Vec<&str> {
    let mut quoted = false;
    let divides = |c: char| {
        quoted ^= c == '`';
        c == '|' && !quoted
    };
    text.split(divides).map(str::trim).collect()
}

/// Names with the places where they are met first.
#[derive(Clone, Debug, Default)]
pub(in crate::policy) struct Behaviors {
    pub(in crate::policy) names: Vec<(String, Range<usize>)>,
    numbers: FxHashMap<String, u32>,
    /// The sets of several behaviours that rows allow, each sorted, once each.
    pub(super) sets: Vec<Vec<u32>>,
    set_numbers: FxHashMap<Vec<u32>, u32>,
    /// The last cell that was looked up: neighbours are often alike.
    last: (Vec<u8>, u32),
}

impl Behaviors {
    /// The behaviours that a number stands for.
    pub(in crate::policy) fn all<'s>(&'s self, number: &'s u32) -> &'s [u32] {
        let several = set(*number).and_then(|at| self.sets.get(at));
        several.map_or(std::slice::from_ref(number), Vec::as_slice)
    }

    /// The number of a behaviour by its name.
    pub(in crate::policy) fn number(&mut self, name: &str, place: Range<usize>) -> u32 {
        if let Some(number) = self.numbers.get(name) {
            return *number;
        }
        let number = u32::try_from(self.names.len()).unwrap_or(u32::MAX);
        self.names.push((name.to_owned(), place));
        self.numbers.insert(name.to_owned(), number);
        number
    }

    /// The number of what a cell allows: one behaviour, or several with `|` between them.
    ///
    /// # Errors
    /// Nothing can be called so.
    pub(in crate::policy) fn cell(
        &mut self,
        text: &[u8],
        place: &Range<usize>,
    ) -> Result<u32, TableErrorKind> {
        if !text.is_empty() && self.last.0 == text {
            return Ok(self.last.1);
        }
        let name = std::str::from_utf8(text).map_err(|_| TableErrorKind::NoText)?;
        let names = alternatives(name).into_iter();
        let numbers: Result<Vec<u32>, TableErrorKind> =
            names.map(|name| self.named(name, place)).collect();
        let number = self.several(numbers?);
        self.last = (text.to_owned(), number);
        Ok(number)
    }

    /// The number of the behaviour of this name.
    ///
    /// # Errors
    /// Nothing can be called so.
    pub(in crate::policy) fn named(
        &mut self,
        name: &str,
        place: &Range<usize>,
    ) -> Result<u32, TableErrorKind> {
        let name = bare(name);
        if !self.numbers.contains_key(name) {
            names::check(name)?;
        }
        Ok(self.number(name, place.clone()))
    }

    /// The number of a set of behaviours, that of the behaviour itself if it is one alone.
    pub(in crate::policy) fn several(&mut self, mut numbers: Vec<u32>) -> u32 {
        numbers.sort_unstable();
        numbers.dedup();
        match numbers.as_slice() {
            [one] => *one,
            _ => {
                let next = SET | u32::try_from(self.sets.len()).unwrap_or(0);
                let number = *self.set_numbers.entry(numbers.clone()).or_insert(next);
                if number == next {
                    self.sets.push(numbers);
                }
                number
            }
        }
    }
}
