//! Bodies that stand in parentheses.

use super::tokens::Token;
use crate::diagnostic::{Applicability, Code, Diagnostic, Fix};
use crate::source::{FileId, Span};

/// A body in parentheses, or between a `(` and a `}`.
pub(super) struct Body<'t> {
    /// What the body is of: `control`.
    of: &'t str,
    /// The byte of `(`.
    opens: usize,
    /// The byte of `)`, where there is one.
    closes: Option<usize>,
}

/// The words whose body follows, and those whose body follows a name.
const BODIED: [&str; 3] = ["control", "reward", "start"];
const NAMED: [&str; 3] = ["robot", "task", "world"];

impl Body<'_> {
    /// What is meant, of the same length: each byte with the brace that is to stand there.
    pub(super) fn braces(&self) -> impl Iterator<Item = (usize, &'static str)> {
        let closes = self.closes.map(|at| (at, "}"));
        [(self.opens, "{")].into_iter().chain(closes)
    }

    /// What is said of it.
    pub(super) fn told(&self, file: FileId) -> Diagnostic {
        let place = |at: usize| Span::new(file, at, at + 1);
        let message = format!("the body of `{}` stands in braces", self.of);
        let mut edits = vec![(place(self.opens), "{".to_owned())];
        edits.extend(self.closes.map(|at| (place(at), "}".to_owned())));
        let mut told = Diagnostic::new(Code::E0101, place(self.opens), message).label("write `{`");
        told.fixes.push(Fix {
            title: "write braces".to_owned(),
            edits,
            applicability: Applicability::Unsafe,
        });
        told
    }
}

/// The bodies of a text that do not begin with a brace, in order.
pub(super) fn bodies<'t>(text: &'t str, tokens: &[Token]) -> Vec<Body<'t>> {
    let mut found = Vec::new();
    // The brackets that are open, with the words before those that begin a body.
    let mut open: Vec<(usize, Option<&str>)> = Vec::new();
    for (index, token) in tokens.iter().enumerate() {
        match token.of(text) {
            "{" => open.push((token.start, None)),
            "(" => {
                let before = tokens.get(..index).unwrap_or_default();
                open.push((token.start, body_of(text, before, *token)));
            }
            close @ ("}" | ")") => {
                if let Some((opens, Some(of))) = open.pop() {
                    found.push(Body {
                        of,
                        opens,
                        closes: (close == ")").then_some(token.start),
                    });
                }
            }
            _ => {}
        }
    }
    found.sort_by_key(|body| body.opens);
    found
}

/// What the body is of that begins with a `(`; nothing if that begins none.
fn body_of<'t>(text: &'t str, before: &[Token], paren: Token) -> Option<&'t str> {
    let at = |behind: usize| {
        before
            .len()
            .checked_sub(behind)
            .and_then(|at| before.get(at))
    };
    let word = |behind: usize| at(behind).map_or("", |token| token.of(text));
    // A call touches its parenthesis.
    if at(1)?.end == paren.start {
        return None;
    }
    let (words, of) = match (word(2), word(1)) {
        (_, own) if BODIED.contains(&own) => (1, own),
        ("each", "tick") => (2, "each tick"),
        (own, _) if NAMED.contains(&own) => (2, own),
        _ => return None,
    };
    let (first, last) = (at(words)?, at(words + 1));
    let gap = last.map_or("", |last| {
        text.get(last.end..first.start).unwrap_or_default()
    });
    let begins = matches!(word(words + 1), "" | "{" | "}") || gap.contains('\n');
    begins.then_some(of)
}
