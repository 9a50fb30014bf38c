//! Shapes of the world: constant and not degenerate.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::types::{Type, Value};
use crate::diagnostic::Code;
use crate::geometry::{Point, Shape, crosses_itself, doubled_area};
use crate::source::Span;
use crate::syntax::ast::{self, Ref};

impl<'a> Checker<'a> {
    /// `disc(centre, radius)`, `rect(corner, corner)`, `polygon(…)`, `polyline(…)`, `line(from, to)`.
    pub fn shape(&mut self, function: Function, reference: &'a Ref) -> Option<Shape> {
        let span = reference.span;
        match function {
            Function::Disc => {
                let values = self.positional(reference, 2, 2)?;
                let [center, radius] = values.as_slice() else {
                    return None;
                };
                let center = self.constant_point(center);
                let radius = self.radius(radius)?;
                Some(Shape::Disc {
                    center: center?,
                    radius,
                })
            }
            Function::Rect => {
                let points = self.points(reference, 2, 2)?;
                let [[ax, ay], [bx, by]] = *points.as_slice() else {
                    return None;
                };
                if ax == bx || ay == by {
                    return self.senseless(span, "a rectangle without area");
                }
                Some(Shape::Rect {
                    min: [ax.min(bx), ay.min(by)],
                    max: [ax.max(bx), ay.max(by)],
                })
            }
            Function::Polygon => {
                let mut points = self.points(reference, 3, usize::MAX)?;
                if crosses_itself(&points) {
                    return self.senseless(span, "a polygon that crosses itself");
                }
                let area = doubled_area(&points);
                if area == 0.0 {
                    return self.senseless(span, "a polygon without area");
                }
                if area < 0.0 {
                    points.reverse();
                }
                Some(Shape::Polygon(points))
            }
            _ => {
                let most = if function == Function::Line {
                    2
                } else {
                    usize::MAX
                };
                let points = self.points(reference, 2, most)?;
                if points
                    .iter()
                    .zip(points.iter().skip(1))
                    .any(|(a, b)| a == b)
                {
                    return self.senseless(span, "a line without length");
                }
                Some(Shape::Polyline(points))
            }
        }
    }

    /// A length above zero.
    pub fn radius(&mut self, value: &'a ast::Expr) -> Option<f64> {
        let radius = self.constant(value, &Type::LENGTH, "a radius")?;
        if radius > 0.0 {
            Some(radius)
        } else {
            self.senseless(value.span, "a disc without size")
        }
    }

    /// A shape, as the value of a place, a wall or the arena.
    pub fn shape_of(&mut self, value: &'a ast::Expr, role: &str) -> Option<Shape> {
        match self.expect(value, &Type::Shape, role).value {
            Value::Shape(shape) => Some(shape),
            _ => None,
        }
    }

    fn points(&mut self, reference: &'a Ref, least: usize, most: usize) -> Option<Vec<Point>> {
        let values = self.positional(reference, least, most)?;
        let points: Vec<Option<Point>> = values
            .into_iter()
            .map(|value| self.constant_point(value))
            .collect();
        points.into_iter().collect()
    }

    fn constant_point(&mut self, value: &'a ast::Expr) -> Option<Point> {
        let typed = self.expect(value, &Type::Point, "a corner or a centre");
        let Value::Point(x, y) = typed.value else {
            return None;
        };
        let mut coordinate = |id| self.constant_part(id, typed.span, "a point of the world");
        Some([coordinate(x)?, coordinate(y)?])
    }

    fn senseless<T>(&mut self, span: Span, what: &str) -> Option<T> {
        self.error(Code::E0404, span, format!("{what} is not a shape"))
            .label("no robot could meet this")
            .none()
    }
}
