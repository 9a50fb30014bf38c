//! Comma-separated text as records of cells, each with its place (RFC 4180).

use super::error::{TableError, TableErrorKind};
use std::borrow::Cow;
use std::ops::Range;

/// The byte-order mark that some programs write before a text.
const MARK: &[u8] = b"\xef\xbb\xbf";

/// The first byte of the character that a byte belongs to.
pub(in crate::policy) fn character(text: &[u8], at: usize) -> usize {
    let continues = |at: &usize| text.get(*at).is_some_and(|byte| byte & 0xc0 == 0x80);
    (0..=at).rev().find(|at| !continues(at)).unwrap_or(0)
}

/// Reads the records of a text one by one.
pub(super) struct Records<'t> {
    text: &'t [u8],
    at: usize,
}

impl<'t> Records<'t> {
    pub(super) fn new(text: &'t [u8]) -> Self {
        Self {
            text,
            at: start(text),
        }
    }

    /// The record, or the rest of one, that starts at a byte, and those behind it.
    pub(super) fn starting_at(text: &'t [u8], at: usize) -> Self {
        Self { text, at }
    }

    /// Puts the places of the next record's cells, quotes included, into `cells`; false at the end. Blank lines are no
    /// records.
    ///
    /// # Errors
    /// A quote that is never closed, or one that is closed within a cell. Nothing can be read behind it.
    pub(super) fn next(&mut self, cells: &mut Vec<Range<usize>>) -> Result<bool, TableError> {
        self.skip_blank_lines();
        if self.at >= self.text.len() {
            return Ok(false);
        }
        self.rest(cells).map(|()| true)
    }

    /// Puts the places of the cells up to the end of the line into `cells`.
    ///
    /// # Errors
    /// As [`Records::next`].
    pub(super) fn rest(&mut self, cells: &mut Vec<Range<usize>>) -> Result<(), TableError> {
        cells.clear();
        loop {
            let start = self.at;
            if self.text.get(start) == Some(&b'"') {
                self.quoted(start)?;
            } else {
                let rest = self.text.get(start..).unwrap_or_default();
                let length = rest.iter().position(|b| matches!(b, b',' | b'\n' | b'\r'));
                self.at = start + length.unwrap_or(rest.len());
            }
            cells.push(start..self.at);
            match self.text.get(self.at) {
                Some(b',') => self.at += 1,
                _ => return Ok(()),
            }
        }
    }

    /// Where the next record starts; the end of the text if none does.
    pub(super) fn next_start(&mut self) -> usize {
        self.skip_blank_lines();
        self.at
    }

    fn skip_blank_lines(&mut self) {
        while let Some(first) = self.text.get(self.at)
            && matches!(first, b'\r' | b'\n' | b' ' | b'\t')
        {
            let rest = self.text.get(self.at..).unwrap_or_default();
            let blank = rest.iter().position(|b| !matches!(b, b' ' | b'\t'));
            match blank.and_then(|length| rest.get(length).map(|byte| (length, byte))) {
                Some((length, b'\r' | b'\n')) => self.at += length + 1,
                Some(_) => return,
                None => self.at = self.text.len(),
            }
        }
    }

    /// Goes behind the cell whose quote stands at `start`.
    fn quoted(&mut self, start: usize) -> Result<(), TableError> {
        self.at = start + 1;
        loop {
            let rest = self.text.get(self.at..).unwrap_or_default();
            let Some(length) = rest.iter().position(|b| *b == b'"') else {
                return Err(self.malformed(start, "the quote is never closed"));
            };
            self.at += length + 1;
            match self.text.get(self.at) {
                Some(b'"') => self.at += 1,
                None | Some(b',' | b'\n' | b'\r') => return Ok(()),
                Some(_) => return Err(self.malformed(start, "text follows the closing quote")),
            }
        }
    }

    /// What is wrong with the line on which a cell starts.
    fn malformed(&self, start: usize, why: &str) -> TableError {
        let rest = self.text.get(start..).unwrap_or_default();
        let end = rest.iter().position(|b| matches!(b, b'\n' | b'\r'));
        TableError {
            span: start..start + end.unwrap_or(rest.len()),
            kind: TableErrorKind::Malformed(why.to_owned()),
        }
    }
}

/// What begins a remark about a table. Remarks are lines above its header.
pub(super) const REMARK: &str = "## ";

/// Where a text begins, behind its byte-order mark and its remarks.
pub(super) fn start(text: &[u8]) -> usize {
    let mut at = match text.starts_with(MARK) {
        true => MARK.len(),
        false => 0,
    };
    while let Some(rest) = text
        .get(at..)
        .filter(|rest| rest.starts_with(REMARK.as_bytes()))
    {
        let end = rest.iter().position(|byte| *byte == b'\n');
        at += end.map_or(rest.len(), |end| end + 1);
    }
    at
}

/// What a cell says, without the blanks around it and without its quotes.
pub(super) fn value<'t>(text: &'t [u8], cell: &Range<usize>) -> Cow<'t, [u8]> {
    let raw = text.get(cell.clone()).unwrap_or_default();
    match raw.strip_prefix(b"\"").and_then(|r| r.strip_suffix(b"\"")) {
        None => Cow::Borrowed(raw.trim_ascii()),
        Some(inside) if !inside.contains(&b'"') => Cow::Borrowed(inside.trim_ascii()),
        Some(inside) => {
            let mut quotes = 0;
            let kept = inside.iter().copied().filter(|byte| {
                quotes += usize::from(*byte == b'"');
                *byte != b'"' || quotes % 2 == 1
            });
            Cow::Owned(kept.collect::<Vec<u8>>().trim_ascii().to_owned())
        }
    }
}

/// The place of a whole record.
pub(super) fn whole(cells: &[Range<usize>]) -> Range<usize> {
    let start = cells.first().map_or(0, |cell| cell.start);
    start..cells.last().map_or(start, |cell| cell.end)
}
