//! How the language spells a name: as it is, or in backquotes.

use std::borrow::Cow;

/// The words that are no names.
pub const RESERVED: [&str; 23] = [
    "and",
    "or",
    "not",
    "if",
    "else",
    "for",
    "in",
    "true",
    "false",
    "let",
    "use",
    "world",
    "enum",
    "state",
    "event",
    "each",
    "on",
    "predicate",
    "behavior",
    "task",
    "learn",
    "tree",
    "claim",
];

/// Words of other languages that would be taken for `true` and `false`.
const TRUTHS: [&str; 4] = ["True", "TRUE", "False", "FALSE"];

/// A name as text of the language: in backquotes if it is not an identifier or means something already.
pub fn spelled(name: &str) -> Cow<'_, str> {
    if is_identifier(name) && !RESERVED.contains(&name) && !TRUTHS.contains(&name) {
        Cow::Borrowed(name)
    } else {
        Cow::Owned(quoted(name))
    }
}

/// The name that a text spells, in backquotes or without.
pub fn bare(text: &str) -> &str {
    let text = text.trim();
    let inside = text.strip_prefix('`').and_then(|t| t.strip_suffix('`'));
    inside.filter(|name| !name.contains('`')).unwrap_or(text)
}

/// Why the language cannot spell a name, not even in backquotes; `None` if it can.
pub fn unusable(name: &str) -> Option<&'static str> {
    if name.is_empty() {
        Some("a name has at least one character")
    } else if name.contains('`') {
        Some("a backquote ends a name")
    } else if name.contains(char::is_control) {
        Some("a name stands on one line, without control characters")
    } else {
        None
    }
}

/// A name in backquotes.
pub fn quoted(name: &str) -> String {
    format!("`{name}`")
}

fn is_identifier(name: &str) -> bool {
    let mut letters = name.chars();
    let first = letters.next();
    first.is_some_and(|first| first.is_ascii_alphabetic() || first == '_')
        && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_')
}
