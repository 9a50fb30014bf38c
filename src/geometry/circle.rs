//! Round walls: the rim of a disc, seen from outside or, for a round arena, from inside.

use super::segment::Segment;
use super::vector::{Point, along, cross, dot, minus};

/// A circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    /// The centre.
    pub center: Point,
    /// The radius.
    pub radius: f64,
}

impl Circle {
    /// The vector from `p` to the nearest point of the rim; from the centre, along the x axis.
    #[inline]
    pub fn nearest(&self, p: Point) -> Point {
        let to = minus(self.center, p);
        let distance = dot(to, to).sqrt();
        if distance == 0.0 {
            return [self.radius, 0.0];
        }
        let scale = (distance - self.radius) / distance;
        [to[0] * scale, to[1] * scale]
    }

    /// The vector from `p` to the nearest point of the rim within a sector of at most half a turn, counter-clockwise
    /// from the direction of the unit vector `right` to that of `left`.
    pub fn nearest_within(&self, p: Point, right: Point, left: Point) -> Option<Point> {
        let inside = |v: Point| cross(right, v) >= 0.0 && cross(v, left) >= 0.0;
        let nearest = self.nearest(p);
        if inside(nearest) {
            return Some(nearest);
        }
        // The distance grows with the angle from the nearest point, so it is least on an edge of the sector.
        let edge = |u: Point| Some(self.ray(p, u)).filter(|s| s.is_finite());
        match (edge(right), edge(left)) {
            (Some(a), Some(b)) if b < a => Some(along([0.0; 2], b, left)),
            (Some(a), _) => Some(along([0.0; 2], a, right)),
            (None, Some(b)) => Some(along([0.0; 2], b, left)),
            (None, None) => None,
        }
    }

    /// How far a ray from `p` in the direction of the unit vector `u` goes before it meets the rim; infinite if it never
    /// does.
    #[inline]
    pub fn ray(&self, p: Point, u: Point) -> f64 {
        let to = minus(self.center, p);
        let ahead = dot(to, u);
        let side = cross(to, u);
        let half = self.radius * self.radius - side * side;
        if half < 0.0 {
            return f64::INFINITY;
        }
        let half = half.sqrt();
        if ahead - half >= 0.0 {
            ahead - half
        } else if ahead + half >= 0.0 {
            ahead + half
        } else {
            f64::INFINITY
        }
    }

    /// Whether the segment from `p` to `q` meets the disc.
    #[inline]
    pub fn meets(&self, p: Point, q: Point) -> bool {
        let nearest = Segment::new(p, q).nearest(self.center);
        dot(nearest, nearest) <= self.radius * self.radius
    }

    /// Whether the segment from `p` to `q` meets the disc, and how far `p` may go in any direction before that can change:
    /// the distance of the centre from the way changes by no more than `p` goes.
    pub fn meets_while(&self, p: Point, q: Point) -> (bool, f64) {
        let length = |v: Point| dot(v, v).sqrt();
        let nearest = Segment::new(p, q).nearest(self.center);
        let size = length(minus(q, p)) + length(minus(self.center, p)) + self.radius;
        let reach = (length(nearest) - self.radius).abs() - 1e-12 * size;
        (self.meets(p, q), if reach > 0.0 { reach } else { 0.0 })
    }

    /// The square of the least distance from the centre to the segment from `p` to `p + step`.
    pub fn center_gap_square(&self, p: Point, step: Point) -> f64 {
        let nearest = Segment::new(p, along(p, 1.0, step)).nearest(self.center);
        dot(nearest, nearest)
    }
}
