//! What the source says of its places: tokens and line breaks.

use crate::source::Span;
use crate::syntax::tokens::{Kind, Token, tokens};

/// The text that a tree was parsed from.
pub(super) struct Source<'s> {
    pub(super) text: &'s str,
    tokens: Vec<Token>,
    /// The places of its newlines.
    newlines: Vec<usize>,
}

impl<'s> Source<'s> {
    pub(super) fn new(text: &'s str) -> Self {
        Self {
            text,
            tokens: tokens(text),
            newlines: text.match_indices('\n').map(|(at, _)| at).collect(),
        }
    }

    /// Whether its first line ends with a carriage return before the newline.
    pub(super) fn ends_in_carriage_returns(&self) -> bool {
        let first = self.newlines.first().copied().unwrap_or(0);
        self.text
            .get(..first)
            .is_some_and(|line| line.ends_with('\r'))
    }

    /// Whether `span` goes over several lines.
    pub(super) fn is_broken(&self, span: Span) -> bool {
        let next = self.newlines.partition_point(|&at| at < span.range().start);
        self.newlines
            .get(next)
            .is_some_and(|&at| at < span.range().end)
    }

    /// The place of the first brace at or after byte `at`.
    pub(super) fn brace_after(&self, at: usize) -> usize {
        let first = self.tokens.partition_point(|token| token.end <= at);
        let mut after = self.tokens.get(first..).unwrap_or_default().iter();
        after
            .find(|token| token.kind == Kind::Mark && token.of(self.text) == "{")
            .map_or(at, |token| token.start)
    }

    /// From the last `word` before `span` to its end.
    pub(super) fn word_before(&self, word: &str, span: Span) -> Span {
        let first = self
            .tokens
            .partition_point(|token| token.start < span.range().start);
        let mut before = self.tokens.get(..first).unwrap_or_default().iter().rev();
        before
            .find(|token| token.of(self.text) == word)
            .map_or(span, |token| {
                Span::new(span.file, token.start, span.range().end)
            })
    }
}
