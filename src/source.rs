//! Source files, byte spans and line indices.

use std::fmt;

/// A file in a [`Sources`] table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(pub u32);

/// A half-open byte range of one file.
#[derive(Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The file that the offsets count in.
    pub file: FileId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The range `start..end` of `file`.
    pub fn new(file: FileId, start: usize, end: usize) -> Self {
        let clip = |offset: usize| u32::try_from(offset).unwrap_or(u32::MAX);
        Self {
            file,
            start: clip(start),
            end: clip(end),
        }
    }

    /// The smallest span that holds both; of this file if they stand in different ones.
    pub fn to(self, other: Self) -> Self {
        if self.file != other.file {
            return self;
        }
        Self {
            file: self.file,
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }

    /// The empty span just after this one.
    pub fn after(self) -> Self {
        Self {
            start: self.end,
            ..self
        }
    }

    /// The empty span just before this one.
    pub fn before(self) -> Self {
        Self {
            end: self.start,
            ..self
        }
    }

    /// The offsets as a range of bytes.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
}

impl fmt::Debug for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}..{}", self.start, self.end)
    }
}

/// One source text with the name that diagnostics show.
#[derive(Clone, Debug)]
pub struct Source {
    /// The path as the user wrote it, or a name such as `<stdin>` or `std`.
    pub name: String,
    /// The whole text.
    pub text: String,
    line_starts: Vec<u32>,
}

impl Source {
    /// A source with its line index.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        let text = text.into();
        let line_starts = std::iter::once(0)
            .chain(
                text.bytes()
                    .enumerate()
                    .filter(|&(_, byte)| byte == b'\n')
                    .map(|(at, _)| u32::try_from(at + 1).unwrap_or(u32::MAX)),
            )
            .collect();
        Self {
            name: name.into(),
            text,
            line_starts,
        }
    }

    /// The zero-based line that holds byte `offset`, and the byte at which it starts.
    pub fn line(&self, offset: u32) -> (usize, u32) {
        let line = self.line_starts.partition_point(|&start| start <= offset);
        let line = line.saturating_sub(1);
        (line, self.line_starts.get(line).copied().unwrap_or(0))
    }

    /// Zero-based line and column of byte `offset`; the column counts characters.
    pub fn position(&self, offset: u32) -> (usize, usize) {
        let (line, start) = self.line(offset);
        let column = self.slice(start, offset).chars().count();
        (line, column)
    }

    /// Zero-based line and column of byte `offset`; the column counts UTF-16 code units.
    pub fn position_utf16(&self, offset: u32) -> (usize, usize) {
        let (line, start) = self.line(offset);
        let column = self.slice(start, offset).encode_utf16().count();
        (line, column)
    }

    /// The byte at a zero-based line and a column in UTF-16 code units. What lies beyond the end of a line or of the text is
    /// its end; what lies within a character is its start.
    pub fn offset_utf16(&self, line: usize, column: usize) -> u32 {
        let Some(start) = self.line_start(line) else {
            return u32::try_from(self.text.len()).unwrap_or(u32::MAX);
        };
        let rest = self.text.get(start as usize..).unwrap_or_default();
        let line = rest.split('\n').next().unwrap_or_default();
        let line = line.strip_suffix('\r').unwrap_or(line);
        let mut units = 0;
        let mut bytes = 0;
        for letter in line.chars() {
            units += letter.len_utf16();
            if units > column {
                break;
            }
            bytes += letter.len_utf8();
        }
        start.saturating_add(u32::try_from(bytes).unwrap_or(u32::MAX))
    }

    /// How many lines the text has; a last line without a newline counts.
    pub fn line_count(&self) -> usize {
        self.line_starts.len()
    }

    /// The byte at which the zero-based `line` starts.
    pub fn line_start(&self, line: usize) -> Option<u32> {
        self.line_starts.get(line).copied()
    }

    fn slice(&self, start: u32, end: u32) -> &str {
        self.text
            .get(start as usize..end as usize)
            .unwrap_or_default()
    }
}

/// All the files of one program.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    files: Vec<Source>,
}

impl Sources {
    /// Adds a file.
    pub fn add(&mut self, source: Source) -> FileId {
        let id = FileId(u32::try_from(self.files.len()).unwrap_or(u32::MAX));
        self.files.push(source);
        id
    }

    /// The file of that id.
    pub fn get(&self, id: FileId) -> Option<&Source> {
        self.files.get(id.0 as usize)
    }

    /// The text under a span; empty if the span is not of this table.
    pub fn text(&self, span: Span) -> &str {
        self.get(span.file)
            .and_then(|source| source.text.get(span.range()))
            .unwrap_or_default()
    }

    /// The files with their ids, in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = (FileId, &Source)> {
        (0..).map(FileId).zip(&self.files)
    }
}
