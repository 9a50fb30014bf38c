//! Readings of targets: places, points, walls and sensors become arithmetic on the pose, or a leaf of the pool.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::geometry::Shape;
use crate::ir::expr::{Binary, Echo, Expr, ExprId, Pose, Unary};
use crate::syntax::ast::Ref;

impl<'a> Checker<'a> {
    /// `distance(t)`, `bearing(t)`, `direction(t)`, `visible(t)`, `inside(p)`, `facing(p)`.
    pub fn reading(&mut self, function: Function, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        let most = if function == Function::Distance { 2 } else { 1 };
        let values = self.positional(reference, 1, most)?;
        if !self.has_world {
            let what = format!("`{}`", reference.name.name);
            let label = "read by a robot in its world";
            return self.no_world(reference.name.span, &what, label).none();
        }
        let mut targets = Vec::new();
        for value in values {
            let target = self.expr(value);
            if target.ty == Type::Error {
                return None;
            }
            let of_place = matches!(function, Function::Inside | Function::Facing);
            if !target.ty.is_target() || (of_place && !matches!(target.ty, Type::Place(_))) {
                let wanted = if of_place {
                    "a place"
                } else {
                    "a place, a wall, a point or a sensor"
                };
                return self
                    .error(
                        Code::E0302,
                        target.span,
                        format!("`{}` is read of {wanted}", reference.name.name),
                    )
                    .this_is(&target.ty)
                    .none();
            }
            targets.push(target);
        }
        let ty = match function {
            Function::Distance => Type::LENGTH,
            Function::Visible | Function::Inside => Type::Bool,
            _ => Type::ANGLE,
        };
        let id = match targets.as_slice() {
            [target] => self.read_one(function, target),
            [from, to] => self.distance_between(from, to),
            _ => None,
        };
        Some(Typed::new(ty, id, span))
    }

    fn read_one(&mut self, function: Function, target: &Typed) -> Option<ExprId> {
        if matches!(target.value, Value::Robot) {
            return self.not_yet(target.span, "readings of robots").none();
        }
        let wall = matches!(target.value, Value::Wall(_) | Value::NearestWall);
        if function == Function::Visible && wall {
            let what = "readings of walls in sight";
            return self.not_yet(target.span, what).none();
        }
        match function {
            Function::Distance => self.echo(target, Echo::Distance),
            Function::Direction => self.echo(target, Echo::Direction),
            Function::Bearing => {
                let direction = self.echo(target, Echo::Direction)?;
                let pool = &mut self.program.pool;
                let heading = pool.leaf(Expr::Pose(Pose::Heading));
                let bearing = pool.binary(Binary::Sub, direction, heading);
                Some(pool.unary(Unary::Wrap, bearing))
            }
            Function::Visible => match target.value {
                Value::Sensor(id) => Some(self.program.pool.leaf(Expr::Sensor(id, Echo::Seen))),
                _ => {
                    let (x, y) = self.point_of(target)?;
                    Some(self.program.pool.leaf(Expr::Visible(x, y)))
                }
            },
            Function::Inside => self.inside(target),
            _ => self.facing(target),
        }
    }

    /// Distance or direction from the robot's centre.
    fn echo(&mut self, target: &Typed, echo: Echo) -> Option<ExprId> {
        match target.value {
            Value::Wall(id) => return Some(self.program.pool.leaf(Expr::Wall(id, echo))),
            Value::NearestWall => return Some(self.program.pool.leaf(Expr::NearestWall(echo))),
            Value::Sensor(id) => return Some(self.program.pool.leaf(Expr::Sensor(id, echo))),
            _ => {}
        }
        let (dx, dy) = self.offset(target)?;
        let pool = &mut self.program.pool;
        Some(match echo {
            Echo::Distance => pool.binary(Binary::Hypot, dx, dy),
            _ => pool.binary(Binary::Atan2, dy, dx),
        })
    }

    /// The vector from the robot's centre to a place or a point.
    fn offset(&mut self, target: &Typed) -> Option<(ExprId, ExprId)> {
        let (x, y) = self.point_of(target)?;
        let pool = &mut self.program.pool;
        let here = (
            pool.leaf(Expr::Pose(Pose::X)),
            pool.leaf(Expr::Pose(Pose::Y)),
        );
        Some((
            pool.binary(Binary::Sub, x, here.0),
            pool.binary(Binary::Sub, y, here.1),
        ))
    }

    /// The point that a place or a point is measured to.
    fn point_of(&mut self, target: &Typed) -> Option<(ExprId, ExprId)> {
        match target.value {
            Value::Point(x, y) => Some((x, y)),
            Value::Place(id) => {
                let [x, y] = self.program.world.as_ref()?.places[id].shape.center();
                Some((self.program.pool.num(x), self.program.pool.num(y)))
            }
            _ => None,
        }
    }

    fn distance_between(&mut self, from: &Typed, to: &Typed) -> Option<ExprId> {
        for end in [from, to] {
            if !matches!(end.ty, Type::Place(_) | Type::Point) {
                let what = "distances between walls, robots and sensors";
                return self.not_yet(end.span, what).none();
            }
        }
        let ((ax, ay), (bx, by)) = (self.point_of(from)?, self.point_of(to)?);
        let pool = &mut self.program.pool;
        let dx = pool.binary(Binary::Sub, bx, ax);
        let dy = pool.binary(Binary::Sub, by, ay);
        Some(pool.binary(Binary::Hypot, dx, dy))
    }

    fn inside(&mut self, target: &Typed) -> Option<ExprId> {
        let Value::Place(id) = target.value else {
            return None;
        };
        let shape = self.program.world.as_ref()?.places[id].shape.clone();
        match shape {
            Shape::Disc { radius, .. } => {
                let (dx, dy) = self.offset(target)?;
                let pool = &mut self.program.pool;
                let distance = pool.binary(Binary::Hypot, dx, dy);
                let radius = pool.num(radius);
                Some(pool.binary(Binary::Le, distance, radius))
            }
            Shape::Rect {
                min: [x0, y0],
                max: [x1, y1],
            } => {
                let pool = &mut self.program.pool;
                let x = pool.leaf(Expr::Pose(Pose::X));
                let y = pool.leaf(Expr::Pose(Pose::Y));
                let mut inside = pool.bool(true);
                for (low, at, high) in [(x0, x, x1), (y0, y, y1)] {
                    let (low, high) = (pool.num(low), pool.num(high));
                    let above = pool.binary(Binary::Le, low, at);
                    let below = pool.binary(Binary::Le, at, high);
                    let within = pool.and(above, below);
                    inside = pool.and(inside, within);
                }
                Some(inside)
            }
            Shape::Polygon(_) | Shape::Polyline(_) => {
                Some(self.program.pool.leaf(Expr::Inside(id)))
            }
        }
    }

    fn facing(&mut self, target: &Typed) -> Option<ExprId> {
        let Value::Place(id) = target.value else {
            return None;
        };
        let place = &self.program.world.as_ref()?.places[id];
        let (name, facing) = (place.name.clone(), place.facing);
        match facing {
            Some(angle) => Some(self.program.pool.num(angle)),
            None => self
                .error(
                    Code::E0405,
                    target.span,
                    format!("the place `{name}` faces nowhere"),
                )
                .label("it has no `facing`")
                .help(format!("declare it: `place {name} = … facing 0 deg`"))
                .none(),
        }
    }
}
