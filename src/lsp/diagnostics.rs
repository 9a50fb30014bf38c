//! What is wrong with a program, as an editor shows it.

use super::analysis::Analysis;
use super::documents::Documents;
use crate::diagnostic::{Code, Diagnostic, Severity};
use crate::driver::load::beside;
use crate::source::{FileId, Span};
use crate::syntax::ast::{ItemKind, UseWhat};
use gen_lsp_types as lsp;
use gen_lsp_types::{DiagnosticRelatedInformation as Related, DiagnosticSeverity};
use std::collections::BTreeMap;

/// How many mistakes of a used file are shown at its `use`.
const SHOWN: usize = 3;

/// What is wrong with the main file, and where it uses a file with mistakes, that.
pub(super) fn told(analysis: &Analysis, documents: &Documents) -> Vec<lsp::Diagnostic> {
    let mut told = Vec::new();
    let mut elsewhere: BTreeMap<FileId, Vec<&Diagnostic>> = BTreeMap::new();
    for found in &analysis.loaded.diagnostics {
        let file = found.span().file;
        if found.labels.is_empty() || file == analysis.main() {
            told.push(shown(analysis, documents, found));
        } else if found.is_error() {
            elsewhere.entry(file).or_default().push(found);
        }
    }
    for (file, found) in elsewhere {
        told.push(of_used(analysis, documents, file, &found));
    }
    told
}

/// A mistake as an editor shows it.
pub(super) fn shown(
    analysis: &Analysis,
    documents: &Documents,
    found: &Diagnostic,
) -> lsp::Diagnostic {
    let mut message = found.message.clone();
    let mut labels = found.labels.iter();
    if let Some(primary) = labels.next().filter(|label| !label.message.is_empty()) {
        message = format!("{message}: {}", primary.message);
    }
    let notes = found.notes.iter().map(|note| ("note", note));
    let help = found.help.iter().map(|help| ("help", help));
    for (word, said) in notes.chain(help) {
        message.push_str(&format!("\n{word}: {said}"));
    }
    let related = labels.filter_map(|label| {
        Some(Related {
            location: analysis.location(label.span, documents)?,
            message: label.message.clone(),
        })
    });
    let related: Vec<Related> = related.collect();
    let span = match found.labels.is_empty() {
        true => Span::new(analysis.main(), 0, 0),
        false => found.span(),
    };
    lsp::Diagnostic {
        range: analysis.range(span),
        severity: Some(match found.severity {
            Severity::Error => DiagnosticSeverity::Error,
            Severity::Warning => DiagnosticSeverity::Warning,
        }),
        code: Some(lsp::Code::String(found.code.to_string())),
        source: Some("btc".to_owned()),
        message: lsp::Message::String(message),
        tags: (found.code == Code::W0201).then(|| vec![lsp::DiagnosticTag::Unnecessary]),
        related_information: Some(related).filter(|related| !related.is_empty()),
        ..lsp::Diagnostic::default()
    }
}

/// That a used file has mistakes, at the `use` by which it came.
fn of_used(
    analysis: &Analysis,
    documents: &Documents,
    file: FileId,
    found: &[&Diagnostic],
) -> lsp::Diagnostic {
    let path = analysis.path(file).unwrap_or_default();
    let main = analysis.path(analysis.main()).unwrap_or_default();
    let uses = analysis
        .loaded
        .ast
        .items
        .iter()
        .filter_map(|item| match &item.kind {
            ItemKind::Use(used) => Some(&used.what),
            _ => None,
        });
    let names =
        |used: &UseWhat| matches!(used, UseWhat::Path(named) if beside(main, named) == path);
    let paths = uses.filter(|what| matches!(what.node, UseWhat::Path(_)));
    let paths: Vec<_> = paths.collect();
    let at = paths
        .iter()
        .find(|what| names(&what.node))
        .or(paths.first());
    let span = at.map_or(Span::new(analysis.main(), 0, 0), |what| what.span);
    let name = path.rsplit('/').next().unwrap_or(path);
    let message = match found {
        [one] => format!("`{name}` has a mistake: {}", one.message),
        several => format!("`{name}` has {} mistakes", several.len()),
    };
    let related = found.iter().take(SHOWN).filter_map(|found| {
        Some(Related {
            location: analysis.location(found.span(), documents)?,
            message: found.message.clone(),
        })
    });
    lsp::Diagnostic {
        range: analysis.range(span),
        severity: Some(DiagnosticSeverity::Error),
        source: Some("btc".to_owned()),
        message: lsp::Message::String(message),
        related_information: Some(related.collect()),
        ..lsp::Diagnostic::default()
    }
}
