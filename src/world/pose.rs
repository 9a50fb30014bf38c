//! The pose: a position, a heading, and the heading's unit vector, so that going straight needs no trigonometry.

use crate::ir::world::Point;
use crate::math;

/// Where the robot's centre is and where it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The position in metres.
    pub position: Point,
    /// The heading in [−π, π).
    pub heading: f64,
    /// The cosine and sine of the heading.
    pub ahead: Point,
}

impl Pose {
    /// The pose at a position with a heading, which need not be in [−π, π).
    pub fn new(position: Point, heading: f64) -> Self {
        let heading = math::wrap(heading);
        let (sin, cos) = math::sin_cos(heading);
        Self {
            position,
            heading,
            ahead: [cos, sin],
        }
    }
}

/// The cosine and sine of an angle: by their series where it is small, with an error below 10⁻¹⁶.
#[inline(always)]
pub(super) fn rotor(angle: f64) -> Point {
    if angle.abs() > 0.25 {
        let (sin, cos) = math::sin_cos(angle);
        return [cos, sin];
    }
    let x = angle * angle;
    let cos =
        1.0 - x / 2.0 * (1.0 - x / 12.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0 * (1.0 - x / 90.0))));
    let sin = angle
        * (1.0
            - x / 6.0 * (1.0 - x / 20.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0 * (1.0 - x / 110.0)))));
    [cos, sin]
}
