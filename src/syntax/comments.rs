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

/// The lines of documentation right above byte `start`.
pub(super) fn docs_before(text: &str, comments: &[Comment], start: usize) -> Vec<String> {
    let end = comments.partition_point(|comment| (comment.span.start as usize) < start);
    let mut below = start;
    let mut docs: Vec<String> = comments
        .iter()
        .take(end)
        .rev()
        .take_while(|comment| {
            let between = text.get(comment.span.end as usize..below).unwrap_or("?");
            below = comment.span.start as usize;
            between.chars().all(is_blank)
                && comment.kind == CommentKind::Item
                && is_whole_line(text, comment)
        })
        .map(|comment| {
            let text = &comment.text;
            text.strip_prefix(' ').unwrap_or(text).to_owned()
        })
        .collect();
    docs.reverse();
    docs
}

/// Whether nothing but blanks stands before the comment on its line.
pub(super) fn is_whole_line(text: &str, comment: &Comment) -> bool {
    let before = text.get(..comment.span.start as usize).unwrap_or_default();
    let line = before.rsplit('\n').next().unwrap_or_default();
    line.chars().all(is_blank)
}
