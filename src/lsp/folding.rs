//! What can be folded: blocks, and comments of several lines.

use super::analysis::Analysis;
use crate::syntax::tokens::{Kind, Token};
use gen_lsp_types::{FoldingRange, FoldingRangeKind};

/// What can be folded in the main file, in the order in which it begins.
pub(super) fn folds(analysis: &Analysis) -> Vec<FoldingRange> {
    let text = analysis.text();
    let mut folds = Vec::new();
    let mut open: Vec<Token> = Vec::new();
    for token in &analysis.tokens {
        match (token.kind, token.of(text)) {
            (Kind::Mark, "{") => open.push(*token),
            (Kind::Mark, "}") => {
                let block = open.pop();
                folds.extend(block.and_then(|open| fold(analysis, open.end, token.start, None)));
            }
            _ => {}
        }
    }
    let mut comments = analysis
        .tokens
        .iter()
        .enumerate()
        .filter(|(_, it)| it.kind == Kind::Comment);
    let mut run: Option<(usize, Token, Token)> = None;
    for (at, token) in comments.by_ref() {
        match &mut run {
            Some((last, _, end)) if *last + 1 == at && touch(text, *end, *token) => {
                (*last, *end) = (at, *token);
            }
            _ => {
                folds.extend(run.and_then(|run| comment(analysis, run)));
                run = Some((at, *token, *token));
            }
        }
    }
    folds.extend(run.and_then(|run| comment(analysis, run)));
    folds.sort_by_key(|fold| (fold.start_line, fold.end_line));
    folds
}

/// Whether two comments stand on lines that follow each other.
fn touch(text: &str, one: Token, other: Token) -> bool {
    let gap = text.get(one.end..other.start).unwrap_or_default();
    gap.matches('\n').count() == 1
}

fn comment(analysis: &Analysis, (_, from, to): (usize, Token, Token)) -> Option<FoldingRange> {
    fold(analysis, from.end, to.end, Some(FoldingRangeKind::Comment))
}

fn fold(
    analysis: &Analysis,
    start: usize,
    end: usize,
    kind: Option<FoldingRangeKind>,
) -> Option<FoldingRange> {
    let range = analysis.range_of(start, end);
    let is_block = kind.is_none();
    // The line of the closing brace stays in sight.
    let last = range.end.line.saturating_sub(u32::from(is_block));
    (last > range.start.line).then(|| FoldingRange {
        start_line: range.start.line,
        start_character: None,
        end_line: last,
        end_character: None,
        kind: kind.or(Some(FoldingRangeKind::Region)),
        collapsed_text: None,
    })
}
