//! The legend beside a world, and the signs that it explains.

use super::page::{self, Page};
use super::view;
use crate::geometry::Point;

/// The height of a line.
const LINE: f64 = 20.0;
/// Above a heading.
const GAP: f64 = 14.0;
/// Between the signs and the names.
const INDENT: f64 = 30.0;

/// A sign with what it stands for.
pub(super) struct Entry {
    pub(super) sign: Sign,
    pub(super) name: String,
}

/// What is drawn.
pub(super) enum Sign {
    /// A line of these classes.
    Line(String),
    /// The mark of the `i`-th event.
    Mark(usize),
    /// A robot of this class.
    Robot(&'static str),
    /// What sensors cover.
    Sector,
}

/// Entries under headings.
pub(super) struct Legend(pub(super) Vec<(&'static str, Vec<Entry>)>);

impl Legend {
    /// Its width in px; 0 if it is empty.
    pub(super) fn width(&self) -> f64 {
        let entries = self.0.iter().flat_map(|(_, entries)| entries);
        entries
            .map(|entry| INDENT + page::width(&entry.name))
            .fold(0.0, f64::max)
            .ceil()
    }

    /// Its height in px.
    pub(super) fn height(&self) -> f64 {
        let groups = self.groups();
        groups
            .map(|(_, entries)| GAP + LINE * (1 + entries.len()) as f64)
            .sum::<f64>()
            - GAP
    }

    /// Draws it with its upper left corner at (`x`, `y`).
    pub(super) fn draw(&self, [x, y]: Point, page: &mut Page) {
        let mut y = y;
        for (heading, entries) in self.groups() {
            page.text("remark", x, y + 11.0, heading);
            y += LINE;
            for entry in entries {
                let middle = y + LINE / 2.0 - 2.0;
                entry.sign.draw([x + 10.0, middle], page);
                page.text("name", x + INDENT, middle + 4.0, &entry.name);
                y += LINE;
            }
            y += GAP;
        }
    }

    fn groups(&self) -> impl Iterator<Item = (&'static str, &[Entry])> {
        let groups = self
            .0
            .iter()
            .map(|(heading, entries)| (*heading, entries.as_slice()));
        groups.filter(|(_, entries)| !entries.is_empty())
    }
}

impl Sign {
    fn draw(&self, [x, y]: Point, page: &mut Page) {
        match self {
            Sign::Line(class) => {
                page.line(&format!("swatch {class}"), [x - 9.0, y], [x + 9.0, y]);
            }
            Sign::Mark(i) => mark(*i, [x, y], page),
            Sign::Robot(class) => robot(class, [x, y], [1.0, 0.0], 7.0, page),
            Sign::Sector => page.path("sector", view::sector([x - 8.0, y], 16.0, -0.5, 0.5)),
        }
    }
}

/// A robot that looks along a unit vector of the page.
pub(super) fn robot(class: &str, [x, y]: Point, ahead: Point, radius: f64, page: &mut Page) {
    page.circle(class, [x, y], radius);
    let nose = [x + radius * ahead[0], y + radius * ahead[1]];
    page.line("nose", [x, y], nose);
}

/// How many marks differ by their outline.
const OUTLINES: usize = 6;

/// The mark of the `i`-th event: an outline; those that have one in common with an earlier mark have smaller ones inside.
pub(super) fn mark(i: usize, [x, y]: Point, page: &mut Page) {
    let corners: &[Point] = match i % OUTLINES {
        0 => &[[0.0, -5.5], [5.0, 4.0], [-5.0, 4.0]],
        1 => &[[0.0, 5.5], [5.0, -4.0], [-5.0, -4.0]],
        2 => &[[-4.0, -4.0], [4.0, -4.0], [4.0, 4.0], [-4.0, 4.0]],
        3 => &[
            [-4.5, -4.5],
            [0.0, -1.5],
            [4.5, -4.5],
            [1.5, 0.0],
            [4.5, 4.5],
            [0.0, 1.5],
            [-4.5, 4.5],
            [-1.5, 0.0],
        ],
        4 => &[[0.0, -5.5], [5.5, 0.0], [0.0, 5.5], [-5.5, 0.0]],
        _ => &[
            [-2.5, -4.5],
            [2.5, -4.5],
            [5.0, 0.0],
            [2.5, 4.5],
            [-2.5, 4.5],
            [-5.0, 0.0],
        ],
    };
    let all = i / OUTLINES + 1;
    for inside in 0..all {
        let scale = (all - inside) as f64 / all as f64;
        let corners = corners
            .iter()
            .map(|[dx, dy]| [x + scale * dx, y + scale * dy]);
        page.path("mark", page::chain(corners) + "Z");
    }
}
