//! Documents broken into lines.

use super::WIDTH;
use super::columns::{self, Align, Line};
use super::doc::{Break, Doc, Entry, List, Part};
use super::remarks::Remarks;
use super::source::Source;
use crate::syntax::ast::Comment;

/// The lines that are laid out so far, and the one that is being written.
pub(super) struct Layout<'s> {
    pub(super) lines: Vec<Line>,
    /// How many lines of code have been ended.
    ended: usize,
    /// The columns of the present line.
    cells: Vec<String>,
    /// How many characters the present line has behind its indentation, were it not aligned.
    filled: usize,
    /// The level at which the next line begins.
    pub(super) indent: usize,
    /// The level at which the present line has begun.
    pub(super) begun: Option<usize>,
    /// Whether a blank line goes before the present one.
    pub(super) blank: bool,
    /// Whether the next entry is the first of its list.
    pub(super) first: bool,
    /// The line above which a comment goes that has no place in the present entry.
    pub(super) entry: usize,
    pub(super) remarks: Option<Remarks<'s>>,
}

impl<'s> Layout<'s> {
    /// Nothing yet, of a tree that was parsed from `source`.
    pub(super) fn new(source: Option<&'s Source<'s>>, comments: &'s [Comment]) -> Self {
        Self {
            lines: Vec::new(),
            ended: 0,
            cells: vec![String::new()],
            filled: 0,
            indent: 0,
            begun: None,
            blank: false,
            first: true,
            entry: 0,
            remarks: source.map(|source| Remarks::new(source, comments)),
        }
    }

    /// The text of a whole file.
    pub(super) fn text(mut self, items: &[Entry<'_>]) -> String {
        for item in items {
            self.entry(item, "");
        }
        self.rest_of_list(usize::MAX);
        columns::text(&self.lines)
    }

    /// Lays out a document that `after` more characters follow on its last line.
    fn put(&mut self, doc: &Doc<'_>, after: usize) {
        match &doc.part {
            Part::Text(text) => self.write(text, doc.width),
            Part::Row(parts) => self.row(parts, after),
            Part::Column(_) => {
                self.cells.push(String::new());
                self.filled += 1;
            }
            Part::Line(gap) => {
                self.end_line(Align::None);
                self.between(gap);
            }
            Part::Nest(inner) => {
                self.indent += 1;
                self.put(inner, after);
                self.indent -= 1;
            }
            Part::Group(inner, span, broken) => {
                let fits = match broken {
                    Break::Always => false,
                    Break::TooLong => self.column() + doc.width + after <= WIDTH,
                    Break::Never => true,
                };
                if fits && !self.has_comment(*span) {
                    self.put_flat(inner);
                } else {
                    self.put(inner, after);
                }
            }
            Part::Flat(inner) => self.put_flat(inner),
            Part::Room(width, inner) => self.put(inner, *width),
            Part::List(list) => self.list(list),
            Part::Settle(end, inner) => {
                self.hoist_unless(*end, |at| inner.has_place(at));
                self.put(inner, after);
            }
            Part::Hoist(end) => self.hoist(*end),
        }
    }

    /// Parts behind each other. A part that nothing but text follows is broken if that text does not fit, too.
    fn row(&mut self, parts: &[Doc<'_>], after: usize) {
        let is_text = |part: &&Doc<'_>| matches!(part.part, Part::Text(_));
        let texts = parts.iter().rev().take_while(is_text).count();
        let (parts, texts) = parts.split_at(parts.len() - texts);
        if let Some((last, parts)) = parts.split_last() {
            parts.iter().for_each(|part| self.put(part, 0));
            let behind: usize = texts.iter().map(|text| text.width).sum();
            self.put(last, behind + after);
        }
        texts.iter().for_each(|text| self.put(text, 0));
    }

    fn put_flat(&mut self, doc: &Doc<'_>) {
        self.begun.get_or_insert(self.indent);
        doc.write(&mut self.cells, false);
        self.filled += doc.width;
    }

    /// The entries of a list, one a line.
    fn list(&mut self, list: &List<'_>) {
        let brackets = list.brackets;
        let range = list.span.range();
        self.write(brackets.open, brackets.open.len());
        self.end_line(Align::None);
        // A comment behind a parenthesis goes with the first argument.
        if brackets.open != "(" {
            self.trailing(range.start + brackets.open.len());
        }
        self.indent += 1;
        self.first = true;
        for entry in &list.entries {
            self.entry(entry, brackets.comma);
        }
        self.rest_of_list(range.end.saturating_sub(brackets.close.len()));
        self.indent -= 1;
        self.first = false;
        if !brackets.close.is_empty() {
            self.write(brackets.close, brackets.close.len());
        }
    }

    /// An entry between the comments above it and the one behind it.
    fn entry(&mut self, entry: &Entry<'_>, comma: &str) {
        let outer = self.entry;
        self.leading(entry.span, entry.apart);
        if self.remarks.is_none() {
            for doc in entry.docs {
                let blank = if doc.is_empty() { "" } else { " " };
                self.write(&format!("///{blank}{doc}"), 0);
                self.end_line(Align::Comment);
            }
        }
        let before = self.ended;
        self.put(&entry.doc, comma.len());
        if self.begun.is_some() {
            self.write(comma, comma.len());
            let is_line = self.ended == before;
            self.end_line(if is_line {
                entry.align.clone()
            } else {
                Align::None
            });
        }
        let end = entry.span.range().end;
        self.hoist(end);
        self.trailing(end);
        self.entry = outer;
    }

    /// The column at which the line stands, were it not aligned.
    fn column(&self) -> usize {
        4 * self.begun.unwrap_or(self.indent) + self.filled
    }

    fn write(&mut self, text: &str, width: usize) {
        self.begun.get_or_insert(self.indent);
        self.filled += width;
        if let Some(cell) = self.cells.last_mut() {
            cell.push_str(text);
        }
    }

    fn end_line(&mut self, align: Align) {
        self.ended += 1;
        self.filled = 0;
        let cells = std::mem::replace(&mut self.cells, vec![String::new()]);
        self.lines.push(Line {
            indent: self.begun.take().unwrap_or(self.indent),
            cells,
            align,
            blank_before: std::mem::take(&mut self.blank),
            comment: None,
        });
    }
}
