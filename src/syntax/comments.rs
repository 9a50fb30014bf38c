//! Comments, and the documentation among them.

use super::ast::{Comment, CommentKind};
use super::tokens::{Kind, Token, is_blank};
use crate::source::{FileId, Span};

/// The comments of `text`.
pub(super) fn comments(file: FileId, text: &str, tokens: &[Token]) -> Vec<Comment> {
    tokens
        .iter()
        .filter(|token| token.kind == Kind::Comment)
        .map(|token| {
            let (kind, said) = kind(token.of(text));
            Comment {
                kind,
                text: said.to_owned(),
                span: Span::new(file, token.start, token.end),
            }
        })
        .collect()
}

/// The kind of a comment, and its text after the slashes.
fn kind(comment: &str) -> (CommentKind, &str) {
    if let Some(said) = comment.strip_prefix("//!") {
        (CommentKind::File, said)
    } else if let Some(said) = comment
        .strip_prefix("///")
        .filter(|said| !said.starts_with('/'))
    {
        (CommentKind::Item, said)
    } else {
        (
            CommentKind::Plain,
            comment.strip_prefix("//").unwrap_or(comment),
        )
    }
}

/// The lines of documentation right above byte `start`, and the index of the first comment that is one of them.
pub(super) fn docs_before(text: &str, comments: &[Comment], start: usize) -> (Vec<String>, usize) {
    let end = comments.partition_point(|comment| (comment.span.start as usize) < start);
    let mut first = end;
    let mut below = start;
    for (index, comment) in comments.iter().enumerate().take(end).rev() {
        let between = text.get(comment.span.end as usize..below).unwrap_or("?");
        if !between.chars().all(is_blank)
            || comment.kind != CommentKind::Item
            || !is_whole_line(text, comment)
        {
            break;
        }
        first = index;
        below = comment.span.start as usize;
    }
    let docs = comments
        .get(first..end)
        .unwrap_or_default()
        .iter()
        .map(|comment| {
            comment
                .text
                .strip_prefix(' ')
                .unwrap_or(&comment.text)
                .to_owned()
        })
        .collect();
    (docs, first)
}

/// Whether nothing but blanks stands before the comment on its line.
pub(super) fn is_whole_line(text: &str, comment: &Comment) -> bool {
    let before = text.get(..comment.span.start as usize).unwrap_or_default();
    let line = before.rsplit('\n').next().unwrap_or_default();
    line.chars().all(is_blank)
}
