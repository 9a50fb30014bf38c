//! Expressions of Python, laid out as the formatter black lays them out.

/// The longest line.
pub(super) const WIDTH: usize = 88;

/// An expression.
#[derive(Clone, Debug)]
pub(super) enum Code {
    /// A text on one line.
    Plain(String),
    /// What stands before a bracket and inside it: a call, a list.
    Bracket(String, char, Vec<Code>),
}

impl Code {
    /// `name(arguments)`
    pub fn call(name: &str, arguments: Vec<Code>) -> Self {
        Self::Bracket(format!("{name}("), ')', arguments)
    }

    /// `name=[entries]`
    pub fn list(name: &str, entries: Vec<Code>) -> Self {
        Self::Bracket(format!("{name}=["), ']', entries)
    }

    /// The same after `head`.
    #[must_use]
    pub fn after(self, head: &str) -> Self {
        match self {
            Code::Plain(text) => Code::Plain(format!("{head}{text}")),
            Code::Bracket(open, close, inner) => {
                Code::Bracket(format!("{head}{open}"), close, inner)
            }
        }
    }

    /// On one line.
    fn flat(&self) -> String {
        match self {
            Code::Plain(text) => text.clone(),
            Code::Bracket(open, close, inner) => format!("{open}{}{close}", joined(inner)),
        }
    }

    /// Writes the expression and `tail`, beginning at this column: on one line, or what is inside the brackets on a
    /// line, or each part of it on lines of its own.
    pub fn write(&self, column: usize, tail: &str, out: &mut String) {
        let indent = " ".repeat(column);
        let flat = self.flat();
        let fits = |text: &str, column: usize| column + text.chars().count() <= WIDTH;
        match self {
            Code::Bracket(open, close, inner) if !fits(&format!("{flat}{tail}"), column) => {
                out.push_str(&format!("{indent}{open}\n"));
                let body = joined(inner);
                if fits(&body, column + 4) {
                    out.push_str(&format!("{indent}    {body}\n"));
                } else {
                    for part in inner {
                        part.write(column + 4, ",", out);
                    }
                }
                out.push_str(&format!("{indent}{close}{tail}\n"));
            }
            _ => out.push_str(&format!("{indent}{flat}{tail}\n")),
        }
    }
}

fn joined(parts: &[Code]) -> String {
    let parts: Vec<String> = parts.iter().map(Code::flat).collect();
    parts.join(", ")
}

/// A string of Python.
pub(super) fn string(text: &str) -> Code {
    Code::Plain(quoted(text))
}

/// A text in double quotes, or in single ones if that saves escapes.
pub(super) fn quoted(text: &str) -> String {
    let quote = match text.contains('"') && !text.contains('\'') {
        true => '\'',
        false => '"',
    };
    let mut out = String::from(quote);
    for c in text.chars() {
        match c {
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            '\r' => out.push_str("\\r"),
            c if c == '\\' || c == quote => out.extend(['\\', c]),
            c if c.is_control() => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push(quote);
    out
}

/// A text in lines of that many characters, broken at blanks.
pub(super) fn wrapped(text: &str, width: usize) -> String {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ') {
        match lines.last_mut() {
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines.join("\n")
}
