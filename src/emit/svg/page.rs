//! SVG: what pictures are made of, in numbers of px.

use super::paint::{self, Rule};
use crate::emit::xml::Xml;
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
pub(super) struct Page(Xml);

impl Page {
    /// A page of this size in px, with its background.
    pub(super) fn new(head: &Head) -> Self {
        let mut page = Self(Xml::default());
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
        self.0.open(name, &shown(attributes));
    }

    /// Ends the element that was begun last.
    pub(super) fn close(&mut self) {
        self.0.close();
    }

    /// An element with nothing in it.
    pub(super) fn leaf(&mut self, name: &str, attributes: Attributes) {
        self.0.leaf(name, &shown(attributes));
    }

    /// An element of text without attributes, such as a title.
    pub(super) fn note(&mut self, name: &str, text: &str) {
        self.0.text(name, &[], text);
    }

    /// A line of text whose baseline is at (`x`, `y`).
    pub(super) fn text(&mut self, class: &str, x: f64, y: f64, text: &str) {
        let place = [("class", class.into()), ("x", x.into()), ("y", y.into())];
        self.0.text("text", &shown(&place), text);
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
    pub(super) fn finish(self) -> String {
        self.0.finish()
    }
}

fn shown<'a>(attributes: Attributes<'a>) -> Vec<(&'a str, String)> {
    let shown = attributes.iter().map(|(name, value)| match value {
        Value::Number(value) => (*name, number(*value)),
        Value::Text(text) => (*name, text.clone()),
    });
    shown.collect()
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
