//! What the shapes of the language are made of.

use super::circle::Circle;
use super::segment::{Segment, cross, minus};
use crate::ir::world::{Point, Shape};

/// The thin segments of a shape's outline; a disc has none.
pub(super) fn outline(shape: &Shape) -> Vec<Segment> {
    match shape {
        Shape::Disc { .. } => Vec::new(),
        Shape::Rect { .. } | Shape::Polygon(_) => {
            let corners = corners(shape);
            let next = corners.iter().cycle().skip(1);
            corners
                .iter()
                .zip(next)
                .map(|(&a, &b)| Segment::new(a, b))
                .collect()
        }
        Shape::Polyline(points) => points
            .iter()
            .zip(points.iter().skip(1))
            .map(|(&a, &b)| Segment::new(a, b))
            .collect(),
    }
}

/// The rim of a disc.
pub(super) fn rim(shape: &Shape) -> Option<Circle> {
    match *shape {
        Shape::Disc { center, radius } => Some(Circle { center, radius }),
        _ => None,
    }
}

/// The corners of a rectangle or a polygon, in the order of the outline.
pub(super) fn corners(shape: &Shape) -> Vec<Point> {
    match shape {
        Shape::Rect {
            min: [x0, y0],
            max: [x1, y1],
        } => vec![[*x0, *y0], [*x1, *y0], [*x1, *y1], [*x0, *y1]],
        Shape::Polygon(points) | Shape::Polyline(points) => points.clone(),
        Shape::Disc { .. } => Vec::new(),
    }
}

/// Whether a shape has no inward corner. A polyline is no area, so it is not.
pub(super) fn is_convex(shape: &Shape) -> bool {
    match shape {
        Shape::Disc { .. } | Shape::Rect { .. } => true,
        Shape::Polyline(_) => false,
        Shape::Polygon(_) => {
            let outline = outline(shape);
            let turns = || {
                outline
                    .iter()
                    .zip(outline.iter().cycle().skip(1))
                    .map(|(a, b)| cross(a.along, b.along))
            };
            turns().all(|turn| turn >= 0.0) || turns().all(|turn| turn <= 0.0)
        }
    }
}

/// Whether a point is in a shape. Nothing is in a polyline.
pub(super) fn contains(shape: &Shape, p: Point) -> bool {
    match shape {
        Shape::Disc { center, radius } => {
            let [x, y] = minus(p, *center);
            x * x + y * y <= radius * radius
        }
        Shape::Rect { min, max } => {
            (min[0]..=max[0]).contains(&p[0]) && (min[1]..=max[1]).contains(&p[1])
        }
        // The ray to the right crosses the outline an odd number of times.
        Shape::Polygon(_) => {
            outline(shape)
                .iter()
                .filter(|edge| {
                    let (a, b) = (edge.start, edge.end());
                    (a[1] > p[1]) != (b[1] > p[1])
                        && p[0] < a[0] + (p[1] - a[1]) * edge.along[0] / edge.along[1]
                })
                .count()
                % 2
                == 1
        }
        Shape::Polyline(_) => false,
    }
}

/// The corners of the smallest axis-parallel rectangle around a shape.
pub(super) fn bounds(shape: &Shape) -> (Point, Point) {
    match shape {
        Shape::Disc {
            center: [x, y],
            radius: r,
        } => ([x - r, y - r], [x + r, y + r]),
        _ => corners(shape).iter().fold(
            ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]),
            |(low, high), p| {
                (
                    [low[0].min(p[0]), low[1].min(p[1])],
                    [high[0].max(p[0]), high[1].max(p[1])],
                )
            },
        ),
    }
}
