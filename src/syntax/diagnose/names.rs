//! Names that are written with marks in them, and calls without parentheses.

use super::Place;
use super::words::is_word;
use crate::diagnostic::Diagnostic;
use crate::spelling::RESERVED;
use crate::syntax::tokens::{Kind, joined_by};
use crate::syntax::words::{CALLED, FUNCTIONS, name_of_words};

impl Place<'_> {
    /// Advice on names with marks in them, and on calls without parentheses.
    pub(super) fn advised_on_names(&self, diagnostic: Diagnostic) -> Diagnostic {
        let (Some(before), Some(next)) = (self.before.filter(|token| is_word(*token)), self.next())
        else {
            return diagnostic;
        };
        let found = self.found();
        let touching = before.end == self.found.start && self.found.end == next.start;
        if matches!(found, "-" | "." | "/" | "'") && touching && is_word(next) {
            let (left, right) = (self.before(), next.of(self.text));
            if left == "std" {
                return diagnostic.help("the library is used as a whole: `use std`");
            }
            let behind = self.tokens.partition_point(|token| token.end <= next.end);
            let behind = self.tokens.get(behind..).unwrap_or_default();
            let rest = joined_by(self.text, found, next.end, behind);
            let rest = rest.map(|word| word.of(self.text));
            let words: Vec<&str> = [left, right].into_iter().chain(rest).collect();
            return diagnostic.help(name_of_words(&words.join("_")));
        }
        let is_argument = matches!(self.found.kind, Kind::Word | Kind::Name)
            && !RESERVED.contains(&found)
            && (CALLED.contains(&self.before()) || FUNCTIONS.contains(&self.before()))
            && self.same_line_as_before();
        match is_argument {
            true => diagnostic.help(format!(
                "if `{found}` is an argument: `{}({found})`",
                self.before()
            )),
            false => diagnostic,
        }
    }
}
