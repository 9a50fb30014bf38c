//! The plane: points, segments, circles and the shapes of the language.
//!
//! Lengths are in metres, angles in radians counter-clockwise from the x axis. What a tick asks (distances, rays, whether
//! a point is inside) is written here, without allocation; what is asked once, when a world is checked or drawn, is
//! parry's.

mod circle;
mod extent;
mod polygon;
mod segment;
mod shape;
mod vector;

pub use circle::Circle;
pub use polygon::{crosses_itself, doubled_area};
pub use segment::Segment;
pub use shape::Shape;
pub use vector::{Point, along, cross, dot, limit, minus, turned};
