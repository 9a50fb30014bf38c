//! The transcendental functions, in one place, so that every machine computes the same bits.
//!
//! All of them are software implementations (the `libm` crate); the platform's own are never called. Angles are in
//! radians.

use std::f64::consts::{PI, TAU};

/// Sine of an angle.
pub fn sin(angle: f64) -> f64 {
    libm::sin(angle)
}

/// Cosine of an angle.
pub fn cos(angle: f64) -> f64 {
    libm::cos(angle)
}

/// Sine and cosine of an angle.
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// Tangent of an angle.
pub fn tan(angle: f64) -> f64 {
    libm::tan(angle)
}

/// The angle of that sine, in [−π/2, π/2]; NaN outside [−1, 1].
pub fn asin(sine: f64) -> f64 {
    libm::asin(sine)
}

/// The angle of that cosine, in [0, π]; NaN outside [−1, 1].
pub fn acos(cosine: f64) -> f64 {
    libm::acos(cosine)
}

/// The angle of that tangent, in (−π/2, π/2).
pub fn atan(tangent: f64) -> f64 {
    libm::atan(tangent)
}

/// The direction of the vector (`x`, `y`), in [−π, π].
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// e to the power `x`.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// The natural logarithm.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// The logarithm to base 2.
pub fn log2(x: f64) -> f64 {
    libm::log2(x)
}

/// `base` to the power `exponent`.
pub fn pow(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// The length of the vector (`x`, `y`). Not guarded against overflow: coordinates are metres of a robot's world.
pub fn hypot(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// The same direction in [−π, π).
#[inline]
pub fn wrap(angle: f64) -> f64 {
    match (-PI..PI).contains(&angle) {
        true => angle,
        false => wrapped(angle),
    }
}

/// The same direction in [−π, π), of an angle beyond that.
#[cold]
fn wrapped(angle: f64) -> f64 {
    let turns = ((angle + PI) / TAU).floor();
    let wrapped = angle - turns * TAU;
    // Rounding may leave the interval by one step.
    if wrapped >= PI {
        wrapped - TAU
    } else if wrapped < -PI {
        -PI
    } else {
        wrapped
    }
}
