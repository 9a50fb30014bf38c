//! Why a text does not parse.

mod advice;
mod characters;
mod ends;
mod foreign;
mod forms;
mod marks;
mod names;
mod pieces;
mod places;
mod respelled;
mod rewrite;
mod spare;
mod units;
mod words;

pub(super) use characters::{no_remainder, unclosed_quote};
use ends::OPEN_ENDS;
pub(super) use ends::{ends_after, unfinished};
pub(super) use foreign::{dashed, other_comment};
pub(super) use units::{no_such_unit, one_unit, unit_of_a_point, units_note};
pub(super) use words::end_is_missing;

use super::brackets::{innermost_open, unclosed};
use super::expected;
use super::glance::Glance;
use super::grammar::Rule;
use super::tokens::{Kind, Token};
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::{FileId, Span};

/// A text that does not parse.
pub(super) struct Failure {
    /// Where the text begins.
    pub(super) start: usize,
    /// Where nothing fitted.
    pub(super) at: usize,
    /// What could have stood there.
    pub(super) expected: Vec<Rule>,
    /// What the text was to be.
    pub(super) strict: Rule,
}

/// The message for a text that does not parse, and the byte up to which it explains what is wrong.
pub(super) fn failure(
    file: FileId,
    text: &str,
    (tokens, glance): (&[Token], &Glance),
    failure: &Failure,
) -> (usize, Diagnostic) {
    let index = tokens.partition_point(|token| token.end <= failure.at);
    let (before, after) = tokens.split_at_checked(index).unwrap_or((tokens, &[]));
    let is_code = |token: &&Token| token.kind != Kind::Comment;
    let mut before = before.iter().copied().rev().filter(|token| is_code(&token));
    let (before, second_before) = (before.next(), before.next());
    let found = after.iter().copied().find(|token| is_code(&token));
    let is_end = found.is_none();
    let found = found.unwrap_or(Token {
        kind: Kind::Comment,
        start: text.len(),
        end: text.len(),
    });
    let place = Place {
        file,
        text,
        tokens,
        glance,
        failure,
        found,
        before,
        second_before,
    };
    if is_end {
        return (failure.at, place.at_the_end());
    }
    if let Some(diagnostic) = place.comment() {
        return (failure.at, diagnostic);
    }
    if let Some(diagnostic) = place.look_alike() {
        return (failure.at, diagnostic);
    }
    if let Some((last, diagnostic)) = place.cut_before() {
        return (last.end, diagnostic);
    }
    if let Some(diagnostic) = place.rewritten().or_else(|| place.misplaced_mark()) {
        return (failure.at, diagnostic);
    }
    let cut = place.cut_line().or_else(|| place.cut_value());
    if let Some((last, diagnostic)) = cut.or_else(|| place.cut_before_entry()) {
        return match place.unopened_body(last) {
            Some((end, brace)) => (
                end,
                diagnostic.fix("open the body", brace, " {", Applicability::Unsafe),
            ),
            None => (last.end, diagnostic),
        };
    }
    let diagnostic = place
        .letters()
        .or_else(|| place.outcome())
        .or_else(|| place.unclosed())
        .or_else(|| place.text())
        .or_else(|| place.effect())
        .or_else(|| place.item_within())
        .or_else(|| place.word_before_name())
        .or_else(|| place.given_by_colon())
        .or_else(|| place.grouped_digits())
        .or_else(|| place.second_point())
        .or_else(|| place.unit())
        .or_else(|| place.modulo())
        .or_else(|| place.reserved())
        .or_else(|| place.first_word())
        .or_else(|| place.entry_word())
        .or_else(|| place.stray_close())
        .unwrap_or_else(|| place.unexpected());
    (failure.at, diagnostic)
}

/// A token that does not fit, with what stands around it.
struct Place<'a> {
    file: FileId,
    text: &'a str,
    tokens: &'a [Token],
    glance: &'a Glance<'a>,
    failure: &'a Failure,
    found: Token,
    before: Option<Token>,
    second_before: Option<Token>,
}

impl Place<'_> {
    fn span(&self) -> Span {
        self.span_of(self.found)
    }

    fn span_of(&self, token: Token) -> Span {
        Span::new(self.file, token.start, token.end)
    }

    fn found(&self) -> &str {
        self.found.of(self.text)
    }

    fn before(&self) -> &str {
        self.before.map_or("", |token| token.of(self.text))
    }

    fn expects(&self, rule: Rule) -> bool {
        self.failure.expected.contains(&rule)
    }

    fn same_line_as_before(&self) -> bool {
        self.before
            .and_then(|before| self.text.get(before.end..self.found.start))
            .is_some_and(|gap| !gap.contains('\n'))
    }

    /// The bracket that is open before the token.
    fn open(&self) -> Option<Token> {
        innermost_open(self.text, self.tokens, self.failure.start, self.found.start)
    }

    /// The message for the bracket `open`, which the token does not close.
    fn unclosed_by(&self, open: Token) -> Diagnostic {
        let open = self.span_of(open);
        unclosed(self.file, self.text, self.tokens, open, self.found.start)
    }

    /// The parenthesis that could have been closed here.
    fn open_paren(&self) -> Option<Token> {
        self.open()
            .filter(|open| open.of(self.text) == "(" && self.expects(Rule::close_paren))
    }

    /// A closing bracket without its opening one.
    fn stray_close(&self) -> Option<Diagnostic> {
        let found = self.found();
        match self.open() {
            Some(open) => {
                (found == "}" && open.of(self.text) == "(").then(|| self.unclosed_by(open))
            }
            None if matches!(found, ")" | "}") && !OPEN_ENDS.contains(&self.before()) => {
                let message = format!("this `{found}` closes nothing");
                let drop = format!("drop the `{found}`");
                Some(
                    Diagnostic::new(Code::E0103, self.span(), message)
                        .label("no bracket is open here")
                        .fix(drop, self.span(), "", Applicability::Unsafe),
                )
            }
            None => None,
        }
    }

    /// What could have stood here, as a list; within an entry, without what could begin the next one.
    fn wanted(&self) -> Option<String> {
        let inside = self.failure.at != self.failure.start || self.same_line_as_before();
        expected::listed(
            &self.failure.expected,
            inside.then_some(self.failure.strict),
        )
    }

    /// The word of the language that was expected, if the token is nearly it.
    fn misspelt(&self) -> Option<&'static str> {
        if !words::is_word(self.found) || self.respelled().is_some() {
            return None;
        }
        let near = suggest::nearest(self.found(), expected::words(&self.failure.expected))?;
        suggest::is_near(self.found(), near).then_some(near)
    }

    fn unexpected(&self) -> Diagnostic {
        let found = self.found();
        let diagnostic = match self.wanted() {
            Some(wanted) => {
                let message = format!("expected {wanted}, found `{found}`");
                let diagnostic = Diagnostic::new(Code::E0101, self.span(), message);
                let near = self.misspelt();
                if let Some(word) = near.filter(|word| wanted.contains(&format!("`{word}`"))) {
                    return self.meant(diagnostic, self.found, Some(word));
                }
                diagnostic.label(format!("expected {wanted}"))
            }
            None => {
                let message = format!("`{found}` cannot stand here");
                Diagnostic::new(Code::E0101, self.span(), message)
            }
        };
        let diagnostic = self.advised(diagnostic);
        let plain = diagnostic.help.is_empty() && diagnostic.fixes.is_empty();
        let form = plain.then(|| self.wanted().unwrap_or_default());
        let diagnostic = match form.and_then(|wanted| self.form(&wanted)) {
            Some(form) => diagnostic.help(form),
            None => diagnostic,
        };
        match self.open_paren() {
            Some(open) => diagnostic.also(self.span_of(open), "to close this one"),
            None => diagnostic,
        }
    }
}
