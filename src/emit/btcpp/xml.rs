//! Elements of XML, laid out.

use std::fmt::Write;

/// An element with its attributes and what stands in it.
#[derive(Clone, Debug)]
pub(super) struct Element {
    tag: String,
    attributes: Vec<(String, String)>,
    text: String,
    children: Vec<Element>,
}

impl Element {
    /// `<tag/>`
    pub fn new(tag: impl Into<String>) -> Self {
        Self {
            tag: tag.into(),
            attributes: Vec::new(),
            text: String::new(),
            children: Vec::new(),
        }
    }

    /// With a further attribute.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, value: impl ToString) -> Self {
        self.attributes.push((name.into(), value.to_string()));
        self
    }

    /// With a text, in the place of children.
    #[must_use]
    pub fn saying(mut self, text: impl Into<String>) -> Self {
        self.text = text.into();
        self
    }

    /// With these children.
    #[must_use]
    pub fn holding(mut self, children: Vec<Element>) -> Self {
        self.children = children;
        self
    }

    /// Writes the element on lines of its own, `level` steps to the right.
    pub fn write(&self, level: usize, out: &mut String) {
        let indent = "  ".repeat(level);
        // Writing to a string does not fail.
        let _ = write!(out, "{indent}<{}", self.tag);
        for (name, value) in &self.attributes {
            let _ = write!(out, " {name}=\"{}\"", escaped(value));
        }
        if !self.text.is_empty() {
            let _ = writeln!(out, ">{}</{}>", escaped(&self.text), self.tag);
        } else if self.children.is_empty() {
            out.push_str("/>\n");
        } else {
            out.push_str(">\n");
            for child in &self.children {
                child.write(level + 1, out);
            }
            let _ = writeln!(out, "{indent}</{}>", self.tag);
        }
    }
}

/// Lines as a comment; it holds no `--`.
pub(super) fn comment(lines: &[String], out: &mut String) {
    out.push_str("<!--\n");
    for line in lines {
        let mut text: String = line.chars().map(allowed).collect();
        while text.contains("--") {
            text = text.replace("--", "- -");
        }
        let _ = writeln!(out, "{}", format!("  {text}").trim_end());
    }
    out.push_str("-->\n");
}

/// A text in an attribute or between tags.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => {
                let _ = write!(out, "&#{};", u32::from(c));
            }
            c => out.push(allowed(c)),
        }
    }
    out
}

/// Characters that XML 1.0 has no way to say become U+FFFD.
fn allowed(c: char) -> char {
    match c {
        '\t' | '\n' | '\r' => c,
        '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c => c,
    }
}
