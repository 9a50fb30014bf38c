//! Types that a text does not say.

use super::analysis::Analysis;
use crate::check::Entity;
use crate::source::Span;
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
        if !typed || !here {
            continue;
        }
        let Some((at, ty)) = place(analysis, name).zip(meanings.written_type(name)) else {
            continue;
        };
        hints.push(InlayHint {
            position: analysis.range(at).end,
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

/// A name with its parameters, if `=` follows at once: its type would stand between them.
fn place(analysis: &Analysis, name: Span) -> Option<Span> {
    let text = analysis.text();
    let next = (analysis.tokens).partition_point(|token| token.start < name.range().end);
    let rest = analysis.tokens.get(next..)?;
    let mut open = 0_usize;
    let params = rest.iter().take_while(|token| {
        let goes_on = open > 0 || token.of(text) == "(";
        match token.of(text) {
            "(" => open += 1,
            ")" => open = open.saturating_sub(1),
            _ => {}
        }
        goes_on
    });
    let params: Vec<_> = params.collect();
    let is = rest.get(params.len())?;
    let end = params.last().map_or(name.range().end, |last| last.end);
    (is.of(text) == "=").then(|| Span::new(name.file, name.range().start, end))
}
