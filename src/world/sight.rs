//! Lines of sight to a fixed point, and how far the robot may go before one of them can change.
//!
//! Each straight wall throws a shadow from the point. What is seen changes only where the robot crosses the rim of a shadow:
//! the wall itself, which the centre of a robot never reaches, and the two half-lines from the wall's ends away from the point.

use crate::geometry::{Point, Segment, cross, dot, minus};

/// The shadow that a segment throws from a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shadow {
    segment: Segment,
    /// The ends of the segment, each with the unit vector away from the point.
    rim: [(Point, Point); 2],
    /// How near the rim rounding may decide; infinite where the shadow is so thin that it may do so anywhere.
    hair: f64,
}

impl Shadow {
    /// The shadow from `q`. The centre of the robot is never nearer to the segment than `kept`, and nowhere in its world farther
    /// from anything than `size`.
    pub(super) fn new(segment: Segment, q: Point, kept: f64, size: f64) -> Self {
        let length = |v: Point| dot(v, v).sqrt();
        let ends = [segment.start, segment.end()];
        let [to_start, to_end] = ends.map(|end| minus(end, q));
        let lengths = [to_start, to_end, segment.along].map(length);
        let [near, far] =
            [f64::min, f64::max].map(|pick| lengths.into_iter().fold(lengths[0], pick));
        // An area has the sign that was computed unless it is smaller than rounding of the products in it, which are no
        // greater than the square of `size + far`. What lines of the rim that meet at a small angle make of it is in the
        // factor.
        let hair = 1e-9 * (size + far) * (size + far) / near;
        let thin = cross(to_start, segment.along).abs() < 1e-3 * far * lengths[2];
        let sure = near > 0.0 && !thin && hair < kept;
        let unit = |v: Point, length: f64| [v[0] / length, v[1] / length];
        Self {
            segment,
            rim: [
                (ends[0], unit(to_start, lengths[0])),
                (ends[1], unit(to_end, lengths[1])),
            ],
            hair: if sure { hair } else { f64::INFINITY },
        }
    }

    /// Whether the segment is between `p` and the point.
    #[inline(always)]
    pub(super) fn hides(&self, p: Point, q: Point) -> bool {
        self.segment.meets(p, q)
    }

    /// How far `p` may go in any direction, at least, before that can change; not positive where that is not known.
    #[inline(always)]
    pub(super) fn reach(&self, p: Point) -> f64 {
        let beside = |(end, away): (Point, Point)| {
            let from = minus(p, end);
            match dot(from, away) >= 0.0 {
                true => cross(away, from).abs(),
                // The end is at least so far away.
                false => from[0].abs().max(from[1].abs()),
            }
        };
        let [start, end] = self.rim.map(beside);
        start.min(end) - self.hair
    }
}

/// What stands around a point.
#[derive(Clone, Debug)]
pub(super) struct Sight {
    point: Point,
    shadows: Box<[Shadow]>,
}

impl Sight {
    /// The sight of a point among segments; the rest as for [`Shadow::new`].
    pub(super) fn new<'s>(
        point: Point,
        segments: impl Iterator<Item = &'s Segment>,
        kept: f64,
        size: f64,
    ) -> Self {
        let shadows = segments.map(|&segment| Shadow::new(segment, point, kept, size));
        Self {
            point,
            shadows: shadows.collect(),
        }
    }

    /// Whether no segment is between `p` and the point, and how far `p` may go in any direction before that can change.
    pub(super) fn look(&self, p: Point) -> (bool, f64) {
        // Hidden as long as one of them is in the way, seen as long as none is.
        let (mut hidden, mut open) = (f64::NEG_INFINITY, f64::INFINITY);
        for shadow in &self.shadows {
            let reach = shadow.reach(p);
            if shadow.hides(p, self.point) {
                hidden = hidden.max(reach.max(0.0));
            } else {
                open = open.min(reach);
            }
        }
        match hidden >= 0.0 {
            true => (false, hidden),
            false => (true, open),
        }
    }
}
