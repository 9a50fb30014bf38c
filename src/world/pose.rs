//! The pose: a position, a heading, and the heading's unit vector, so that going straight needs no trigonometry.

use crate::geometry::Point;
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
    /// The pose at a position with a heading, which may be any angle.
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

/// The cosine and sine of an angle: by their series where it is small, with an error below 10⁻¹⁵.
#[inline(always)]
pub(super) fn rotor(angle: f64) -> Point {
    if angle.abs() > 0.25 {
        let (sin, cos) = math::sin_cos(angle);
        return [cos, sin];
    }
    // The Taylor coefficients ±1/n!, in pairs (Estrin's scheme): nothing is divided, and products do not wait for one
    // another.
    const COS: [f64; 6] = [
        -1.0 / 2.0,
        1.0 / 24.0,
        -1.0 / 720.0,
        1.0 / 40_320.0,
        -1.0 / 3_628_800.0,
        1.0 / 479_001_600.0,
    ];
    const SIN: [f64; 6] = [
        -1.0 / 6.0,
        1.0 / 120.0,
        -1.0 / 5_040.0,
        1.0 / 362_880.0,
        -1.0 / 39_916_800.0,
        1.0 / 6_227_020_800.0,
    ];
    let x = angle * angle;
    let xx = x * x;
    let series = |[a, b, c, d, e, f]: [f64; 6]| (a + b * x) + xx * ((c + d * x) + xx * (e + f * x));
    [1.0 + x * series(COS), angle + angle * x * series(SIN)]
}
