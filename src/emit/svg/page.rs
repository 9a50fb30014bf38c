//! SVG as text: elements, attributes, numbers and escaping.

use super::paint::{self, Rule};
use std::fmt::Write;

/// The value of an attribute.
pub(super) enum Value {
    Number(f64),
    Text(String),
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Value {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

/// Attributes in the order in which they are written.
pub(super) type Attributes<'a> = &'a [(&'a str, Value)];

/// What a picture is called, how large it is, and what its classes look like.
pub(super) struct Head<'a> {
    /// The class of the root, which every rule of the style begins with: pictures can stand in one page.
    pub(super) class: &'a str,
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) title: &'a str,
    /// What is to be seen, in words.
    pub(super) description: &'a str,
    pub(super) rules: &'a [Rule],
}

/// A picture in the making; an element a line.
pub(super) struct Page {
    text: String,
    open: Vec<&'static str>,
}

impl Page {
    /// A page of this size in px, with its background.
    pub(super) fn new(head: &Head) -> Self {
        let mut page = Self {
            text: String::new(),
            open: Vec::new(),
        };
        let (width, height) = (head.width, head.height);
        page.open(
            "svg",
            &[
                ("xmlns", "http://www.w3.org/2000/svg".into()),
                ("class", head.class.into()),
                ("width", width.into()),
                ("height", height.into()),
                (
                    "viewBox",
                    format!("0 0 {} {}", number(width), number(height)).into(),
                ),
                ("role", "img".into()),
            ],
        );
        page.note("title", head.title);
        page.note("desc", head.description);
        page.note("style", &paint::sheet(head.class, head.rules));
        page.leaf(
            "rect",
            &[
                ("class", "page".into()),
                ("width", width.into()),
                ("height", height.into()),
                ("rx", 6.0.into()),
            ],
        );
        page
    }

    /// Begins an element.
    pub(super) fn open(&mut self, name: &'static str, attributes: Attributes) {
        self.start(name, attributes);
        self.text.push_str(">\n");
        self.open.push(name);
    }

    /// Ends the element that was begun last.
    pub(super) fn close(&mut self) {
        if let Some(name) = self.open.pop() {
            self.indent();
            // Writing to a string does not fail.
            let _ = writeln!(self.text, "</{name}>");
        }
    }

    /// An element with nothing in it.
    pub(super) fn leaf(&mut self, name: &str, attributes: Attributes) {
        self.start(name, attributes);
        self.text.push_str("/>\n");
    }

    /// An element of text without attributes, such as a title.
    pub(super) fn note(&mut self, name: &str, text: &str) {
        self.indent();
        let _ = writeln!(self.text, "<{name}>{}</{name}>", escaped(text));
    }

    /// A line of text whose baseline is at (`x`, `y`).
    pub(super) fn text(&mut self, class: &str, x: f64, y: f64, text: &str) {
        self.start(
            "text",
            &[("class", class.into()), ("x", x.into()), ("y", y.into())],
        );
        let _ = writeln!(self.text, ">{}</text>", escaped(text));
    }

    /// A path.
    pub(super) fn path(&mut self, class: &str, d: String) {
        self.leaf("path", &[("class", class.into()), ("d", d.into())]);
    }

    /// A path from one point to another.
    pub(super) fn line(&mut self, class: &str, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) {
        let [x0, y0, x1, y1] = [x0, y0, x1, y1].map(number);
        self.path(class, format!("M{x0} {y0}L{x1} {y1}"));
    }

    /// A circle.
    pub(super) fn circle(&mut self, class: &str, [x, y]: [f64; 2], radius: f64) {
        let attributes = [
            ("class", class.into()),
            ("cx", x.into()),
            ("cy", y.into()),
            ("r", radius.into()),
        ];
        self.leaf("circle", &attributes);
    }

    /// The whole picture.
    pub(super) fn finish(mut self) -> String {
        while !self.open.is_empty() {
            self.close();
        }
        self.text
    }

    fn start(&mut self, name: &str, attributes: Attributes) {
        self.indent();
        let _ = write!(self.text, "<{name}");
        for (key, value) in attributes {
            let value = match value {
                Value::Number(value) => number(*value),
                Value::Text(text) => escaped(text),
            };
            let _ = write!(self.text, " {key}=\"{value}\"");
        }
    }

    fn indent(&mut self) {
        for _ in &self.open {
            self.text.push_str("  ");
        }
    }
}

/// A coordinate, rounded to thousandths.
pub(super) fn number(value: f64) -> String {
    let rounded = (value * 1000.0).round() / 1000.0;
    if rounded.is_finite() && rounded != 0.0 {
        format!("{rounded}")
    } else {
        // Also −0, which would be written with its sign.
        "0".to_owned()
    }
}

/// Points as the corners of a path: `M` to the first, `L` to the others.
pub(super) fn chain(points: impl IntoIterator<Item = [f64; 2]>) -> String {
    let mut d = String::new();
    for (i, [x, y]) in points.into_iter().enumerate() {
        let step = if i == 0 { 'M' } else { 'L' };
        let _ = write!(d, "{step}{} {}", number(x), number(y));
    }
    d
}

/// Text between tags and in quotes; what XML cannot hold becomes �.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' => out.push(c),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            _ => out.push(c),
        }
    }
    out
}

/// The width in px of a name in the fixed-width font, in which wide characters count double.
pub(super) fn width(name: &str) -> f64 {
    let cells = |c: char| match c {
        '\u{1100}'..='\u{115f}' | '\u{2e80}'..='\u{a4cf}' | '\u{ac00}'..='\u{d7a3}' => 2,
        '\u{f900}'..='\u{faff}' | '\u{fe30}'..='\u{fe6f}' | '\u{ff00}'..='\u{ff60}' => 2,
        '\u{1f000}'..='\u{3ffff}' => 2,
        _ => 1,
    };
    let cells: u32 = name.chars().map(cells).sum();
    f64::from(cells) * paint::CELL
}
