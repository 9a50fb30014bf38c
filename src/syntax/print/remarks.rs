//! What the source says between the lines: comments and blank lines.

use super::Printer;
use super::columns::{Group, Line, Trailing};
use crate::source::Span;
use crate::syntax::ast::{Comment, CommentKind};
use crate::syntax::comments::is_whole_line;
use crate::syntax::tokens::{Kind, Token, tokens};
use std::collections::VecDeque;

/// The source with the comments that are still to be printed.
pub(super) struct Remarks<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    comments: VecDeque<&'a Comment>,
    /// Up to where the source has been printed.
    printed: usize,
}

impl<'a> Remarks<'a> {
    pub(super) fn new(text: &'a str, comments: &'a [Comment]) -> Self {
        Self {
            text,
            tokens: tokens(text),
            comments: comments.iter().collect(),
            printed: 0,
        }
    }

    /// The next comment if it stands before byte `end`.
    fn take_before(&mut self, end: usize) -> Option<&'a Comment> {
        let next = self.comments.front()?;
        if (next.span.start as usize) < end {
            self.comments.pop_front()
        } else {
            None
        }
    }

    fn slice(&self, start: usize, end: usize) -> &'a str {
        self.text.get(start..end).unwrap_or_default()
    }

    /// Whether a blank line stands between what is printed and byte `start`.
    fn blank_line_before(&self, start: usize) -> bool {
        let gap = self.slice(self.printed, start);
        gap.split('\n').count() > 2
            && gap.split('\n').skip(1).any(|line| line.trim().is_empty())
            && {
                let lines: Vec<&str> = gap.split('\n').collect();
                let inner = lines.get(1..lines.len() - 1).unwrap_or_default();
                inner.iter().any(|line| line.trim().is_empty())
            }
    }

    fn column(&self, at: usize) -> usize {
        let line = self.slice(0, at).rsplit('\n').next().unwrap_or_default();
        line.chars()
            .map(|letter| if letter == '\t' { 4 } else { 1 })
            .sum()
    }
}

/// A comment as it is printed.
fn spelled(comment: &Comment, plain: bool) -> String {
    let slashes = match comment.kind {
        _ if plain => "//",
        CommentKind::Plain => "//",
        CommentKind::Item => "///",
        CommentKind::File => "//!",
    };
    let slashed = plain && comment.text.starts_with(['/', '!']);
    format!(
        "{slashes}{}{}",
        if slashed { " " } else { "" },
        comment.text
    )
}

impl Printer<'_> {
    /// Begins an entry that stands at `span`: the comments above it are printed, and the blank line if there is one.
    fn leading(&mut self, span: Span) {
        let start = span.range().start;
        self.entry = self.lines.len();
        while self.whole_line_before(start) {}
        let Some(remarks) = self.remarks.as_ref() else {
            return;
        };
        self.blank = !self.first && remarks.blank_line_before(start);
        self.first = false;
    }

    /// Prints an entry between the comments above it and the one behind it.
    pub(super) fn entry(&mut self, span: Span, print: impl FnOnce(&mut Self)) {
        let outer = self.entry;
        self.leading(span);
        print(self);
        self.hoist(span.range().end);
        self.trailing(span.range().end);
        self.entry = outer;
    }

    /// Prints the next comment if it stands before byte `end`, on a line of its own.
    fn whole_line_before(&mut self, end: usize) -> bool {
        let Some(remarks) = self.remarks.as_mut() else {
            return false;
        };
        let Some(comment) = remarks.take_before(end) else {
            return false;
        };
        let start = comment.span.start as usize;
        let blank_before = !self.first && remarks.blank_line_before(start);
        remarks.printed = comment.span.end as usize;
        self.first = false;
        // Behind code it documents nothing, and must not begin to.
        let plain = comment.kind == CommentKind::Item && !is_whole_line(remarks.text, comment);
        self.lines.push(Line {
            indent: self.indent,
            cells: vec![spelled(comment, plain)],
            group: Group::Comment,
            blank_before,
            comment: None,
        });
        true
    }

    /// Moves the comments that stand before byte `end` above the present entry: there is no place for them in it.
    pub(super) fn hoist(&mut self, end: usize) {
        self.hoist_unless(end, |_| false);
        if let Some(remarks) = self.remarks.as_mut() {
            remarks.printed = remarks.printed.max(end);
        }
    }

    /// Moves those of the comments before byte `end` above the present entry that have no place of their own in it.
    pub(super) fn hoist_unless(&mut self, end: usize, has_place: impl Fn(usize) -> bool) {
        let mut index = 0;
        while let Some(remarks) = self.remarks.as_mut() {
            let Some(comment) = remarks.comments.get(index).copied() else {
                return;
            };
            let start = comment.span.start as usize;
            if start >= end {
                return;
            }
            if has_place(start) {
                index += 1;
            } else {
                remarks.comments.remove(index);
                self.put_above(comment);
            }
        }
    }

    fn put_above(&mut self, comment: &Comment) {
        let at = self.entry.min(self.lines.len());
        let written = self.begun.unwrap_or(self.indent);
        let (indent, blank_before) = match self.lines.get_mut(at) {
            Some(line) => (line.indent, std::mem::take(&mut line.blank_before)),
            None => (written, std::mem::take(&mut self.blank)),
        };
        let line = Line {
            indent,
            cells: vec![spelled(comment, true)],
            group: Group::Comment,
            blank_before,
            comment: None,
        };
        self.lines.insert(at, line);
        self.entry += 1;
    }

    /// Puts the comment that follows byte `end` on its line behind the last line.
    pub(super) fn trailing(&mut self, end: usize) {
        let Some(remarks) = self.remarks.as_mut() else {
            return;
        };
        remarks.printed = remarks.printed.max(end);
        let Some(comment) = remarks.comments.front().copied() else {
            return;
        };
        let start = comment.span.start as usize;
        let gap = remarks.slice(end, start);
        if start < end
            || gap.contains('\n')
            || !gap
                .chars()
                .all(|letter| letter.is_whitespace() || letter == ',')
        {
            return;
        }
        let column = remarks.column(start);
        let Some(line) = self.lines.last_mut().filter(|line| line.comment.is_none()) else {
            return;
        };
        if line.group == Group::Comment {
            return;
        }
        line.comment = Some(Trailing {
            text: spelled(comment, false),
            column,
        });
        remarks.printed = comment.span.end as usize;
        remarks.comments.pop_front();
    }

    /// Prints the comments that stand before the end of a block.
    pub(super) fn rest_of_block(&mut self, end: usize) {
        while self.whole_line_before(end) {}
        if let Some(remarks) = self.remarks.as_mut() {
            remarks.printed = remarks.printed.max(end);
        }
    }

    /// Prints the comments that stand at the end of the file.
    pub(super) fn rest_of_file(&mut self) {
        self.rest_of_block(usize::MAX);
    }

    /// Whether a comment that is still to be printed stands in `span`.
    pub(super) fn has_comment(&self, span: Span) -> bool {
        let next = self
            .remarks
            .as_ref()
            .and_then(|remarks| remarks.comments.front());
        next.is_some_and(|comment| comment.span.start < span.end)
    }

    /// Whether `span` goes over several lines in the source; nothing if there is no source.
    pub(super) fn is_written_broken(&self, span: Span) -> Option<bool> {
        let remarks = self.remarks.as_ref()?;
        Some(
            remarks
                .slice(span.range().start, span.range().end)
                .contains('\n'),
        )
    }

    /// The end of the first token `spelling` at or after byte `at`.
    pub(super) fn mark_after(&self, spelling: &str, at: usize) -> usize {
        let Some(remarks) = self.remarks.as_ref() else {
            return 0;
        };
        let first = remarks.tokens.partition_point(|token| token.end <= at);
        remarks
            .tokens
            .get(first..)
            .unwrap_or_default()
            .iter()
            .find(|token| token.kind == Kind::Mark && token.of(remarks.text) == spelling)
            .map_or(at, |token| token.end)
    }

    /// From the last `word` before `span` to its end.
    pub(super) fn word_before(&self, word: &str, span: Span) -> Span {
        let Some(remarks) = self.remarks.as_ref() else {
            return span;
        };
        let first = remarks
            .tokens
            .partition_point(|token| token.start < span.range().start);
        let tokens = remarks.tokens.get(..first).unwrap_or_default();
        let found = tokens
            .iter()
            .rev()
            .find(|token| token.of(remarks.text) == word);
        found.map_or(span, |token| {
            Span::new(span.file, token.start, span.range().end)
        })
    }
}
