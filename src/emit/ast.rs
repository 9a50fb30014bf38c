//! The syntax tree as text: each node with its place, a group on one line where it fits.

use crate::syntax::ast;

/// The column that a group does not pass if it can be broken.
const WIDTH: usize = 110;

/// The syntax tree of a file.
pub fn file(file: &ast::File) -> String {
    let shown = format!("{file:?}");
    let mut layout = Layout {
        rest: &shown,
        text: String::new(),
    };
    layout.group(0, None);
    layout.text.push('\n');
    layout.text
}

/// Breaks what does not fit, outermost first.
struct Layout<'s> {
    rest: &'s str,
    text: String,
}

impl Layout<'_> {
    /// Writes up to the closing bracket of the present group, or to the end.
    fn group(&mut self, depth: usize, closing: Option<char>) {
        while let Some(next) = self.rest.chars().next() {
            if Some(next) == closing {
                return;
            }
            match next {
                '{' | '[' | '(' => self.bracket(depth, next),
                ',' => {
                    self.copy(1);
                    self.line(depth);
                    self.skip_blank();
                }
                '"' => {
                    let length = quoted(self.rest);
                    self.copy(length);
                }
                other => self.copy(other.len_utf8()),
            }
        }
    }

    fn bracket(&mut self, depth: usize, opening: char) {
        let length = matching(self.rest);
        let column = self
            .text
            .lines()
            .next_back()
            .unwrap_or_default()
            .chars()
            .count();
        let whole = self.rest.get(..length).unwrap_or_default();
        if column + whole.chars().count() <= WIDTH {
            self.copy(length);
            return;
        }
        let closing = match opening {
            '{' => '}',
            '[' => ']',
            _ => ')',
        };
        let alone = is_alone(whole);
        self.copy(1);
        if alone {
            // What wraps one thing takes no line and no indentation of its own.
            self.group(depth, Some(closing));
            self.copy(1);
            return;
        }
        self.skip_blank();
        self.line(depth + 1);
        self.group(depth + 1, Some(closing));
        let kept = self.text.trim_end().len();
        self.text.truncate(kept);
        self.line(depth);
        self.copy(1);
    }

    fn line(&mut self, depth: usize) {
        self.text.push('\n');
        self.text.extend(std::iter::repeat_n("  ", depth));
    }

    fn skip_blank(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn copy(&mut self, length: usize) {
        let (taken, rest) = self
            .rest
            .split_at_checked(length)
            .unwrap_or((self.rest, ""));
        self.text.push_str(taken);
        self.rest = rest;
    }
}

/// The length of the text up to the bracket that closes its first one.
fn matching(text: &str) -> usize {
    let mut depth = 0_usize;
    let mut at = 0;
    while let Some(next) = text.get(at..).and_then(|rest| rest.chars().next()) {
        match next {
            '{' | '[' | '(' => depth += 1,
            '}' | ']' | ')' => depth = depth.saturating_sub(1),
            '"' => {
                at += quoted(text.get(at..).unwrap_or_default());
                continue;
            }
            _ => {}
        }
        at += next.len_utf8();
        if depth == 0 {
            return at;
        }
    }
    text.len()
}

/// Whether a group in brackets holds one thing only.
fn is_alone(group: &str) -> bool {
    let mut depth = 0_usize;
    let mut at = 0;
    while let Some(next) = group.get(at..).and_then(|rest| rest.chars().next()) {
        match next {
            '{' | '[' | '(' => depth += 1,
            '}' | ']' | ')' => depth = depth.saturating_sub(1),
            ',' if depth == 1 => return false,
            '"' => {
                at += quoted(group.get(at..).unwrap_or_default());
                continue;
            }
            _ => {}
        }
        at += next.len_utf8();
    }
    true
}

/// The length of the string literal that a text begins with.
fn quoted(text: &str) -> usize {
    let mut escaped = false;
    for (at, next) in text.char_indices().skip(1) {
        match next {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return at + 1,
            _ => {}
        }
    }
    text.len()
}
