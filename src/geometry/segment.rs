//! Thin walls.

use super::vector::{Point, along, cross, dot, limit, minus};

/// A segment from `start` along `along`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Where it starts.
    pub start: Point,
    /// The vector to its end.
    pub along: Point,
    /// 1 / |along|²; 0 for a segment that is a point.
    inverse: f64,
}

impl Segment {
    /// The segment between two points.
    pub fn new(start: Point, end: Point) -> Self {
        let along = minus(end, start);
        let square = dot(along, along);
        let inverse = if square > 0.0 { 1.0 / square } else { 0.0 };
        Self {
            start,
            along,
            inverse,
        }
    }

    /// Where it ends.
    pub fn end(&self) -> Point {
        along(self.start, 1.0, self.along)
    }

    /// The vector from `p` to the nearest point.
    #[inline(always)]
    pub fn nearest(&self, p: Point) -> Point {
        let start = minus(self.start, p);
        let t = limit(-dot(start, self.along) * self.inverse, 0.0, 1.0);
        along(start, t, self.along)
    }

    /// The vector from `p` to the nearest point within a sector of at most half a turn, counter-clockwise from the
    /// direction `right` to the direction `left` (which is `−right` where it is half a turn).
    #[inline]
    pub fn nearest_within(&self, p: Point, right: Point, left: Point) -> Option<Point> {
        let start = minus(self.start, p);
        let (mut low, mut high) = (0.0, 1.0);
        // A point q is in the sector where right × q ≥ 0 and q × left ≥ 0; both are linear along the segment.
        for (at, slope) in [
            (cross(right, start), cross(right, self.along)),
            (cross(start, left), cross(self.along, left)),
        ] {
            if slope > 0.0 {
                let t = -at / slope;
                low = if t > low { t } else { low };
            } else if slope < 0.0 {
                let t = -at / slope;
                high = if t < high { t } else { high };
            } else if at < 0.0 {
                return None;
            }
        }
        if low > high {
            return None;
        }
        let t = limit(-dot(start, self.along) * self.inverse, low, high);
        Some(along(start, t, self.along))
    }

    /// How far a ray from `p` in the direction of the unit vector `u` goes before it meets the segment; infinite if it
    /// never does.
    #[inline(always)]
    pub fn ray(&self, p: Point, u: Point) -> f64 {
        let start = minus(self.start, p);
        let across = cross(u, self.along);
        // p + s u = start + t along, solved by Cramer's rule.
        let s = cross(start, self.along) / across;
        let t = cross(start, u);
        if across != 0.0 {
            // All at once: which of them fails cannot be foreseen. That t is from 0 to 1 needs no division.
            match (s >= 0.0) & (t * across >= 0.0) & (t.abs() <= across.abs()) {
                true => s,
                false => f64::INFINITY,
            }
        } else if cross(u, start) == 0.0 {
            // Along the same line: the nearer end ahead, or 0 from within.
            let a = dot(start, u);
            let b = a + dot(self.along, u);
            match (a.min(b), a.max(b)) {
                (_, far) if far < 0.0 => f64::INFINITY,
                (near, _) => near.max(0.0),
            }
        } else {
            f64::INFINITY
        }
    }

    /// Whether the segment from `p` to `q` meets it.
    #[inline(always)]
    pub fn meets(&self, p: Point, q: Point) -> bool {
        let sight = minus(q, p);
        let start = minus(self.start, p);
        let a = cross(sight, start);
        let b = a + cross(sight, self.along);
        if a * b > 0.0 {
            return false;
        }
        let c = cross(start, self.along);
        let d = c - cross(sight, self.along);
        if c * d > 0.0 {
            return false;
        }
        if a == 0.0 && b == 0.0 {
            // On one line: they meet where their extents do.
            let (s, e) = (
                dot(start, sight),
                dot(start, sight) + dot(self.along, sight),
            );
            let length = dot(sight, sight);
            return s.max(e) >= 0.0 && s.min(e) <= length && (length > 0.0 || self.holds(p));
        }
        true
    }

    /// Whether a point is on the segment.
    fn holds(&self, p: Point) -> bool {
        self.nearest(p) == [0.0, 0.0]
    }

    /// The square of the least distance to the segment from `p` to `p + step`.
    pub fn gap_square(&self, p: Point, step: Point) -> f64 {
        let q = along(p, 1.0, step);
        if self.meets(p, q) {
            return 0.0;
        }
        let square = |v: Point| dot(v, v);
        let path = Segment::new(p, q);
        square(self.nearest(p))
            .min(square(self.nearest(q)))
            .min(square(path.nearest(self.start)))
            .min(square(path.nearest(self.end())))
    }
}
