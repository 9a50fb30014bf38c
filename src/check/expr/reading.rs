//! Readings of targets: places, points, walls and sensors become arithmetic on the pose, or a leaf of the pool.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::context::Region;
use crate::check::expr::expect::PLACE_FOR_WALL;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::geometry::Shape;
use crate::ir::expr::{Binary, Echo, Expr, ExprId, Pose, Unary};
use crate::ir::world::World;
use crate::source::Span;
use crate::syntax::ast::{self, Ref};

impl<'a> Checker<'a> {
    /// `distance(t)`, `bearing(t)`, `direction(t)`, `visible(t)`, `inside(p)`, `facing(p)`.
    pub fn reading(&mut self, function: Function, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        if function == Function::Inside {
            return self.inside_place(reference);
        }
        let most = if function == Function::Distance { 2 } else { 1 };
        let values = self.positional(reference, 1, most)?;
        if !self.has_world {
            let what = format!("`{}`", reference.name.name);
            let label = "read by a robot in its world";
            return self.no_world(reference.name.span, &what, label).none();
        }
        let mut targets = Vec::new();
        for value in values {
            targets.push(self.target(function, reference, value)?);
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

    /// An argument of a reading, if it can be read so.
    fn target(
        &mut self,
        function: Function,
        reference: &'a Ref,
        value: &'a ast::Expr,
    ) -> Option<Typed> {
        let wanted = match function {
            Function::Inside | Function::Facing => Type::Place(None),
            _ => Type::Target,
        };
        let target = self.expr_like(value, &wanted);
        if target.ty == Type::Error {
            return None;
        }
        let of_place = matches!(function, Function::Inside | Function::Facing);
        let is_place = matches!(target.ty, Type::Place(_) | Type::Nowhere | Type::Target)
            && matches!(
                target.value,
                Value::Place(_) | Value::Chosen(..) | Value::Nowhere | Value::Unknown
            );
        if !target.ty.is_target() || (of_place && !is_place) {
            let wanted = if of_place {
                "a place"
            } else {
                "a place, a wall, a robot, a point or a sensor"
            };
            let is_wall = of_place && matches!(target.ty, Type::Wall(_));
            let help = is_wall.then(|| PLACE_FOR_WALL.to_owned());
            return self
                .error(
                    Code::E0302,
                    target.span,
                    format!(
                        "what `{}` reads is {wanted}, not {}",
                        reference.name.name, target.ty
                    ),
                )
                .this_is(&target.ty)
                .help_if(help)
                .none();
        }
        // Between two robots it may be one of them.
        let between = reference.args.as_ref().is_some_and(|args| args.len() == 2);
        let own = target.value == Value::Robot(self.subject);
        if own && !between && self.reader_is_known() {
            let label = format!("`{}` is read", reference.name.name);
            self.reads_itself(target.span, &label);
            return None;
        }
        Some(target)
    }

    /// Reports a robot that is its own target.
    pub fn reads_itself(&mut self, at: Span, read: &str) {
        let name = self.subject_robot().map(|robot| robot.name.clone());
        let name = name.unwrap_or_default();
        self.error(Code::E0411, at, format!("`{name}` reads itself here"))
            .label(format!("{read} by `{name}`, from its own centre"))
            .help(format!(
                "name another robot, or a place; where `{name}` is, `position` and `heading` say"
            ));
    }

    /// Whether only one robot reads what is at hand: events and what they do are read by the one that learns, scripts
    /// by the robot that runs them, and bodies by the robot that they are unrolled for.
    pub fn reader_is_known(&self) -> bool {
        let region = self.context.region;
        self.subject != World::acting()
            || region.sees_events()
            || matches!(region, Region::EachTick | Region::Start)
            || !self.bodies.of_any_robot()
    }

    /// `inside(place)`, `inside(place, by = robot)`
    fn inside_place(&mut self, reference: &'a Ref) -> Option<Typed> {
        let (value, by) = self.one_by(reference)?;
        if !self.has_world {
            let what = format!("`{}`", reference.name.name);
            let label = "read by a robot in its world";
            return self.no_world(reference.name.span, &what, label).none();
        }
        let target = self.target(Function::Inside, reference, value)?;
        let robot = Value::Robot(by.unwrap_or(self.subject));
        let own = by.is_none_or(|by| by == self.subject);
        let inside = self.of_each(&target.value, &mut |checker, place| {
            if own {
                return checker.inside(place);
            }
            let Value::Place(id) = place else {
                return Some(checker.program.pool.bool(false));
            };
            let point = checker.point_of(&robot)?;
            let shape = checker.program.world.as_ref()?.places[*id].shape.clone();
            checker.contains(&shape, point)
        });
        Some(Typed::new(Type::Bool, inside, reference.span))
    }

    /// Whether a shape holds a point: for a polygon, by the number of edges that a ray to the right of it meets.
    fn contains(&mut self, shape: &Shape, (x, y): (ExprId, ExprId)) -> Option<ExprId> {
        let pool = &mut self.program.pool;
        Some(match shape {
            Shape::Disc { center, radius } => {
                let (cx, cy) = (pool.num(center[0]), pool.num(center[1]));
                let dx = pool.binary(Binary::Sub, cx, x);
                let dy = pool.binary(Binary::Sub, cy, y);
                let distance = pool.binary(Binary::Hypot, dx, dy);
                let radius = pool.num(*radius);
                pool.binary(Binary::Le, distance, radius)
            }
            Shape::Rect { min, max } => {
                let mut inside = pool.bool(true);
                for (low, at, high) in [(min[0], x, max[0]), (min[1], y, max[1])] {
                    let (low, high) = (pool.num(low), pool.num(high));
                    let above = pool.binary(Binary::Le, low, at);
                    let below = pool.binary(Binary::Le, at, high);
                    let within = pool.and(above, below);
                    inside = pool.and(inside, within);
                }
                inside
            }
            Shape::Polygon(_) => {
                let mut odd = pool.bool(false);
                for edge in shape.outline() {
                    let ([ax, ay], [ux, uy]) = (edge.start, edge.along);
                    let (start, end) = (pool.num(ay), pool.num(ay + uy));
                    let over_start = pool.binary(Binary::Lt, y, start);
                    let over_end = pool.binary(Binary::Lt, y, end);
                    let spans = pool.binary(Binary::Ne, over_start, over_end);
                    let (ax, slope) = (pool.num(ax), pool.num(ux / uy));
                    let rise = pool.binary(Binary::Sub, y, start);
                    let run = pool.binary(Binary::Mul, rise, slope);
                    let meets = pool.binary(Binary::Add, ax, run);
                    let right = pool.binary(Binary::Lt, x, meets);
                    let crossed = pool.and(spans, right);
                    odd = pool.binary(Binary::Ne, odd, crossed);
                }
                odd
            }
            Shape::Polyline(_) => pool.bool(false),
        })
    }

    fn read_one(&mut self, function: Function, target: &Typed) -> Option<ExprId> {
        let span = target.span;
        self.of_each(&target.value, &mut |checker, target| match function {
            Function::Distance => checker.echo(target, Echo::Distance),
            Function::Direction => checker.echo(target, Echo::Direction),
            Function::Bearing => {
                if *target == Value::Nowhere {
                    return Some(checker.program.pool.num(0.0));
                }
                let direction = checker.echo(target, Echo::Direction)?;
                let pool = &mut checker.program.pool;
                let heading = pool.leaf(Expr::Pose(Pose::Heading));
                let bearing = pool.binary(Binary::Sub, direction, heading);
                Some(pool.unary(Unary::Wrap, bearing))
            }
            Function::Visible => checker.seen(target),
            Function::Inside => checker.inside(target),
            _ => checker.facing(target, span),
        })
    }

    /// Whether nothing is in between.
    fn seen(&mut self, target: &Value) -> Option<ExprId> {
        let seen = match target {
            Value::Sensor(id) => Expr::Sensor(*id, Echo::Seen),
            Value::Wall(id) => Expr::Wall(*id, Echo::Seen),
            Value::NearestWall => Expr::Bool(true),
            Value::Nowhere => Expr::Bool(false),
            _ => {
                let (x, y) = self.point_of(target)?;
                Expr::Visible(x, y)
            }
        };
        Some(self.program.pool.leaf(seen))
    }

    /// Distance or direction from the robot's centre. What is nowhere is infinitely far, straight ahead.
    pub fn echo(&mut self, target: &Value, echo: Echo) -> Option<ExprId> {
        let leaf = match (target, echo) {
            (Value::Wall(id), _) => Some(Expr::Wall(*id, echo)),
            (Value::NearestWall, _) => Some(Expr::NearestWall(echo)),
            (Value::Sensor(id), _) => Some(Expr::Sensor(*id, echo)),
            (Value::Nowhere, Echo::Distance) => Some(Expr::Num(f64::INFINITY)),
            (Value::Nowhere, _) => Some(Expr::Pose(Pose::Heading)),
            _ => None,
        };
        if let Some(leaf) = leaf {
            return Some(self.program.pool.leaf(leaf));
        }
        let (dx, dy) = self.offset(target)?;
        let pool = &mut self.program.pool;
        Some(match echo {
            Echo::Distance => pool.binary(Binary::Hypot, dx, dy),
            _ => pool.binary(Binary::Atan2, dy, dx),
        })
    }

    /// The vector from the robot's centre to a place or a point.
    fn offset(&mut self, target: &Value) -> Option<(ExprId, ExprId)> {
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
    pub fn point_of(&mut self, target: &Value) -> Option<(ExprId, ExprId)> {
        match target {
            Value::Point(x, y) => Some((*x, *y)),
            Value::Place(id) => {
                let [x, y] = self.program.world.as_ref()?.places[*id].shape.center();
                Some((self.program.pool.num(x), self.program.pool.num(y)))
            }
            Value::Robot(id) => {
                let (x, y) = match *id == self.subject {
                    true => (Expr::Pose(Pose::X), Expr::Pose(Pose::Y)),
                    false => (Expr::Robot(*id, Pose::X), Expr::Robot(*id, Pose::Y)),
                };
                Some((self.program.pool.leaf(x), self.program.pool.leaf(y)))
            }
            _ => None,
        }
    }

    /// `pose(robot)`: where a robot is.
    pub fn position_of(&mut self, reference: &'a Ref) -> Option<Typed> {
        let robot = self.robot_read(reference, &Type::Point)?;
        if robot.value == Value::Unknown {
            return Some(robot);
        }
        let coordinate = |checker: &mut Self, of: fn((ExprId, ExprId)) -> ExprId| {
            checker.of_each(&robot.value, &mut |checker, robot| {
                if *robot == Value::Nowhere {
                    return Some(checker.program.pool.num(f64::INFINITY));
                }
                checker.point_of(robot).map(of)
            })
        };
        let x = coordinate(self, |(x, _)| x)?;
        let y = coordinate(self, |(_, y)| y)?;
        Some(Typed::new(Type::Point, Value::Point(x, y), reference.span))
    }

    /// `heading(robot)`: which way a robot looks.
    pub fn heading_of(&mut self, reference: &'a Ref) -> Option<Typed> {
        let robot = self.robot_read(reference, &Type::ANGLE)?;
        if robot.value == Value::Unknown {
            return Some(robot);
        }
        let angle = self.of_each(&robot.value, &mut |checker, robot| {
            let leaf = match robot {
                Value::Robot(id) if *id != checker.subject => Expr::Robot(*id, Pose::Heading),
                _ => Expr::Pose(Pose::Heading),
            };
            Some(checker.program.pool.leaf(leaf))
        })?;
        Some(Typed::new(
            Type::ANGLE,
            Value::Scalar(angle),
            reference.span,
        ))
    }

    /// The robot of which something of a type is read; of one that is not known, what is read of it is not, either.
    fn robot_read(&mut self, reference: &'a Ref, read: &Type) -> Option<Typed> {
        let &[value] = self.positional(reference, 1, 1)?.as_slice() else {
            return None;
        };
        let role = format!("`{}` is read of a robot: it", reference.name.name);
        let robot = self.expect(value, &Type::Robot, &role);
        Some(match robot.value {
            Value::Unknown => Typed::unknown(read.clone(), reference.span),
            _ => robot,
        })
    }

    fn inside(&mut self, target: &Value) -> Option<ExprId> {
        let id = match target {
            Value::Place(id) => *id,
            Value::Nowhere => return Some(self.program.pool.bool(false)),
            _ => return None,
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

    fn facing(&mut self, target: &Value, span: Span) -> Option<ExprId> {
        let id = match target {
            Value::Place(id) => *id,
            Value::Nowhere => return Some(self.program.pool.leaf(Expr::Pose(Pose::Heading))),
            _ => return None,
        };
        let place = &self.program.world.as_ref()?.places[id];
        let (name, facing) = (place.name.clone(), place.facing);
        match facing {
            Some(angle) => Some(self.program.pool.num(angle)),
            None => self
                .error(
                    Code::E0405,
                    span,
                    format!("the place `{name}` faces nowhere"),
                )
                .label("it has no `facing`")
                .help(format!("declare it: `place {name} = … facing 0 deg`"))
                .none(),
        }
    }
}
