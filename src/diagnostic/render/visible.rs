//! Characters that would change what a terminal shows: control characters, and marks that turn the direction of writing.

use std::borrow::Cow;

/// The text with each such character written as its code, as a `\r` is that ends no line.
pub fn visible(text: &str) -> Cow<'_, str> {
    if !text.contains(|letter| is_hidden(letter) || letter == '\r') {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        if is_hidden(letter) || letter == '\r' && letters.peek() != Some(&'\n') {
            shown.push_str(&format!("\\u{{{:x}}}", u32::from(letter)));
        } else {
            shown.push(letter);
        }
    }
    Cow::Owned(shown)
}

/// The text on one line: as [`visible`], and so are the ends of lines in it. A file may be called so.
pub fn on_one_line(text: &str) -> Cow<'_, str> {
    match text.contains(['\n', '\r', '\t']) {
        true => Cow::Owned(text.chars().map(written).collect()),
        false => visible(text),
    }
}

/// A character, or its code if it would change what a terminal shows or ends a line.
fn written(letter: char) -> String {
    match is_hidden(letter) || matches!(letter, '\n' | '\r' | '\t') {
        true => format!("\\u{{{:x}}}", u32::from(letter)),
        false => letter.to_string(),
    }
}

/// The characters that would, each with its place.
pub fn hidden(text: &str) -> impl Iterator<Item = (usize, char)> {
    text.char_indices().filter(|(_, letter)| is_hidden(*letter))
}

/// The text with a stand-in of the same length in bytes for each such character, so that places stay what they are.
pub(super) fn in_place(text: &str) -> Cow<'_, str> {
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let stand_in = |letter: char| match letter.len_utf8() {
        _ if !is_hidden(letter) => letter,
        1 => '?',
        2 => '\u{b7}',
        _ => '\u{fffd}',
    };
    Cow::Owned(text.chars().map(stand_in).collect())
}

fn is_hidden(letter: char) -> bool {
    let turns = matches!(
        letter,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    turns || letter.is_control() && !matches!(letter, '\n' | '\r' | '\t')
}

#[cfg(test)]
mod tests {
    use super::{on_one_line, visible};

    #[test]
    fn what_changes_a_terminal_is_written_as_its_code() {
        assert_eq!(visible("a\r\nb\tc\n"), "a\r\nb\tc\n");
        assert_eq!(visible("p\rq\r"), "p\\u{d}q\\u{d}");
        assert_eq!(visible("\u{1b}]0;x\u{7}"), "\\u{1b}]0;x\\u{7}");
        assert_eq!(visible("x\u{202e}y\u{9b}z"), "x\\u{202e}y\\u{9b}z");
    }

    #[test]
    fn a_name_has_one_line() {
        assert_eq!(on_one_line("a\nerror: b\u{7}"), "a\\u{a}error: b\\u{7}");
        assert_eq!(on_one_line("a b"), "a b");
    }
}
