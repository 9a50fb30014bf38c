//! Points and vectors.

/// A point or a vector of the plane, in metres.
pub type Point = [f64; 2];

/// `a × b`, the z coordinate of the cross product.
#[inline(always)]
pub fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// `a · b`
#[inline(always)]
pub fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// `a − b`
#[inline(always)]
pub fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// `a + t b`
#[inline(always)]
pub fn along(a: Point, t: f64, b: Point) -> Point {
    [a[0] + t * b[0], a[1] + t * b[1]]
}

/// `u` turned by the angle whose cosine and sine `v` is.
#[inline(always)]
pub fn turned(u: Point, v: Point) -> Point {
    [u[0] * v[0] - u[1] * v[1], u[0] * v[1] + u[1] * v[0]]
}

/// `t`, kept within [low, high]; `low` for NaN.
#[inline(always)]
pub fn limit(t: f64, low: f64, high: f64) -> f64 {
    let t = if t > low { t } else { low };
    if t < high { t } else { high }
}
