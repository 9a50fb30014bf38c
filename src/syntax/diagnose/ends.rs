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

/// Words after which something must come, besides those of [`OPEN_ENDS`].
const OPEN_WORDS: [&str; 10] = [
    "requires", "observe", "choose", "patience", "when", "on", "after", "while", "per", "of",
];

/// Marks after which a value must come where a line ends with them.
const OPEN_MARKS: [&str; 5] = [":", "+=", "-=", "*=", "/="];

/// The last token before byte `to`, and behind `from`, with which a line ends too early: something has to follow it, and the
/// next line is not indented further than its own, which is itself not the rest of another.
pub(in crate::syntax) fn unfinished(
    text: &str,
    tokens: &[Token],
    (from, to): (usize, usize),
) -> Option<Token> {
    let first = tokens.partition_point(|token| token.end <= from);
    let last = tokens.partition_point(|token| token.start < to);
    let is_code = |token: &&Token| token.kind != Kind::Comment;
    let line = |token: Token| {
        let before = text.get(..token.start).unwrap_or_default();
        before.rfind('\n').map_or(0, |at| at + 1)
    };
    let indented = |start: usize| {
        let line = text.get(start..).unwrap_or_default();
        line.len() - line.trim_start_matches([' ', '\t']).len()
    };
    let is_open = |token: Token| {
        let word = token.of(text);
        OPEN_ENDS.contains(&word) || OPEN_MARKS.contains(&word) || OPEN_WORDS.contains(&word)
    };
    let within = tokens.get(..=last).or(Some(tokens)).unwrap_or_default();
    let mut next: Option<Token> = None;
    for (at, &token) in within
        .iter()
        .enumerate()
        .skip(first)
        .rev()
        .filter(|(_, token)| is_code(token))
    {
        let follows = next.replace(token);
        let Some(follows) = follows.filter(|_| is_open(token)) else {
            continue;
        };
        let own = line(token);
        if line(follows) == own || follows.start > to || indented(line(follows)) > indented(own) {
            continue;
        }
        let before = tokens.get(..at).unwrap_or_default().iter().rev();
        let mut before = before
            .filter(is_code)
            .skip_while(|token| token.start >= own);
        let goes_on = |token: &Token| is_open(*token) || matches!(token.of(text), "(" | ",");
        if !before.next().is_some_and(goes_on) {
            return Some(token);
        }
    }
    None
}

/// What was to come after a `word`, and the line or the file ends.
pub(in crate::syntax) fn ends_after(at: Span, word: &str, wanted: &str, ends: &str) -> Diagnostic {
    let message = format!("expected {wanted} after `{word}`, found the end of the {ends}");
    Diagnostic::new(Code::E0101, at, message).label(format!("expected {wanted} after this"))
}

impl Place<'_> {
    /// What must come after a token with which a line ends, if something must.
    fn must_follow(&self, token: Token) -> Option<&'static str> {
        let word = token.of(self.text);
        let before = self.text.get(..token.start).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default();
        Some(match word {
            "=>" => "a node",
            ":" if line.starts_with("input ") => "a type",
            "requires" | "when" | "while" => "a condition",
            "on" => "an event",
            "observe" => "a predicate",
            "choose" => "a behaviour",
            "patience" | "after" | "per" => "a time",
            "of" => "a name",
            _ if OPEN_ENDS.contains(&word) || OPEN_MARKS.contains(&word) => "a value",
            _ => return None,
        })
    }

    /// A line before that of the token, which ends too early.
    pub(super) fn cut_before(&self) -> Option<(Token, Diagnostic)> {
        let before = self.text.get(..self.found.start)?;
        let line = before.rfind('\n')?;
        let above = self.tokens.partition_point(|token| token.start < line);
        let above = self.tokens.get(..above)?.iter().rev();
        let mut above = above.filter(|token| token.kind != Kind::Comment);
        let from = above.next()?.start.min(self.failure.start);
        let last = unfinished(self.text, self.tokens, (from, self.found.start))?;
        let follows = self.must_follow(last)?;
        let apart = self.before.is_some_and(|before| before.start != last.start);
        apart.then(|| (last, self.after(last, follows, "line")))
    }

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
        let follows = || self.must_follow(last).map(str::to_owned);
        let wanted = self.wanted().or_else(follows)?;
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
        ends_after(self.span_of(token), token.of(self.text), wanted, ends)
    }

    pub(super) fn parted(&self, left: Token, right: Token) -> bool {
        let gap = self.text.get(left.end..right.start).unwrap_or_default();
        gap.contains('\n')
    }
}
