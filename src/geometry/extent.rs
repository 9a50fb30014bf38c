//! How far a shape extends.

use super::Shape;
use super::vector::Point;
use crate::math;
use parry2d_f64::bounding_volume::Aabb;
use parry2d_f64::math::Vector;
use parry2d_f64::query::{Ray, RayCast};

impl Shape {
    /// The smallest axis-parallel rectangle around it.
    fn rectangle(&self) -> Aabb {
        match self {
            Shape::Disc { center, radius } => {
                Aabb::from_half_extents((*center).into(), Vector::splat(*radius))
            }
            Shape::Rect { min, max } => Aabb::new((*min).into(), (*max).into()),
            Shape::Polygon(points) | Shape::Polyline(points) => {
                let mut rectangle = Aabb::new_invalid();
                points.iter().for_each(|&p| rectangle.take_point(p.into()));
                rectangle
            }
        }
    }

    /// The corners of the smallest axis-parallel rectangle around it: of the least and of the greatest coordinates.
    pub fn bounds(&self) -> (Point, Point) {
        let rectangle = self.rectangle();
        (rectangle.mins.into(), rectangle.maxs.into())
    }

    /// How far it is from the centre to the rim of a disc, of any other shape to the smallest axis-parallel rectangle
    /// around it, in a direction.
    pub fn reach(&self, direction: f64) -> f64 {
        if let Shape::Disc { radius, .. } = self {
            return *radius;
        }
        let (sin, cos) = math::sin_cos(direction);
        let ray = Ray::new(self.center().into(), Vector::new(cos, sin));
        let rim = self.rectangle().cast_local_ray(&ray, f64::MAX, false);
        rim.unwrap_or_default()
    }
}
