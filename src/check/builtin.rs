//! The names that the compiler knows: constants of the moment, functions, draws.

use super::Checker;
use super::context::Region;
use super::types::units::Dim;
use super::types::{Type, Typed, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Binary, Expr, Pose, Unary};
use crate::source::Span;
use crate::syntax::ast::Ref;

macro_rules! named {
    ($(#[$doc:meta])* $set:ident { $($variant:ident $name:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $set { $($variant,)* }

        impl $set {
            const NAMES: &'static [(&'static str, $set)] = &[$(($name, $set::$variant),)*];

            /// Its name.
            pub fn name(self) -> &'static str {
                Self::NAMES.iter().find(|(_, it)| *it == self).map_or("", |(name, _)| name)
            }

            /// The built-in of that name.
            pub fn named(name: &str) -> Option<Self> {
                Self::NAMES.iter().find(|(known, _)| *known == name).map(|(_, it)| *it)
            }
        }
    };
}

named! {
    /// Names without arguments.
    Constant {
        Heading "heading",
        Position "position",
        MaxSpeed "max_speed",
        MaxTurn "max_turn",
        Touching "touching",
        Elapsed "elapsed",
        Tick "tick",
        NearestWall "nearest_wall",
        Visits "visits",
        Progress "progress",
        Anywhere "anywhere",
    }
}

named! {
    /// Names with arguments, besides the operators of [`crate::ir::expr`].
    Function {
        Clamp "clamp",
        Distance "distance",
        Bearing "bearing",
        Direction "direction",
        Visible "visible",
        Inside "inside",
        Facing "facing",
        Success "success",
        Failure "failure",
        Done "done",
        Failed "failed",
        Uniform "uniform",
        Normal "normal",
        Chance "chance",
        OneOf "one_of",
        Any "any",
        All "all",
        Count "count",
        Nearest "nearest",
        Disc "disc",
        Rect "rect",
        Polygon "polygon",
        Polyline "polyline",
        Line "line",
    }
}

/// What a call of a built-in name calls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltIn {
    /// A function of one number.
    Unary(Unary),
    /// A function of two numbers.
    Binary(Binary),
    /// Anything else.
    Function(Function),
}

impl BuiltIn {
    /// The built-in of that name.
    pub fn named(name: &str) -> Option<Self> {
        let unary = || Unary::named(name).map(Self::Unary);
        let binary = || Binary::named(name).map(Self::Binary);
        let function = Function::named(name).map(Self::Function);
        function.or_else(unary).or_else(binary)
    }
}

/// Every built-in name.
pub fn names() -> impl Iterator<Item = &'static str> {
    let constants = Constant::NAMES.iter().map(|(name, _)| *name);
    let unary = Unary::ALL.iter().map(|op| op.name());
    let binary = Binary::ALL.iter().map(|op| op.name());
    let functions = Function::NAMES.iter().map(|(name, _)| *name);
    let calls = unary.chain(binary).chain(functions);
    constants.chain(calls.filter(|name| !name.is_empty()))
}

impl<'a> Checker<'a> {
    /// A built-in name without arguments.
    pub fn built_in_value(&mut self, constant: Constant, span: Span) -> Typed {
        let angle = Type::Quantity(Dim::ANGLE);
        let name = constant.name();
        match constant {
            Constant::Visits | Constant::Progress => {
                if self.context.region != Region::Schedule {
                    return self.out_of_scope(
                        name,
                        span,
                        "known to the schedules of a learner only",
                    );
                }
                let expr = if constant == Constant::Visits {
                    Expr::Visits
                } else {
                    Expr::Progress
                };
                return self.leaf(expr, Type::NUMBER, span);
            }
            Constant::Anywhere => {
                return Typed {
                    ty: Type::Anywhere,
                    value: Value::Anywhere,
                    span,
                };
            }
            Constant::Elapsed
                if !self.context.region.in_behavior() && self.context.region != Region::Let =>
            {
                return self.out_of_scope(
                    name,
                    span,
                    "how long a behaviour runs, known to it alone",
                );
            }
            _ => {}
        }
        if !self.has_world {
            self.report(
                Diagnostic::new(
                    Code::E0407,
                    span,
                    format!("`{name}` needs a world, and there is none"),
                )
                .label("known to a robot in its world"),
            );
            return Typed::error(span);
        }
        let drive = self.program.world.as_ref().map(|world| &world.robot.drive);
        let limit = |dim: Dim, value: Option<f64>| (Type::Quantity(dim), value);
        let (ty, number) = match constant {
            Constant::Heading => return self.leaf(Expr::Pose(Pose::Heading), angle, span),
            Constant::Touching => return self.leaf(Expr::Touching, Type::Bool, span),
            Constant::Elapsed => {
                return self.leaf(Expr::Elapsed, Type::Quantity(Dim::TIME), span);
            }
            Constant::Position => {
                let x = self.program.pool.leaf(Expr::Pose(Pose::X));
                let y = self.program.pool.leaf(Expr::Pose(Pose::Y));
                return Typed {
                    ty: Type::Point,
                    value: Value::Point(x, y),
                    span,
                };
            }
            Constant::NearestWall => {
                return Typed {
                    ty: Type::Wall(None),
                    value: Value::NearestWall,
                    span,
                };
            }
            Constant::MaxSpeed => limit(Dim::SPEED, drive.map(|drive| drive.max_speed)),
            Constant::MaxTurn => limit(Dim::TURN_RATE, drive.map(|drive| drive.max_turn)),
            _ => limit(Dim::TIME, self.tick),
        };
        let value = match number {
            Some(number) => Value::Scalar(self.program.pool.num(number)),
            None => Value::Unknown,
        };
        Typed { ty, value, span }
    }

    pub fn out_of_scope(&mut self, name: &str, span: Span, why: &str) -> Typed {
        self.report(
            Diagnostic::new(
                Code::E0307,
                span,
                format!("`{name}` cannot be asked in {}", self.context.region.name()),
            )
            .label(why),
        );
        Typed::error(span)
    }

    /// A call of a built-in name.
    pub fn built_in_call(&mut self, called: BuiltIn, reference: &'a Ref) -> Typed {
        use Function as F;
        let span = reference.span;
        let function = match called {
            BuiltIn::Unary(op) => return self.function_of_one(op, reference),
            BuiltIn::Binary(op) => return self.function_of_two(op, reference),
            BuiltIn::Function(function) => function,
        };
        match function {
            F::Any | F::All | F::Count | F::Nearest => self.quantified(function, reference),
            F::Disc | F::Rect | F::Polygon | F::Polyline | F::Line => {
                match self.shape(function, reference) {
                    Some(shape) => Typed {
                        ty: Type::Shape,
                        value: Value::Shape(shape),
                        span,
                    },
                    None => Typed::error(span),
                }
            }
            F::Distance | F::Bearing | F::Direction | F::Visible | F::Inside | F::Facing => {
                self.reading(function, reference)
            }
            F::Success | F::Failure | F::Done | F::Failed => self.ended(function, reference),
            F::Uniform | F::Normal | F::Chance | F::OneOf => self.random(function, reference),
            F::Clamp => self.clamp(reference),
        }
    }
}
