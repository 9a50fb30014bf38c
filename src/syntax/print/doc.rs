//! Documents: text that knows how it stands on one line, and where it may be broken.
//!
//! Each construct of the language is written once, as a document, and its forms on one line and on several are two
//! readings of it. The algebra is Wadler's ("A prettier printer", 2003): text, a line that may break, nesting and
//! groups, here with the columns that adjacent lines share and with lists whose entries carry comments and blank lines.
//! These two are most of what the formatter does, and crates such as `pretty` know neither; hence our own.
//!
//! A document sums up its width on one line as it is built. So the layout decides each group in constant time and
//! writes each part once: printing takes time linear in the length of the text.

use super::columns::Align;
use crate::source::Span;
use std::borrow::Cow;
use std::ops::Range;

/// A document.
pub(super) struct Doc<'a> {
    pub(super) part: Part<'a>,
    /// Its width on one line, in characters.
    pub(super) width: usize,
    /// Whether it holds a choice that stays on several lines.
    pub(super) tall: bool,
}

/// What a document is made of.
pub(super) enum Part<'a> {
    Text(Cow<'a, str>),
    /// One behind the other.
    Row(Vec<Doc<'a>>),
    /// The next column of the line; in a list on one line, this text.
    Column(&'static str),
    /// A blank, or the end of the line where the group around it is broken; with the bytes of the source, if it has any,
    /// whose comments stay there.
    Line(Range<usize>),
    /// One level deeper.
    Nest(Box<Doc<'a>>),
    /// On one line or on several; where it stands in the source, and when it is broken.
    Group(Box<Doc<'a>>, Span, Break),
    /// On one line, however long.
    Flat(Box<Doc<'a>>),
    /// With this many characters kept free behind it on its last line.
    Room(usize, Box<Doc<'a>>),
    List(List<'a>),
    /// The comments before this byte that have no place in the document move above the entry around it.
    Settle(usize, Box<Doc<'a>>),
    /// The comments before this byte move above the entry around it.
    Hoist(usize),
}

/// When a group is broken. While a comment is left in its place in the source, it is so in any case.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Break {
    /// However short it is.
    Always,
    /// If it does not fit on the line.
    TooLong,
    /// However long it is, only by comments.
    Never,
}

impl Break {
    /// Always if `broken`, and else if it must be.
    pub(super) fn always_if(broken: bool) -> Self {
        if broken { Self::Always } else { Self::TooLong }
    }
}

/// Entries between brackets: on one line, or one a line.
pub(super) struct List<'a> {
    pub(super) brackets: Brackets,
    /// From bracket to bracket; that of arguments begins with the name of the call.
    pub(super) span: Span,
    pub(super) entries: Vec<Entry<'a>>,
    /// Whether each entry has a column of its own on one line.
    pub(super) columns: bool,
}

/// The marks around the entries of a list, and behind each.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) struct Brackets {
    pub(super) open: &'static str,
    pub(super) close: &'static str,
    /// What stands inside the brackets on one line.
    pub(super) pad: &'static str,
    /// What stands between entries on one line, and behind each on several.
    pub(super) comma: &'static str,
    /// What follows a comma on one line. Between statements the line ends even there: without that, a unit or a
    /// parenthesis could be read as more of the value before it.
    pub(super) gap: &'static str,
}

impl Brackets {
    /// `(a, b)`
    pub(super) const PARENS: Self = Self {
        open: "(",
        close: ")",
        pad: "",
        comma: ",",
        gap: " ",
    };
    /// `{ a, b }`
    pub(super) const BRACES: Self = Self {
        open: "{",
        close: "}",
        pad: " ",
        comma: ",",
        gap: " ",
    };
    /// `{a, b}`
    pub(super) const VALUES: Self = Self {
        open: "{",
        close: "}",
        pad: "",
        comma: ",",
        gap: " ",
    };
    /// `{ a b }`
    pub(super) const BLOCK: Self = Self {
        open: "{",
        close: "}",
        pad: " ",
        comma: "",
        gap: "\n",
    };
    /// `a, b`
    pub(super) const NONE: Self = Self {
        open: "",
        close: "",
        pad: "",
        comma: ",",
        gap: " ",
    };
}

/// What stands on lines of its own, between the comments above it and the one behind it.
pub(super) struct Entry<'a> {
    pub(super) span: Span,
    /// Its documentation, printed where there is no source whose comments hold it.
    pub(super) docs: &'a [String],
    /// Whether a blank line goes before it where there is no source.
    pub(super) apart: bool,
    /// How it is aligned with its neighbours if it stands on one line.
    pub(super) align: Align,
    pub(super) doc: Doc<'a>,
}

impl<'a> Entry<'a> {
    /// An entry that is not aligned with its neighbours.
    pub(super) fn new(span: Span, doc: Doc<'a>) -> Self {
        Self::aligned(span, Align::None, doc)
    }

    /// An entry that shares its columns with its neighbours.
    pub(super) fn aligned(span: Span, align: Align, doc: Doc<'a>) -> Self {
        Self {
            span,
            docs: &[],
            apart: false,
            align,
            doc,
        }
    }

    /// The entry with its documentation.
    pub(super) fn documented(self, docs: &'a [String]) -> Self {
        Self { docs, ..self }
    }
}

/// Documents, one behind the other.
macro_rules! row {
    ($($part:expr),* $(,)?) => {
        $crate::syntax::print::doc::Doc::row(vec![$($crate::syntax::print::doc::Doc::from($part)),*])
    };
}
pub(super) use row;

impl<'a, T: Into<Cow<'a, str>>> From<T> for Doc<'a> {
    fn from(text: T) -> Self {
        let text = text.into();
        let width = text.chars().count();
        Self::leaf(Part::Text(text), width)
    }
}

impl<'a> Doc<'a> {
    fn leaf(part: Part<'a>, width: usize) -> Self {
        Self {
            part,
            width,
            tall: false,
        }
    }

    fn around(self, part: impl FnOnce(Box<Self>) -> Part<'a>) -> Self {
        let (width, tall) = (self.width, self.tall);
        Self {
            part: part(Box::new(self)),
            width,
            tall,
        }
    }

    /// Nothing.
    pub(super) fn nothing() -> Self {
        Self::row(Vec::new())
    }

    /// Documents, one behind the other.
    pub(super) fn row(parts: Vec<Self>) -> Self {
        Self {
            width: parts.iter().map(|part| part.width).sum(),
            tall: parts.iter().any(|part| part.tall),
            part: Part::Row(parts),
        }
    }

    /// The next column.
    pub(super) fn column() -> Self {
        Self::leaf(Part::Column(" "), 1)
    }

    /// A column that stays empty.
    pub(super) fn empty_column() -> Self {
        Self::leaf(Part::Column(""), 0)
    }

    /// A place where a broken group ends its line, with the comments that stand in a part of the source.
    pub(super) fn line_in(gap: Range<usize>) -> Self {
        Self::leaf(Part::Line(gap), 1)
    }

    /// Moves the comments before byte `at` above the entry.
    pub(super) fn hoist(at: usize) -> Self {
        Self::leaf(Part::Hoist(at), 0)
    }

    /// Entries between brackets.
    pub(super) fn list(brackets: Brackets, span: Span, entries: Vec<Entry<'a>>) -> Self {
        let Brackets {
            open,
            close,
            pad,
            comma,
            gap,
        } = brackets;
        let mut width = open.len() + close.len();
        if !entries.is_empty() {
            width += 2 * pad.len() + (entries.len() - 1) * (comma.len() + gap.len());
        }
        Self {
            width: width + entries.iter().map(|entry| entry.doc.width).sum::<usize>(),
            tall: entries.iter().any(|entry| entry.doc.tall),
            part: Part::List(List {
                brackets,
                span,
                entries,
                columns: false,
            }),
        }
    }

    /// The document one level deeper.
    pub(super) fn nested(self) -> Self {
        self.around(Part::Nest)
    }

    /// The document as a group that stands at `span`.
    pub(super) fn grouped(self, span: Span, broken: Break) -> Self {
        self.around(|doc| Part::Group(doc, span, broken))
    }

    /// The document on one line.
    pub(super) fn flat(self) -> Self {
        self.around(Part::Flat)
    }

    /// The document with `width` characters kept free behind it.
    pub(super) fn room(self, width: usize) -> Self {
        self.around(|doc| Part::Room(width, doc))
    }

    /// The document after the comments before byte `end` that have no place in it.
    pub(super) fn settled(self, end: usize) -> Self {
        self.around(|doc| Part::Settle(end, doc))
    }

    /// Whether a comment at byte `at` of the source can stay where it is: in braces, among the entries of a list, or where
    /// a line ends.
    pub(super) fn has_place(&self, at: usize) -> bool {
        match &self.part {
            Part::Row(parts) => parts.iter().any(|part| part.has_place(at)),
            Part::Nest(doc) | Part::Room(_, doc) | Part::Settle(_, doc) => doc.has_place(at),
            Part::Group(doc, span, _) => span.range().contains(&at) && doc.has_place(at),
            Part::List(list) => list.has_place(at),
            Part::Line(gap) => gap.contains(&at),
            Part::Text(_) | Part::Column(_) | Part::Flat(_) | Part::Hoist(_) => false,
        }
    }

    /// The first character.
    pub(super) fn first(&self) -> Option<char> {
        match &self.part {
            Part::Text(text) => text.chars().next(),
            Part::Row(parts) => parts.iter().find_map(Self::first),
            Part::Nest(doc)
            | Part::Group(doc, ..)
            | Part::Flat(doc)
            | Part::Room(_, doc)
            | Part::Settle(_, doc) => doc.first(),
            Part::List(list) => list.brackets.open.chars().next(),
            Part::Column(_) | Part::Line(_) | Part::Hoist(_) => None,
        }
    }

    /// The text of the document on one line.
    pub(super) fn on_one_line(&self) -> String {
        let mut cells = vec![String::new()];
        self.write(&mut cells, true);
        cells.concat()
    }

    /// Writes the document on one line at the end of the last of `cells`, and begins a cell for each column that is
    /// not `in_list`.
    pub(super) fn write(&self, cells: &mut Vec<String>, in_list: bool) {
        match &self.part {
            Part::Text(text) => push(cells, text),
            Part::Line(_) => push(cells, " "),
            Part::Column(blank) if in_list => push(cells, blank),
            Part::Column(_) => cells.push(String::new()),
            Part::Hoist(_) => {}
            Part::Row(parts) => parts.iter().for_each(|part| part.write(cells, in_list)),
            Part::Nest(doc)
            | Part::Group(doc, ..)
            | Part::Flat(doc)
            | Part::Room(_, doc)
            | Part::Settle(_, doc) => doc.write(cells, in_list),
            Part::List(list) => list.write(cells, list.columns && !in_list),
        }
    }
}

impl List<'_> {
    fn has_place(&self, at: usize) -> bool {
        let mut entries = self.entries.iter();
        self.span.range().contains(&at)
            && (self.brackets == Brackets::BLOCK
                || entries
                    .find(|entry| entry.span.range().contains(&at))
                    .is_none_or(|entry| entry.doc.has_place(at)))
    }

    fn write(&self, cells: &mut Vec<String>, columns: bool) {
        let brackets = self.brackets;
        push(cells, brackets.open);
        for (index, entry) in self.entries.iter().enumerate() {
            if index == 0 {
                push(cells, brackets.pad);
            } else {
                push(cells, brackets.comma);
                if columns {
                    cells.push(String::new());
                } else {
                    push(cells, brackets.gap);
                }
            }
            entry.doc.write(cells, true);
        }
        if !self.entries.is_empty() {
            push(cells, brackets.pad);
        }
        push(cells, brackets.close);
    }
}

fn push(cells: &mut [String], text: &str) {
    if let Some(cell) = cells.last_mut() {
        cell.push_str(text);
    }
}
