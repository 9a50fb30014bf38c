//! Quick fixes.

use super::analysis::Analysis;
use super::diagnostics::shown;
use super::documents::Documents;
use crate::diagnostic::Applicability;
use crate::driver::check::fixes;
use crate::source::Span;
use gen_lsp_types::{CodeAction, CodeActionKind, Range, TextEdit, Uri, WorkspaceEdit};
use std::collections::HashMap;

/// What can be done about the mistakes in a range: their fixes, and all fixes of the file that may be applied unseen.
pub(super) fn actions(analysis: &Analysis, documents: &Documents, range: Range) -> Vec<CodeAction> {
    let mut actions = Vec::new();
    for found in &analysis.loaded.diagnostics {
        let at = analysis.range(found.span());
        if found.span().file != analysis.main() || at.end < range.start || range.end < at.start {
            continue;
        }
        for fix in &found.fixes {
            let Some(edit) = edit(analysis, documents, &fix.edits) else {
                continue;
            };
            actions.push(CodeAction {
                title: sentence(&fix.title),
                kind: Some(CodeActionKind::QuickFix),
                diagnostics: Some(vec![shown(analysis, documents, found)]),
                is_preferred: Some(fix.applicability == Applicability::Safe),
                edit: Some(edit),
                ..CodeAction::default()
            });
        }
    }
    let all = fixes(&analysis.loaded);
    if let Some(edit) = edit(analysis, documents, &all).filter(|_| !all.is_empty()) {
        actions.push(CodeAction {
            title: "Apply all safe fixes of this file".to_owned(),
            kind: Some(CodeActionKind::SourceFixAll),
            edit: Some(edit),
            ..CodeAction::default()
        });
    }
    actions
}

/// Changes to the user's files; none if one of them is to be of another file.
pub(super) fn edit(
    analysis: &Analysis,
    documents: &Documents,
    edits: &[(Span, String)],
) -> Option<WorkspaceEdit> {
    let mut changes: HashMap<Uri, Vec<TextEdit>> = HashMap::new();
    for (span, new) in edits {
        let location = analysis.location(*span, documents)?;
        changes.entry(location.uri).or_default().push(TextEdit {
            range: location.range,
            new_text: new.clone(),
        });
    }
    Some(WorkspaceEdit {
        changes: Some(changes),
        ..WorkspaceEdit::default()
    })
}

/// A title with a capital letter.
fn sentence(title: &str) -> String {
    let mut letters = title.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}
