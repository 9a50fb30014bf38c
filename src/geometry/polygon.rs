//! Closed and open chains of points.

use super::vector::{Point, along, cross, minus};
use crate::math;
use parry2d_f64::utils::segments_intersection2d;

/// The edges of a closed chain, the last back to its first corner.
pub(super) fn edges(corners: &[Point]) -> impl Iterator<Item = (Point, Point)> + Clone + '_ {
    let next = corners.iter().cycle().skip(1);
    corners.iter().copied().zip(next.copied())
}

/// The parts of an open chain.
pub(super) fn parts(points: &[Point]) -> impl Iterator<Item = (Point, Point)> + Clone + '_ {
    let next = points.iter().skip(1);
    points.iter().copied().zip(next.copied())
}

/// Twice the signed area of a polygon (the shoelace formula); positive where the corners go round counter-clockwise.
pub fn doubled_area(corners: &[Point]) -> f64 {
    edges(corners).map(|(a, b)| cross(a, b)).sum()
}

/// Whether two edges of a polygon that are not neighbours meet.
pub fn crosses_itself(corners: &[Point]) -> bool {
    let edges: Vec<(Point, Point)> = edges(corners).collect();
    let n = edges.len();
    edges.iter().enumerate().any(|(i, &first)| {
        let others = edges.iter().enumerate().skip(i + 2);
        others
            .filter(|(j, _)| (j + 1) % n != i)
            .any(|(_, &second)| meet(first, second))
    })
}

/// Whether two segments have a point in common.
fn meet((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    segments_intersection2d(a.into(), b.into(), c.into(), d.into(), f64::EPSILON).is_some()
}

/// The centroid of a polygon by area; the mean of the corners where the area vanishes.
pub(super) fn centroid(corners: &[Point]) -> Point {
    let (mut area, mut sum) = (0.0, [0.0; 2]);
    for (a, b) in edges(corners) {
        let part = cross(a, b);
        area += part;
        sum = along(sum, part, along(a, 1.0, b));
    }
    let weight = if area == 0.0 {
        sum = corners.iter().fold([0.0; 2], |sum, p| along(sum, 1.0, *p));
        corners.len().max(1) as f64
    } else {
        3.0 * area
    };
    [sum[0] / weight, sum[1] / weight]
}

/// The point halfway along an open chain.
pub(super) fn middle(points: &[Point]) -> Point {
    let length = |a: Point, b: Point| {
        let [x, y] = minus(b, a);
        math::hypot(x, y)
    };
    let mut left = parts(points).map(|(a, b)| length(a, b)).sum::<f64>() / 2.0;
    for (a, b) in parts(points) {
        let part = length(a, b);
        if left <= part && part > 0.0 {
            return along(a, left / part, minus(b, a));
        }
        left -= part;
    }
    points.first().copied().unwrap_or_default()
}
