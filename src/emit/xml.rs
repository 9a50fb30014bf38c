//! XML as text: an element a line, two blanks a level.

use std::fmt::Write;

/// A document in the making.
#[derive(Clone, Debug, Default)]
pub(super) struct Xml {
    text: String,
    /// The elements that are open, from the root.
    open: Vec<&'static str>,
}

impl Xml {
    /// Begins an element.
    pub fn open(&mut self, tag: &'static str, attributes: &[(&str, String)]) {
        self.tag(tag, attributes);
        self.text.push_str(">\n");
        self.open.push(tag);
    }

    /// Ends the element that was begun last.
    pub fn close(&mut self) {
        if let Some(tag) = self.open.pop() {
            self.line(&format!("</{tag}>"));
        }
    }

    /// An element with nothing in it.
    pub fn leaf(&mut self, tag: &str, attributes: &[(&str, String)]) {
        self.tag(tag, attributes);
        self.text.push_str("/>\n");
    }

    /// An element with a text in it.
    pub fn text(&mut self, tag: &str, attributes: &[(&str, String)], text: &str) {
        self.tag(tag, attributes);
        // Writing to a string does not fail.
        let _ = writeln!(self.text, ">{}</{tag}>", escaped(text));
    }

    /// Lines as a comment; what would end it is set apart.
    pub fn comment(&mut self, lines: &[String]) {
        self.line("<!--");
        for line in lines {
            let mut text: String = line.chars().map(allowed).collect();
            while text.contains("--") {
                text = text.replace("--", "- -");
            }
            self.line(format!("  {text}").trim_end());
        }
        self.line("-->");
    }

    /// A line as it is.
    pub fn line(&mut self, line: &str) {
        self.indent();
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// The document, every element ended.
    pub fn finish(mut self) -> String {
        while !self.open.is_empty() {
            self.close();
        }
        self.text
    }

    /// A tag up to its end.
    fn tag(&mut self, tag: &str, attributes: &[(&str, String)]) {
        self.indent();
        let _ = write!(self.text, "<{tag}");
        for (name, value) in attributes {
            let value = escaped(value);
            // A reader takes these for blanks in an attribute.
            let value = value.replace('\t', "&#9;").replace('\n', "&#10;");
            let _ = write!(self.text, " {name}=\"{value}\"");
        }
    }

    fn indent(&mut self) {
        for _ in &self.open {
            self.text.push_str("  ");
        }
    }
}

/// A text between tags or in quotes.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // A reader takes it for a newline.
            '\r' => out.push_str("&#13;"),
            c => out.push(allowed(c)),
        }
    }
    out
}

/// What XML 1.0 has no way to say becomes U+FFFD.
fn allowed(c: char) -> char {
    match c {
        '\t' | '\n' | '\r' => c,
        '\0'..='\x1f' | '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c => c,
    }
}
