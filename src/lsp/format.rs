//! Layout.

use super::analysis::{Analysis, range};
use crate::driver::Text;
use crate::driver::format::format;
use crate::source::{Source, Span};
use gen_lsp_types::{Range, TextEdit};

/// The edit that lays the main file out: the lines that change, none if none does. A text with mistakes in its syntax stays
/// as it is.
pub(super) fn document(analysis: &Analysis) -> Vec<TextEdit> {
    let text = analysis.text();
    changed(text, 0..text.len()).into_iter().collect()
}

/// The edit that lays out the items in a range of lines, with those that no empty line parts from them.
pub(super) fn lines(analysis: &Analysis, lines: Range) -> Vec<TextEdit> {
    let text = analysis.text();
    let (from, to) = (analysis.byte(lines.start), analysis.byte(lines.end));
    let items: Vec<Span> = analysis
        .loaded
        .ast
        .items
        .iter()
        .map(|item| item.span)
        .collect();
    let touched = |span: &Span| span.start <= to && from <= span.end;
    let first = items
        .iter()
        .find(|span| touched(span))
        .map_or(from, |span| span.start.min(from));
    let last = items
        .iter()
        .rfind(|span| touched(span))
        .map_or(to, |span| span.end.max(to));
    let within = |at: usize| {
        items
            .iter()
            .any(|span| (span.start as usize) < at && at < span.end as usize)
    };
    // Empty lines between items are where columns and comments part.
    let mut gaps = text
        .match_indices("\n\n")
        .map(|(at, _)| at + 1)
        .filter(|at| !within(*at));
    let before = gaps.clone().take_while(|at| *at <= first as usize).last();
    let start = before.map_or(0, |at| at + 1);
    let end = gaps.find(|at| *at >= last as usize);
    changed(text, start..end.unwrap_or(text.len()))
        .into_iter()
        .collect()
}

/// The edit that lays out a part of a text.
fn changed(text: &str, part: std::ops::Range<usize>) -> Option<TextEdit> {
    let old = text.get(part.clone())?;
    let bytes = old.as_bytes();
    let new = format(Text { name: "", bytes }).ok()?;
    if new == old {
        return None;
    }
    // Whole lines that stay are left out, so that what the editor shows moves as little as can be.
    let same = old.split_inclusive('\n').zip(new.split_inclusive('\n'));
    let same = same.take_while(|(a, b)| a == b && a.ends_with('\n'));
    let head: usize = same.map(|(line, _)| line.len()).sum();
    let (old, new) = (old.get(head..)?, new.get(head..)?);
    let rest = |text: &'_ str| -> Vec<usize> {
        let lines: Vec<usize> = text.split_inclusive('\n').map(str::len).collect();
        lines.into_iter().rev().collect()
    };
    let mut tail = 0;
    for (a, b) in rest(old).into_iter().zip(rest(new)) {
        let of = |text: &str, length: usize| {
            let end = text.len() - tail;
            text.get(end - length..end).map(str::to_owned)
        };
        if of(old, a) != of(new, b) {
            break;
        }
        tail += a;
    }
    let start = part.start + head;
    let end = start + old.len() - tail;
    let place = Span::new(crate::source::FileId(0), start, end);
    Some(TextEdit {
        range: range(&Source::new("", text), place.start, place.end),
        new_text: new.get(..new.len() - tail)?.to_owned(),
    })
}
