//! Axes, grid and numbers of a chart.

use super::page::{self, Page};
use super::paint::{Rule, rule};
use super::scale::Axis;

/// The left and right ends of the horizontal axis, in px.
pub const LEFT: f64 = 64.0;
/// See [`LEFT`].
pub const RIGHT: f64 = 696.0;

/// How the grid looks, and the axes.
pub const GRID: Rule = rule("grid", "stroke:#e3e8ec", "stroke:#222b34");
/// See [`GRID`].
pub const AXIS: Rule = rule("axis", "fill:none;stroke:#8496a3", "stroke:#5f6f7b");

/// In the middle of a pixel.
pub fn crisp(at: f64) -> f64 {
    at.floor() + 0.5
}

/// The least and the greatest number of these intervals.
pub fn ends(intervals: impl Iterator<Item = [f64; 2]>) -> Option<[f64; 2]> {
    intervals.reduce(|[low, high], [l, h]| [low.min(l), high.max(h)])
}

/// A line at each mark of the vertical axis, with its number on the left.
pub fn rows(page: &mut Page, y: &Axis) {
    for (at, label) in y.marks() {
        page.line("grid", [LEFT, crisp(at)], [RIGHT, crisp(at)]);
        page.text("remark end", LEFT - 8.0, at + 4.0, &label);
    }
}

/// The numbers below the horizontal axis, and what they are.
pub fn numbers(page: &mut Page, x: &Axis, foot: f64, unit: &str) {
    for (at, label) in x.marks() {
        page.text("remark middle", at, foot + 18.0, &label);
    }
    page.text("remark middle", (LEFT + RIGHT) / 2.0, foot + 36.0, unit);
}

/// Both axes of a panel.
pub fn axes(page: &mut Page, [top, foot]: [f64; 2]) {
    let [left, foot] = [LEFT, foot].map(crisp);
    page.path(
        "axis",
        page::chain([[left, top], [left, foot], [RIGHT, foot]]),
    );
}
