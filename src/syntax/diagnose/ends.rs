//! Lines and files that end too early.

use super::Place;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::expected;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, Token};

/// Tokens after which a value must come.
pub(super) const OPEN_ENDS: [&str; 17] = [
    "=", "+", "-", "*", "/", "^", "->", "=>", "==", "!=", "<", ">", "<=", ">=", "and", "or", "not",
];

impl Place<'_> {
    /// The message for a file that ends where something must come; `found` is its end.
    pub(super) fn at_the_end(&self) -> Diagnostic {
        let end = self.found.start;
        if let Some(open) = self.open() {
            return self.unclosed_by(open);
        }
        let end = Span::new(self.file, end, end);
        let wanted = expected::listed(&self.failure.expected, Some(self.failure.strict));
        let (Some(wanted), Some(last)) = (wanted, self.before) else {
            return Diagnostic::new(Code::E0101, end, "the file ends too early");
        };
        let diagnostic = self.after(last, &wanted, "file");
        match self.form(&wanted) {
            Some(form) => diagnostic.help(form),
            None => diagnostic,
        }
    }

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
        let diagnostic = self.after(last, &wanted, "line");
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
        (begins_entry && is_cut).then(|| (last, self.after(last, "a value", "line")))
    }

    /// Where the body of a `let` ends whose `=`, the `last` token of its line, lacks the `{`: at a `}` in the margin,
    /// before which all lines are indented. With the place of the brace.
    pub(super) fn unopened_body(&self, last: Token) -> Option<(usize, Span)> {
        let begins = self.begins_with("let") && self.failure.strict == Rule::strict_item;
        if !begins || last.of(self.text) != "=" {
            return None;
        }
        let rest = self.text.get(last.end..)?;
        let (_, body) = rest.split_once('\n')?;
        let within = |line: &&str| line.trim().is_empty() || line.starts_with([' ', '\t']);
        let lines = body.split_inclusive('\n').take_while(within);
        let end = self.text.len() - body.len() + lines.map(str::len).sum::<usize>();
        let closes = self.text.get(end..)?.starts_with('}');
        let place = self.span_of(last).after();
        closes.then_some((end, place))
    }

    /// What was to come after a token, and the line or the file ends.
    pub(super) fn after(&self, token: Token, wanted: &str, ends: &str) -> Diagnostic {
        let message = format!(
            "expected {wanted} after `{}`, found the end of the {ends}",
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
