//! Types that a text does not say.

use super::analysis::Analysis;
use crate::check::Entity;
use crate::syntax::tokens::Kind;
use gen_lsp_types::{InlayHint, InlayHintKind, Label, Range};

/// The types of names that are declared without one, in a range of the main file.
pub(super) fn hints(analysis: &Analysis, within: Range) -> Vec<InlayHint> {
    let meanings = &analysis.loaded.meanings;
    let mut hints = Vec::new();
    for (name, entity) in meanings.declared() {
        let range = analysis.range(name);
        let typed = matches!(entity, Entity::Let | Entity::State | Entity::Local);
        let here =
            name.file == analysis.main() && within.start <= range.end && range.start <= within.end;
        if !typed || !here || !is_given_a_value(analysis, name.range().end) {
            continue;
        }
        let Some(ty) = meanings.written_type(name) else {
            continue;
        };
        hints.push(InlayHint {
            position: range.end,
            label: Label::String(format!(": {ty}")),
            kind: Some(InlayHintKind::Type),
            text_edits: None,
            tooltip: None,
            padding_left: None,
            padding_right: None,
            data: None,
        });
    }
    hints
}

/// Whether `=` follows at once: a type, or parameters, would stand before it.
fn is_given_a_value(analysis: &Analysis, end: usize) -> bool {
    let next = analysis.tokens.partition_point(|token| token.start < end);
    let next = analysis.tokens.get(next);
    next.is_some_and(|next| next.kind == Kind::Mark && next.of(analysis.text()) == "=")
}
