//! How the plane of a world lies on the page.

use super::page::{chain, number};
use crate::geometry::{Point, Shape};
use crate::math;
use std::f64::consts::{PI, TAU};

/// To scale, with y up in the world and down on the page.
pub(super) struct View {
    /// The upper left corner of the arena in metres.
    corner: Point,
    /// The same corner in px.
    origin: Point,
    /// The scale in px/m.
    pub(super) scale: f64,
    /// The size of the arena in px.
    pub(super) size: Point,
}

impl View {
    /// The largest picture of an arena that fits in a size, with its corner at a point; all in px.
    pub(super) fn new(arena: &Shape, origin: Point, largest: Point) -> Self {
        let (low, high) = arena.bounds();
        let metres = [high[0] - low[0], high[1] - low[1]].map(|length| length.max(1e-9));
        let scale = (largest[0] / metres[0]).min(largest[1] / metres[1]);
        Self {
            corner: [low[0], high[1]],
            origin,
            scale,
            size: metres.map(|length| (length * scale).round()),
        }
    }

    /// Where a point lies.
    pub(super) fn at(&self, [x, y]: Point) -> Point {
        [
            self.origin[0] + (x - self.corner[0]) * self.scale,
            self.origin[1] + (self.corner[1] - y) * self.scale,
        ]
    }

    /// A shape as a path, closed unless it is a chain of lines.
    pub(super) fn outline(&self, shape: &Shape) -> String {
        match shape {
            Shape::Disc { center, radius } => {
                sector(self.at(*center), radius * self.scale, 0.0, TAU)
            }
            Shape::Rect { .. } | Shape::Polygon(_) => {
                chain(shape.corners().into_iter().map(|p| self.at(p))) + "Z"
            }
            Shape::Polyline(points) => chain(points.iter().map(|p| self.at(*p))),
        }
    }
}

/// The unit vector of the page that a heading of the world points along.
pub(super) fn along(heading: f64) -> Point {
    let (sin, cos) = math::sin_cos(heading);
    [cos, -sin]
}

/// The sector between two headings of the world, from the right to the left; from a full turn on, the whole disc.
pub(super) fn sector([x, y]: Point, radius: f64, from: f64, to: f64) -> String {
    let rim = |heading: f64| {
        let [dx, dy] = along(heading);
        [x + radius * dx, y + radius * dy]
    };
    let arc = |large: u8, end: Point| {
        let [radius, x, y] = [radius, end[0], end[1]].map(number);
        format!("A{radius} {radius} 0 {large} 0 {x} {y}")
    };
    if to - from >= TAU - 1e-9 {
        return chain([rim(from)]) + &arc(0, rim(from + PI)) + &arc(0, rim(from)) + "Z";
    }
    chain([[x, y], rim(from)]) + &arc(u8::from(to - from > PI), rim(to)) + "Z"
}
