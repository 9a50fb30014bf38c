//! From a name to its declaration and to its uses, in all programs of the workspace.

use super::analysis::{self, Analysis};
use super::documents::Documents;
use crate::source::{Source, Span};
use gen_lsp_types::{DocumentHighlight, Location};
use std::rc::Rc;

/// Where the name at a byte of the main file is declared. The library's text is shown in a file of its own.
pub(super) fn definition(
    analysis: &Analysis,
    documents: &Documents,
    library: Option<&str>,
    byte: u32,
) -> Option<Location> {
    let (_, declared) = analysis.declared_at(byte)?;
    let own = analysis.location(declared, documents);
    own.or_else(|| {
        let source: &Source = analysis.loaded.sources.get(declared.file)?;
        Some(analysis::location(library?, source, declared))
    })
}

/// The places of the main file that stand for the same as the name at a byte.
pub(super) fn highlights(analysis: &Analysis, byte: u32) -> Vec<DocumentHighlight> {
    let Some((_, declared)) = analysis.declared_at(byte) else {
        return Vec::new();
    };
    let places = named(analysis, declared);
    let here = places
        .into_iter()
        .filter(|span| span.file == analysis.main());
    here.map(|span| DocumentHighlight {
        range: analysis.range(span),
        kind: None,
    })
    .collect()
}

/// The places of a program that name what is declared at a place, that one first.
pub(super) fn named(analysis: &Analysis, declared: Span) -> Vec<Span> {
    let uses = analysis.loaded.meanings.uses_of(declared);
    std::iter::once(declared).chain(uses).collect()
}

/// A declaration, as programs that read the same file agree on it.
pub(super) struct Declared {
    /// The path of its file; none if it is of the library.
    pub(super) path: Option<String>,
    /// The first byte of its name.
    start: u32,
    /// The name.
    pub(super) name: String,
}

impl Declared {
    /// What is declared at a place of a program.
    pub(super) fn of(analysis: &Analysis, declared: Span) -> Self {
        let name = analysis.written(declared);
        Self {
            path: analysis.path(declared.file).map(str::to_owned),
            start: declared.start,
            name: crate::spelling::bare(name).to_owned(),
        }
    }

    /// The place of the declaration in a program, if it is there.
    pub(super) fn in_program(&self, analysis: &Analysis) -> Option<Span> {
        let mut declared = analysis.loaded.meanings.declared();
        let found = declared.find(|(span, _)| {
            span.start == self.start && analysis.path(span.file) == self.path.as_deref()
        });
        found.map(|(span, _)| span)
    }
}

/// The places of programs that name a declaration, each once, in the order of their files.
pub(super) fn references(
    programs: &[Rc<Analysis>],
    documents: &Documents,
    declared: &Declared,
    with_declaration: bool,
) -> Vec<Location> {
    let mut found: Vec<Location> = Vec::new();
    for program in programs {
        let Some(at) = declared.in_program(program) else {
            continue;
        };
        let places = named(program, at).into_iter();
        let places = places.skip(usize::from(!with_declaration));
        found.extend(places.filter_map(|span| program.location(span, documents)));
    }
    found.sort_by(|a, b| (&a.uri.0, a.range).cmp(&(&b.uri.0, b.range)));
    found.dedup();
    found
}
