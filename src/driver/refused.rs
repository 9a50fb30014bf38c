//! Why a command has no result.

use super::load::Loaded;
use super::text::{Text, decode};
use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Sources};

/// Mistakes, with the texts that they point into.
#[derive(Clone, Debug)]
pub struct Refused {
    /// The texts.
    pub sources: Sources,
    /// The mistakes, sorted.
    pub diagnostics: Vec<Diagnostic>,
}

impl Refused {
    /// Mistakes of a program.
    pub(super) fn program(
        loaded: &Loaded,
        diagnostics: impl IntoIterator<Item = Diagnostic>,
    ) -> Self {
        Self {
            sources: loaded.sources.clone(),
            diagnostics: diagnostics.into_iter().collect(),
        }
    }

    /// Mistakes of one text, as `locate` places them in it. Their places count bytes: if the bytes are not UTF-8, only
    /// that is reported.
    pub(super) fn text(text: Text, locate: impl FnOnce(FileId) -> Vec<Diagnostic>) -> Self {
        let mut sources = Sources::default();
        let (file, broken) = decode(&mut sources, text);
        let diagnostics = broken.map_or_else(|| locate(file), |broken| vec![broken]);
        Self {
            sources,
            diagnostics,
        }
    }
}
