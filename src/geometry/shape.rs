//! The shapes of the language.

use super::circle::Circle;
use super::polygon::{centroid, edges, middle, parts};
use super::segment::Segment;
use super::vector::{Point, cross, dot, minus};

/// A shape of the plane.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A disc.
    Disc {
        /// The centre.
        center: Point,
        /// The radius.
        radius: f64,
    },
    /// An axis-parallel rectangle.
    Rect {
        /// The corner of the least coordinates.
        min: Point,
        /// The corner of the greatest coordinates.
        max: Point,
    },
    /// A simple polygon, counter-clockwise.
    Polygon(Vec<Point>),
    /// A chain of thin segments; a line is a chain of one.
    Polyline(Vec<Point>),
}

impl Shape {
    /// The point that `distance` and `direction` of a place measure to: the centre of a disc or a rectangle, the
    /// centroid of a polygon (by area), the middle of a polyline (by length).
    pub fn center(&self) -> Point {
        match self {
            Shape::Disc { center, .. } => *center,
            Shape::Rect {
                min: [x0, y0],
                max: [x1, y1],
            } => [(x0 + x1) / 2.0, (y0 + y1) / 2.0],
            Shape::Polygon(corners) => centroid(corners),
            Shape::Polyline(points) => middle(points),
        }
    }

    /// The corners of a rectangle or a polygon, the points of a polyline, in the order of the outline; a disc has none.
    pub fn corners(&self) -> Vec<Point> {
        match self {
            Shape::Rect {
                min: [x0, y0],
                max: [x1, y1],
            } => vec![[*x0, *y0], [*x1, *y0], [*x1, *y1], [*x0, *y1]],
            Shape::Polygon(points) | Shape::Polyline(points) => points.clone(),
            Shape::Disc { .. } => Vec::new(),
        }
    }

    /// The thin segments of its outline; a disc has none.
    pub fn outline(&self) -> Vec<Segment> {
        let corners = self.corners();
        let segment = |(a, b)| Segment::new(a, b);
        match self {
            Shape::Polyline(_) => parts(&corners).map(segment).collect(),
            _ => edges(&corners).map(segment).collect(),
        }
    }

    /// The rim of a disc.
    pub fn rim(&self) -> Option<Circle> {
        match *self {
            Shape::Disc { center, radius } => Some(Circle { center, radius }),
            _ => None,
        }
    }

    /// Whether it has no inward corner. A polyline is no area, so it is not convex.
    pub fn is_convex(&self) -> bool {
        match self {
            Shape::Disc { .. } | Shape::Rect { .. } => true,
            Shape::Polyline(_) => false,
            Shape::Polygon(_) => {
                let outline = self.outline();
                let next = outline.iter().cycle().skip(1);
                let mut turns = outline
                    .iter()
                    .zip(next)
                    .map(|(a, b)| cross(a.along, b.along));
                turns.clone().all(|turn| turn >= 0.0) || turns.all(|turn| turn <= 0.0)
            }
        }
    }

    /// Whether a point is in it, its rim included. Nothing is in a polyline.
    pub fn contains(&self, p: Point) -> bool {
        match self {
            Shape::Disc { center, radius } => {
                let from = minus(p, *center);
                dot(from, from) <= radius * radius
            }
            Shape::Rect { min, max } => {
                (min[0]..=max[0]).contains(&p[0]) && (min[1]..=max[1]).contains(&p[1])
            }
            // The ray to the right crosses the outline an odd number of times.
            Shape::Polygon(corners) => {
                let crossed = edges(corners).filter(|(a, b)| {
                    (a[1] > p[1]) != (b[1] > p[1])
                        && p[0] < a[0] + (p[1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
                });
                crossed.count() % 2 == 1
            }
            Shape::Polyline(_) => false,
        }
    }
}
