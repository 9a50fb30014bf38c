//! The open documents.

use super::analysis::Analysis;
use super::uri;
use crate::driver::load::Reader;
use crate::source::Source;
use gen_lsp_types::{TextDocumentContentChangeEvent as Change, Uri};
use std::collections::BTreeMap;
use std::rc::Rc;

/// An open document.
pub(super) struct Document {
    /// Its URI, as the editor writes it.
    pub(super) uri: Uri,
    /// The version that the editor gave it last.
    pub(super) version: i32,
    /// Its text.
    pub(super) text: String,
    /// What is known of it, if nothing has changed since.
    pub(super) analysis: Option<Rc<Analysis>>,
    /// Whether the editor has not been told yet what is wrong with it.
    pub(super) untold: bool,
}

impl Document {
    /// A document as it is opened.
    pub(super) fn new(uri: Uri, version: i32, text: String) -> Self {
        Self {
            uri,
            version,
            text,
            analysis: None,
            untold: true,
        }
    }

    /// Applies changes of the text, in their order.
    pub(super) fn change(&mut self, changes: Vec<Change>) {
        for change in changes {
            match change {
                Change::TextDocumentContentChangeWholeDocument(whole) => self.text = whole.text,
                Change::TextDocumentContentChangePartial(part) => {
                    let source = Source::new("", std::mem::take(&mut self.text));
                    let at = |position: gen_lsp_types::Position| {
                        source.offset_utf16(position.line as usize, position.character as usize)
                    };
                    let (from, to) = (at(part.range.start), at(part.range.end));
                    let range = from as usize..from.max(to) as usize;
                    self.text = source.text;
                    if self.text.get(range.clone()).is_some() {
                        self.text.replace_range(range, &part.text);
                    }
                }
            }
        }
    }
}

/// The open documents, by path.
#[derive(Default)]
pub(super) struct Documents {
    /// Each of them, by its path.
    pub(super) open: BTreeMap<String, Document>,
}

impl Documents {
    /// The document of a URI.
    pub(super) fn get_mut(&mut self, of: &Uri) -> Option<&mut Document> {
        self.open.get_mut(&uri::path(of))
    }

    /// The URI of a path: as the editor writes it, if it has the file open.
    pub(super) fn uri(&self, path: &str) -> Uri {
        let open = self.open.get(path);
        open.map_or_else(|| uri::of(path), |document| document.uri.clone())
    }

    /// Notes that the document at a path has changed: what is known of it, and of those that use it, is known no more.
    pub(super) fn changed(&mut self, path: &str) {
        for (own, document) in &mut self.open {
            let uses = |analysis: &Rc<Analysis>| analysis.reads(path);
            if own == path || document.analysis.as_ref().is_none_or(uses) {
                document.analysis = None;
                document.untold = true;
            }
        }
    }
}

/// Reads the open documents, and what is not open with another reader. It keeps the names of what was looked for.
pub(super) struct Overlay<'a> {
    /// The open documents.
    pub(super) documents: &'a Documents,
    /// What reads all else.
    pub(super) disk: Box<dyn Reader + 'a>,
    /// The paths that were looked for, whether they were there or not.
    pub(super) asked: Vec<String>,
}

impl Reader for Overlay<'_> {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        self.asked.push(path.to_owned());
        match self.documents.open.get(path) {
            Some(document) => Ok(document.text.clone().into_bytes()),
            None => self.disk.read(path),
        }
    }
}
