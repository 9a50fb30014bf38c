//! A loaded program, as an editor sees it: places are lines and columns in UTF-16.

use super::documents::{Documents, Overlay};
use super::outline::{Outlined, outline};
use super::{Workspace, uri};
use crate::check::Meaning;
use crate::driver::check;
use crate::driver::load::{Loaded, load_again};
use crate::source::{FileId, Source, Span};
use crate::syntax::Memory;
use crate::syntax::tokens::{Token, tokens};
use gen_lsp_types::{Location, Position, Range};

/// A program that was loaded from an open document, or from a file.
pub(super) struct Analysis {
    /// The program.
    pub(super) loaded: Loaded,
    /// The tokens of the main file.
    pub(super) tokens: Vec<Token>,
    /// The paths that it reads, or would if they were there.
    asked: Vec<String>,
}

impl Analysis {
    /// The program in a text, whose path says where its `use`s are; its files may have been parsed before.
    pub(super) fn of(
        path: &str,
        text: String,
        documents: &Documents,
        workspace: &dyn Workspace,
        memory: &mut Memory,
    ) -> Self {
        let tokens = tokens(&text);
        let mut reader = Overlay {
            documents,
            disk: workspace.reader(path),
            asked: Vec::new(),
        };
        let mut loaded = load_again(path, text.into_bytes(), &mut reader, memory);
        let asked = reader.asked;
        let worlds = check::worlds(&loaded);
        loaded.diagnostics.extend(worlds);
        Self {
            loaded,
            tokens,
            asked,
        }
    }

    /// Whether the program depends on the file at a path.
    pub(super) fn reads(&self, path: &str) -> bool {
        self.asked.iter().any(|asked| asked == path)
    }

    /// The main file.
    pub(super) fn main(&self) -> FileId {
        self.loaded.main
    }

    /// The text of the main file.
    pub(super) fn text(&self) -> &str {
        let source = self.loaded.sources.get(self.loaded.main);
        source.map_or("", |source| source.text.as_str())
    }

    /// The byte of the main file at a position.
    pub(super) fn byte(&self, position: Position) -> u32 {
        let source = self.loaded.sources.get(self.loaded.main);
        source.map_or(0, |source| {
            source.offset_utf16(position.line as usize, position.character as usize)
        })
    }

    /// The lines and columns of a place.
    pub(super) fn range(&self, span: Span) -> Range {
        let source = self.loaded.sources.get(span.file);
        source.map_or_else(Range::default, |source| range(source, span.start, span.end))
    }

    /// The lines and columns of two bytes of the main file.
    pub(super) fn range_of(&self, start: usize, end: usize) -> Range {
        self.range(Span::new(self.loaded.main, start, end))
    }

    /// The path of a file; none of the library, which has none.
    pub(super) fn path(&self, file: FileId) -> Option<&str> {
        let own = self.loaded.files.contains(&file) || file == self.loaded.main;
        let source = self.loaded.sources.get(file).filter(|_| own)?;
        Some(&source.name)
    }

    /// A place in a file of the user.
    pub(super) fn location(&self, span: Span, documents: &Documents) -> Option<Location> {
        Some(Location {
            uri: documents.uri(self.path(span.file)?),
            range: self.range(span),
        })
    }

    /// The place of the declaration that the name at a byte of the main file stands for, with the place of the name.
    pub(super) fn declared_at(&self, byte: u32) -> Option<(Span, Span)> {
        match self.loaded.meanings.at(self.loaded.main, byte)? {
            (name, Meaning::Declared(declared)) => Some((name, declared)),
            (_, Meaning::BuiltIn) => None,
        }
    }

    /// What is declared in all files.
    pub(super) fn outlines(&self) -> Vec<Outlined<'_>> {
        self.loaded.asts().flat_map(outline).collect()
    }

    /// The name as it stands at a place.
    pub(super) fn written(&self, span: Span) -> &str {
        self.loaded.sources.text(span)
    }
}

/// The lines and columns of two bytes.
pub(super) fn range(source: &Source, start: u32, end: u32) -> Range {
    let position = |byte| {
        let (line, character) = source.position_utf16(byte);
        let clipped = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        Position {
            line: clipped(line),
            character: clipped(character),
        }
    };
    Range {
        start: position(start),
        end: position(end),
    }
}

/// A place in a file that was read for itself.
pub(super) fn location(path: &str, source: &Source, span: Span) -> Location {
    Location {
        uri: uri::of(path),
        range: range(source, span.start, span.end),
    }
}
