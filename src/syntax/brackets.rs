//! Brackets without a partner.

use super::tokens::{Kind, Token};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::{FileId, Span};

/// The message for a bracket that is open where a block must have ended.
pub(super) fn unclosed(
    file: FileId,
    text: &str,
    tokens: &[Token],
    open: Span,
    at: usize,
) -> Diagnostic {
    let bracket = text.get(open.range()).unwrap_or("{");
    let close = if bracket == "(" { ")" } else { "}" };
    let index = tokens.partition_point(|token| token.start < at);
    let pair = suspicious_pair(text, tokens, open);
    let place = |token: Token| Span::new(file, token.start, token.end);
    let message = format!("this `{bracket}` is never closed");
    let mut diagnostic = match pair {
        // The layout shows which it is.
        Some((inner, further)) => Diagnostic::new(Code::E0102, place(inner), message)
            .label("no `}` at its depth belongs to it")
            .also(place(further), "this `}` stands further left")
            .also(open, "which leaves this one open"),
        None => {
            let label = format!("no `{close}` belongs to it");
            Diagnostic::new(Code::E0102, open, message).label(label)
        }
    };
    let next = tokens
        .get(index..)
        .unwrap_or_default()
        .iter()
        .find(|token| token.kind != Kind::Comment);
    if let Some(next) = next {
        let expected = format!("`{close}` was expected before this");
        diagnostic = diagnostic.also(place(*next), expected);
    }
    diagnostic
}

/// The bracket that is open at byte `at`, among those from byte `start` on.
pub(super) fn innermost_open(
    text: &str,
    tokens: &[Token],
    start: usize,
    at: usize,
) -> Option<Token> {
    let first = tokens.partition_point(|token| token.start < start);
    let end = tokens.partition_point(|token| token.end <= at);
    let mut stack = Vec::new();
    for &token in tokens.get(first..end).unwrap_or_default() {
        match token.of(text) {
            "{" | "(" => stack.push(token),
            "}" | ")" => {
                stack.pop();
            }
            _ => {}
        }
    }
    stack.pop()
}

/// The first pair of braces after `open` whose close stands further left than the line of its opener.
fn suspicious_pair(text: &str, tokens: &[Token], open: Span) -> Option<(Token, Token)> {
    let indent = |at: usize| {
        let line = text
            .get(..at)
            .unwrap_or_default()
            .rsplit('\n')
            .next()
            .unwrap_or_default()
            .len();
        let start = at - line;
        let rest = text.get(start..).unwrap_or_default();
        (
            start,
            rest.find(|letter| letter != ' ' && letter != '\t')
                .unwrap_or(0),
        )
    };
    let mut stack: Vec<Token> = Vec::new();
    for &token in tokens
        .iter()
        .filter(|token| token.start >= open.range().end)
    {
        match token.of(text) {
            "{" => stack.push(token),
            "}" => {
                let opener = stack.pop()?;
                let ((opened, left), (closed, right)) = (indent(opener.start), indent(token.start));
                if opened != closed && right < left {
                    return Some((opener, token));
                }
            }
            _ => {}
        }
    }
    None
}
