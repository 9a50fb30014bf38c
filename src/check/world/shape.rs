//! Shapes of the world: constant and not degenerate.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::types::{Type, Value};
use crate::diagnostic::{Applicability, Code};
use crate::geometry::{Point, Shape, crosses_itself, doubled_area};
use crate::source::Span;
use crate::syntax::ast::{self, ArgKind, Expr, ExprKind, Ref};

impl<'a> Checker<'a> {
    /// `disc(centre, radius)`, `rect(corner, corner)`, `polygon(…)`, `polyline(…)`, `line(from, to)`.
    pub fn shape(&mut self, function: Function, reference: &'a Ref) -> Option<Shape> {
        let span = reference.span;
        let points = if function == Function::Disc {
            1
        } else {
            usize::MAX
        };
        if self.loose_coordinates(reference, points) {
            return None;
        }
        match function {
            Function::Disc => {
                let values = self.positional(reference, 2, 2)?;
                let [center, radius] = values.as_slice() else {
                    return None;
                };
                let length = matches!(center.kind, ExprKind::Number(_));
                if length && matches!(radius.kind, ExprKind::Point(..)) {
                    self.the_other_way_around(center, radius);
                    return None;
                }
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

    /// Reports numbers where points should be, such as `rect(0 m, 0 m, 6 m, 4 m)`; at most `points` of them are points.
    fn loose_coordinates(&mut self, reference: &'a Ref, points: usize) -> bool {
        let name = &reference.name.name;
        let args = reference.args.as_deref().unwrap_or_default();
        let number = |arg: &ast::Arg| match &arg.kind {
            ArgKind::Positional(Expr {
                kind: ExprKind::Number(literal),
                ..
            }) => {
                let unit = literal.unit.as_ref().map(|unit| format!(" {}", unit.text));
                Some(literal.digits.clone() + &unit.unwrap_or_default())
            }
            _ => None,
        };
        let Some(numbers) = args.iter().map(number).collect::<Option<Vec<String>>>() else {
            return false;
        };
        let loose = numbers.len().min(points.saturating_mul(2));
        let (Some(first), Some(last)) = (args.first(), args.get(loose.saturating_sub(1))) else {
            return false;
        };
        if points == 1 && numbers.len() < 3 {
            return false;
        }
        let role = if points == 1 {
            "the centre"
        } else {
            "a corner"
        };
        let draft = self
            .error(
                Code::E0302,
                first.span.to(last.span),
                format!("{role} of a `{name}` is a point, not a number"),
            )
            .label("a point is written `(x, y)`");
        if loose % 2 == 0
            && numbers
                .iter()
                .take(loose)
                .all(|number| number.contains(' '))
        {
            let pairs = numbers.get(..loose).unwrap_or_default().chunks(2);
            let pairs: Vec<String> = pairs.map(|pair| format!("({})", pair.join(", "))).collect();
            let mut right = pairs.join(", ");
            let corner = name == "rect" && loose == 2;
            if corner {
                right = format!("(0 m, 0 m), {right}");
            }
            let title = format!("write `{right}`");
            let enough = loose >= 4 || points == 1 || corner;
            if enough {
                draft.fix(
                    title,
                    first.span.to(last.span),
                    right,
                    Applicability::Unsafe,
                );
            }
        }
        true
    }

    /// A length above zero.
    pub fn radius(&mut self, value: &'a ast::Expr) -> Option<f64> {
        let radius = self.constant(value, &Type::LENGTH, "a radius")?;
        if radius > 0.0 {
            Some(radius)
        } else {
            self.error(Code::E0404, value.span, "a radius is above zero")
                .label("a disc of this size is not a shape")
                .none()
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
