//! What the source says between the lines: comments and blank lines.

use super::columns::{self, Align, Line, Trailing};
use super::layout::Layout;
use super::source::Source;
use crate::source::Span;
use crate::syntax::ast::{Comment, CommentKind};
use crate::syntax::comments::is_whole_line;
use std::collections::VecDeque;
use std::ops::Range;

/// The source with the comments that are still to be printed.
pub(super) struct Remarks<'a> {
    text: &'a str,
    comments: VecDeque<&'a Comment>,
    /// Up to where the source has been printed.
    printed: usize,
}

impl<'a> Remarks<'a> {
    pub(super) fn new(source: &'a Source<'a>, comments: &'a [Comment]) -> Self {
        Self {
            text: source.text,
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
        // The first line has been printed, and the last one is that of `start`.
        let lines = self.slice(self.printed, start).split('\n').skip(1);
        let mut lines = lines.map(|line| line.trim().is_empty()).peekable();
        while let Some(is_blank) = lines.next() {
            if is_blank && lines.peek().is_some() {
                return true;
            }
        }
        false
    }

    fn column(&self, at: usize) -> usize {
        columns::width(self.slice(0, at).rsplit('\n').next().unwrap_or_default())
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

impl Layout<'_> {
    /// Begins an entry that stands at `span`: the comments above it are printed, and the blank line if there is one;
    /// without a source, one if the entry stands `apart`.
    pub(super) fn leading(&mut self, span: Span, apart: bool) {
        let start = span.range().start;
        self.entry = self.lines.len();
        // What is moved above the entry goes behind the comments that stand there, but for its documentation.
        while self.whole_line_before(start) {
            let documents = |line: &Line| line.cells.iter().any(|cell| cell.starts_with("///"));
            if !self.lines.last().is_some_and(documents) {
                self.entry = self.lines.len();
            }
        }
        self.blank = match &self.remarks {
            Some(remarks) => !self.first && remarks.blank_line_before(start),
            None => apart,
        };
        self.first = false;
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
            align: Align::Comment,
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
            align: Align::Comment,
            blank_before,
            comment: None,
        };
        self.lines.insert(at, line);
        self.entry += 1;
    }

    /// Puts the comment that follows byte `end` on its line behind the last line.
    pub(super) fn trailing(&mut self, end: usize) {
        self.trailing_behind(end, |letter| letter.is_whitespace() || letter == ',');
    }

    /// Prints the comments that stand between two operands: the first behind the line of the left one, if it stands there.
    pub(super) fn between(&mut self, gap: &Range<usize>) {
        if gap.is_empty() || !self.has_comment_before(gap.end) {
            return;
        }
        self.trailing_behind(gap.start, |_| true);
        while self.whole_line_before(gap.end) {}
    }

    /// The same where other text than blanks may stand before the comment.
    fn trailing_behind(&mut self, end: usize, may_stand: impl Fn(char) -> bool) {
        let Some(remarks) = self.remarks.as_mut() else {
            return;
        };
        remarks.printed = remarks.printed.max(end);
        let Some(comment) = remarks.comments.front().copied() else {
            return;
        };
        let start = comment.span.start as usize;
        let gap = remarks.slice(end, start);
        if start < end || gap.contains('\n') || !gap.chars().all(may_stand) {
            return;
        }
        let column = remarks.column(start);
        let Some(line) = self.lines.last_mut().filter(|line| line.comment.is_none()) else {
            return;
        };
        if line.align == Align::Comment {
            return;
        }
        line.comment = Some(Trailing {
            text: spelled(comment, false),
            column,
        });
        remarks.printed = comment.span.end as usize;
        remarks.comments.pop_front();
    }

    /// Prints the comments that stand before byte `end`, where a list ends.
    pub(super) fn rest_of_list(&mut self, end: usize) {
        while self.whole_line_before(end) {}
        if let Some(remarks) = self.remarks.as_mut() {
            remarks.printed = remarks.printed.max(end);
        }
    }

    /// Whether a comment that is still to be printed stands in `span`.
    pub(super) fn has_comment(&self, span: Span) -> bool {
        self.has_comment_before(span.range().end)
    }

    fn has_comment_before(&self, end: usize) -> bool {
        let next = self
            .remarks
            .as_ref()
            .and_then(|remarks| remarks.comments.front());
        next.is_some_and(|comment| comment.span.range().start < end)
    }
}
