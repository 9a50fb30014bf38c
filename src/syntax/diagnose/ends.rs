//! Lines and files that end too early.

use super::{Failure, Place};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::{FileId, Span};
use crate::syntax::brackets::{innermost_open, unclosed};
use crate::syntax::expected;
use crate::syntax::tokens::{Kind, Token};

/// Tokens after which a value must come.
const OPEN_ENDS: [&str; 17] = [
    "=", "+", "-", "*", "/", "^", "->", "=>", "==", "!=", "<", ">", "<=", ">=", "and", "or", "not",
];

/// The message for a file that ends where something must come, after the token `last`.
pub(super) fn at_the_end(
    file: FileId,
    text: &str,
    tokens: &[Token],
    failure: &Failure,
    last: Option<Token>,
) -> Diagnostic {
    let end = text.len();
    if let Some(open) = innermost_open(text, tokens, failure.start, end) {
        let open = Span::new(file, open.start, open.end);
        return unclosed(file, text, tokens, open, end);
    }
    let end = last.map_or(end, |token| token.end);
    let place = Span::new(file, end, end);
    match expected::listed(&failure.expected, Some(failure.strict)) {
        Some(wanted) => {
            let message = format!("expected {wanted}, found the end of the file");
            Diagnostic::new(Code::E0101, place, message).label(format!("expected {wanted}"))
        }
        None => Diagnostic::new(Code::E0101, place, "the file ends too early"),
    }
}

impl Place<'_> {
    /// A line that ends too early: the message belongs to its last token, not to what happens to stand on the next
    /// line.
    pub(super) fn cut_line(&self) -> Option<(Token, Diagnostic)> {
        let last = self.before?;
        if last.end <= self.failure.start || !self.parted(last, self.found) {
            return None;
        }
        if let Some(open) = self.open_paren() {
            return Some((last, self.unclosed_by(open)));
        }
        if let Some(diagnostic) = self.cut_form() {
            return Some((last, diagnostic));
        }
        let wanted = self.wanted()?;
        let diagnostic = self.after(last, &wanted);
        Some(match self.form(&wanted) {
            Some(form) => (last, diagnostic.help(form)),
            None => (last, diagnostic),
        })
    }

    /// A line that ends where a value must come, so that the first word of the next entry was read as that value.
    pub(super) fn cut_value(&self) -> Option<(Token, Diagnostic)> {
        let (last, word) = (self.second_before?, self.before?);
        let begins_entry = matches!(self.found(), "=" | ":") && word.kind == Kind::Word;
        let is_cut = OPEN_ENDS.contains(&last.of(self.text)) && self.parted(last, word);
        (begins_entry && is_cut).then(|| (last, self.after(last, "a value")))
    }

    fn after(&self, token: Token, wanted: &str) -> Diagnostic {
        let message = format!(
            "expected {wanted} after `{}`, found the end of the line",
            token.of(self.text)
        );
        Diagnostic::new(Code::E0101, self.span_of(token), message)
            .label(format!("expected {wanted} after this"))
    }

    pub(super) fn parted(&self, left: Token, right: Token) -> bool {
        let gap = self.text.get(left.end..right.start).unwrap_or_default();
        gap.contains('\n')
    }
}
