//! Built-in names and calls.

use crate::check::Checker;
use crate::check::builtin::{BuiltIn, Constant, Function};
use crate::check::context::Region;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::ir::expr::{Binary, Expr, Pose};
use crate::source::Span;
use crate::syntax::ast::Ref;

impl<'a> Checker<'a> {
    /// A built-in name without arguments.
    pub fn built_in_value(&mut self, constant: Constant, span: Span) -> Option<Typed> {
        use Constant as C;
        let (name, region) = (constant.name(), self.context.region);
        match constant {
            C::Nowhere => return Some(Typed::new(Type::Nowhere, Value::Nowhere, span)),
            C::Anywhere => return Some(Typed::new(Type::Anywhere, Value::Anywhere, span)),
            C::Visits | C::Progress if region != Region::Schedule => {
                let why = "known to the schedules of a learner only";
                return self.out_of_scope(name, span, why);
            }
            C::Visits => return Some(self.leaf(Expr::Visits, Type::NUMBER, span)),
            C::Progress => return Some(self.leaf(Expr::Progress, Type::NUMBER, span)),
            C::Elapsed if !region.in_behavior() && region != Region::Let => {
                // An end is read as a reward is.
                let (place, limit) = match region {
                    Region::Reward => (
                        "here",
                        Some("an episode ends after a time by `end after 10 min`"),
                    ),
                    region => (region.name(), None),
                };
                let within = if limit.is_some() { "" } else { "in " };
                let message = format!("`{name}` cannot be asked {within}{place}");
                return self
                    .error(Code::E0307, span, message)
                    .label("how long a behaviour runs, known to it alone")
                    .help("time is counted in a state: `each tick { waited += tick }`")
                    .help_if(limit.map(str::to_owned))
                    .none();
            }
            _ => {}
        }
        if !self.has_world {
            let label = "known to a robot in its world";
            return self.no_world(span, &format!("`{name}`"), label).none();
        }
        let drive = self.subject_robot().map(|robot| &robot.drive);
        let (ty, number) = match constant {
            C::Heading => return Some(self.leaf(Expr::Pose(Pose::Heading), Type::ANGLE, span)),
            C::Touching => return Some(self.leaf(Expr::Touching, Type::Bool, span)),
            C::Elapsed => return Some(self.leaf(Expr::Elapsed, Type::TIME, span)),
            C::NearestWall => {
                return Some(Typed::new(Type::Wall(None), Value::NearestWall, span));
            }
            C::Position => {
                let x = self.program.pool.leaf(Expr::Pose(Pose::X));
                let y = self.program.pool.leaf(Expr::Pose(Pose::Y));
                return Some(Typed::new(Type::Point, Value::Point(x, y), span));
            }
            C::MaxSpeed => (Type::SPEED, drive.map(|drive| drive.max_speed)),
            C::MaxTurn => (Type::TURN_RATE, drive.map(|drive| drive.max_turn)),
            _ => (Type::TIME, self.tick),
        };
        let value = number.map(|number| self.program.pool.num(number));
        Some(Typed::new(ty, value, span))
    }

    /// Reports a name that means nothing in this part of a program.
    pub fn out_of_scope<T>(&mut self, name: &str, span: Span, why: &str) -> Option<T> {
        let region = self.context.region.name();
        let message = format!("`{name}` cannot be asked in {region}");
        self.error(Code::E0307, span, message).label(why).none()
    }

    /// A call of a built-in name.
    pub fn built_in_call(&mut self, called: BuiltIn, reference: &'a Ref) -> Option<Typed> {
        use Function as F;
        let function = match called {
            BuiltIn::Unary(op) => return self.function_of_one(op, reference),
            BuiltIn::Binary(op) => {
                if matches!(op, Binary::Min | Binary::Max) {
                    self.same_bounds(reference);
                }
                return self.function_of_two(op, reference);
            }
            BuiltIn::Function(function) => function,
        };
        match function {
            F::Any | F::All | F::Count | F::Nearest => self.quantified(function, reference),
            F::Disc | F::Rect | F::Polygon | F::Polyline | F::Line => {
                let shape = self.shape(function, reference)?;
                Some(Typed::new(Type::Shape, Value::Shape(shape), reference.span))
            }
            F::Distance | F::Bearing | F::Direction | F::Visible | F::Inside | F::Facing => {
                self.reading(function, reference)
            }
            F::Pose => self.position_of(reference),
            F::Success | F::Failure | F::Running | F::Done | F::Failed => {
                self.ended(function, reference)
            }
            F::Uniform | F::Normal | F::Chance | F::OneOf => self.random(function, reference),
            F::Clamp => self.clamp(reference),
            F::Tune => self.tune(reference),
        }
    }
}
