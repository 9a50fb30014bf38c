//! Marks and words that are spare, and those that other notations have in the place of others.

use super::Place;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::Kind;
use crate::syntax::words::UNITS;

impl Place<'_> {
    /// The message for a mark or a word that has to go, or to be written otherwise.
    pub(super) fn spare(&self) -> Option<Diagnostic> {
        self.spare_mark()
            .or_else(|| self.doubled_comma())
            .or_else(|| self.required_when())
            .or_else(|| self.claimed_with_is())
            .or_else(|| self.member_by_one())
            .or_else(|| self.raised_by_letter())
    }

    /// `2 m³/s`: an exponent as it is printed.
    fn raised_by_letter(&self) -> Option<Diagnostic> {
        let after_number = self.before.is_some_and(|token| token.kind == Kind::Number);
        let unit = self.found();
        let right = unit.replace('²', "^2").replace('³', "^3");
        let known = right
            .split('^')
            .next()
            .is_some_and(|unit| UNITS.contains(&unit));
        (after_number && known && right != unit).then(|| {
            let message = "an exponent of a unit is written with `^`";
            Diagnostic::new(Code::E0114, self.span(), message).write(
                self.span(),
                right,
                Applicability::Safe,
            )
        })
    }

    /// `max(a,, b)`
    fn doubled_comma(&self) -> Option<Diagnostic> {
        let doubled = self.found() == "," && self.before() == "," && self.open_is_paren();
        doubled.then(|| {
            Diagnostic::new(Code::E0118, self.span(), "one comma is enough")
                .label("drop it")
                .fix("drop the `,`", self.span(), "", Applicability::Safe)
        })
    }

    /// `nuts(oak)++`
    fn member_by_one(&self) -> Option<Diagnostic> {
        let right = match self.found() {
            "++" => "+= 1",
            "--" => "-= 1",
            _ => return None,
        };
        let sets = self.failure.strict == Rule::strict_stmt && self.before() == ")";
        let message = format!("`{}` is no operator here", self.found());
        sets.then(|| {
            Diagnostic::new(Code::E0110, self.span(), message).write(
                self.span(),
                right,
                Applicability::Unsafe,
            )
        })
    }

    /// `requires when visible(A)`
    fn required_when(&self) -> Option<Diagnostic> {
        let (clause, when) = (self.second_before?, self.before?);
        let said = clause.of(self.text) == "requires" && when.of(self.text) == "when";
        said.then(|| {
            let drop = self.span_of(when).to(self.span().before());
            let message = "what a behaviour `requires` follows at once";
            Diagnostic::new(Code::E0101, self.span_of(when), message)
                .label("this is said of `succeed` and `fail`")
                .fix("drop `when`", drop, "", Applicability::Safe)
        })
    }

    /// `claim hand is never dead`
    fn claimed_with_is(&self) -> Option<Diagnostic> {
        let claims = matches!(self.after_found(), "never" | "reaches" | "equals");
        let said = self.found() == "is" && self.line_begins_with("claim") && claims;
        let next = self.next().filter(|_| said)?;
        let drop = Span::new(self.file, self.found.start, next.start);
        let message = format!("a claim says `{}` at once", self.after_found());
        Some(
            Diagnostic::new(Code::E0101, self.span(), message)
                .label("drop `is`")
                .fix("drop `is`", drop, "", Applicability::Safe),
        )
    }

    /// `goto(A),;`
    fn spare_mark(&self) -> Option<Diagnostic> {
        let spare = self.found() == ";" && self.before() == ",";
        (spare && self.failure.strict == Rule::strict_child).then(|| {
            Diagnostic::new(Code::E0118, self.span(), "nothing needs a `;` here")
                .label("drop it")
                .note("commas part the children of a node")
                .fix("drop the `;`", self.span(), "", Applicability::Safe)
        })
    }
}
