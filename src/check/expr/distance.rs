//! Distances, as arithmetic on what is measured.

use crate::check::Checker;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::geometry::{Point, Segment, Shape};
use crate::ir::Pool;
use crate::ir::expr::{Binary, ExprId, Unary};

impl<'a> Checker<'a> {
    /// `distance(a, b)`: a wall is measured to its nearest point, everything else to its centre.
    pub(super) fn distance_between(&mut self, from: &Typed, to: &Typed) -> Option<ExprId> {
        for end in [from, to] {
            let read_by_the_robot =
                end.ty == Type::Sensor || matches!(end.value, Value::NearestWall);
            if read_by_the_robot {
                return self
                    .error(
                        Code::E0302,
                        end.span,
                        "distances are between places, points and walls that have a name",
                    )
                    .label("this is known from where the robot stands only")
                    .none();
            }
        }
        self.of_each(&from.value, &mut |checker, from| {
            checker.of_each(&to.value, &mut |checker, to| checker.distance_of(from, to))
        })
    }

    fn distance_of(&mut self, from: &Value, to: &Value) -> Option<ExprId> {
        match (from, to) {
            (Value::Nowhere | Value::NearestWall, _) | (_, Value::Nowhere | Value::NearestWall) => {
                Some(self.program.pool.num(f64::INFINITY))
            }
            (Value::Wall(a), Value::Wall(b)) => {
                let walls = &self.program.world.as_ref()?.walls;
                let gap = gap(&walls[*a].shape, &walls[*b].shape);
                Some(self.program.pool.num(gap))
            }
            (Value::Wall(wall), point) | (point, Value::Wall(wall)) => {
                let point = self.point_of(point)?;
                let shape = self.program.world.as_ref()?.walls[*wall].shape.clone();
                self.distance_to_shape(point, &shape)
            }
            _ => {
                let ((ax, ay), (bx, by)) = (self.point_of(from)?, self.point_of(to)?);
                let pool = &mut self.program.pool;
                let dx = pool.binary(Binary::Sub, bx, ax);
                let dy = pool.binary(Binary::Sub, by, ay);
                Some(pool.binary(Binary::Hypot, dx, dy))
            }
        }
    }

    /// The distance of a point to the nearest point of a shape's outline.
    pub(super) fn distance_to_shape(
        &mut self,
        (x, y): (ExprId, ExprId),
        shape: &Shape,
    ) -> Option<ExprId> {
        let pool = &mut self.program.pool;
        let mut least = None;
        let mut offer = |pool: &mut Pool, distance| {
            least = Some(match least {
                Some(least) => pool.binary(Binary::Min, least, distance),
                None => distance,
            });
        };
        for segment in shape.outline() {
            let ([ax, ay], [bx, by]) = (segment.start, segment.end());
            let (ux, uy) = (bx - ax, by - ay);
            // The nearest point is a share of the way from the start to the end.
            let (sx, sy) = (pool.num(ax), pool.num(ay));
            let (dx, dy) = (
                pool.binary(Binary::Sub, x, sx),
                pool.binary(Binary::Sub, y, sy),
            );
            let length = ux * ux + uy * uy;
            let (px, py) = (pool.num(ux / length), pool.num(uy / length));
            let (px, py) = (
                pool.binary(Binary::Mul, dx, px),
                pool.binary(Binary::Mul, dy, py),
            );
            let share = pool.binary(Binary::Add, px, py);
            let (zero, one) = (pool.num(0.0), pool.num(1.0));
            let share = pool.binary(Binary::Max, share, zero);
            let share = pool.binary(Binary::Min, share, one);
            let (ux, uy) = (pool.num(ux), pool.num(uy));
            let (gx, gy) = (
                pool.binary(Binary::Mul, share, ux),
                pool.binary(Binary::Mul, share, uy),
            );
            let (gx, gy) = (
                pool.binary(Binary::Sub, dx, gx),
                pool.binary(Binary::Sub, dy, gy),
            );
            let distance = pool.binary(Binary::Hypot, gx, gy);
            offer(pool, distance);
        }
        if let Some(circle) = shape.rim() {
            let [cx, cy] = circle.center;
            let (cx, cy) = (pool.num(cx), pool.num(cy));
            let (dx, dy) = (
                pool.binary(Binary::Sub, x, cx),
                pool.binary(Binary::Sub, y, cy),
            );
            let centre = pool.binary(Binary::Hypot, dx, dy);
            let radius = pool.num(circle.radius);
            let distance = pool.binary(Binary::Sub, centre, radius);
            let distance = pool.unary(Unary::Abs, distance);
            offer(pool, distance);
        }
        least
    }
}

/// The distance between the outlines of two shapes; 0 where they meet.
fn gap(a: &Shape, b: &Shape) -> f64 {
    let (first, second) = (a.outline(), b.outline());
    let crossing = |s: &Segment, t: &Segment| s.meets(t.start, t.end());
    if first.iter().any(|s| second.iter().any(|t| crossing(s, t))) {
        return 0.0;
    }
    let length = |[x, y]: Point| crate::math::hypot(x, y);
    let mut least = f64::INFINITY;
    for (one, other) in [(a, b), (b, a)] {
        let ends = one.outline().into_iter().flat_map(|s| [s.start, s.end()]);
        for end in ends {
            for segment in other.outline() {
                least = least.min(length(segment.nearest(end)));
            }
            if let Some(rim) = other.rim() {
                least = least.min(length(rim.nearest(end)));
            }
        }
        if let Some(rim) = one.rim() {
            for segment in other.outline() {
                least = least.min((length(segment.nearest(rim.center)) - rim.radius).max(0.0));
            }
            if let Some(other) = other.rim() {
                let centres = length([
                    other.center[0] - rim.center[0],
                    other.center[1] - rim.center[1],
                ]);
                least = least.min((centres - rim.radius - other.radius).max(0.0));
            }
        }
    }
    least
}
