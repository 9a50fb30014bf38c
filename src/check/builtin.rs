//! The names that the compiler knows: constants of the moment, functions, draws.

use super::Checker;
use super::context::{Binding, Region};
use super::types::{Type, Typed, Value};
use super::units::Dim;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Binary, Draw, Expr, Pose, Unary};
use crate::ir::tree::Status;
use crate::source::Span;
use crate::syntax::ast::{self, ArgKind, Ref};

macro_rules! named {
    ($(#[$doc:meta])* $set:ident { $($variant:ident $name:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $set { $($variant,)* }

        impl $set {
            const NAMES: &'static [(&'static str, $set)] = &[$(($name, $set::$variant),)*];

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
    /// Names with arguments.
    Function {
        Abs "abs",
        Sign "sign",
        Min "min",
        Max "max",
        Clamp "clamp",
        Wrap "wrap",
        Sqrt "sqrt",
        Exp "exp",
        Ln "ln",
        Floor "floor",
        Ceil "ceil",
        Round "round",
        Sin "sin",
        Cos "cos",
        Tan "tan",
        Asin "asin",
        Acos "acos",
        Atan "atan",
        Atan2 "atan2",
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

/// Every built-in name.
pub fn names() -> impl Iterator<Item = &'static str> {
    let constants = Constant::NAMES.iter().map(|(name, _)| *name);
    constants.chain(Function::NAMES.iter().map(|(name, _)| *name))
}

impl<'a> Checker<'a> {
    /// A built-in name without arguments.
    pub(super) fn built_in_value(&mut self, constant: Constant, span: Span) -> Typed {
        let angle = Type::Quantity(Dim::ANGLE);
        match constant {
            Constant::Visits | Constant::Progress => {
                if self.context.region != Region::Schedule {
                    return self.out_of_scope(span, "this is known to a learner's schedules only");
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
                return self.out_of_scope(span, "time elapses for a behaviour only");
            }
            _ => {}
        }
        if !self.has_world {
            self.report(
                Diagnostic::new(Code::E0407, span, "this needs a world, and there is none")
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

    fn out_of_scope(&mut self, span: Span, why: &str) -> Typed {
        self.report(
            Diagnostic::new(
                Code::E0307,
                span,
                format!("this cannot be asked in {}", self.context.region.name()),
            )
            .label(why),
        );
        Typed::error(span)
    }

    /// A call of a built-in function.
    pub(super) fn built_in_call(&mut self, function: Function, reference: &'a Ref) -> Typed {
        let span = reference.span;
        use Function as F;
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
            F::Min | F::Max => {
                let op = if function == F::Min {
                    Binary::Min
                } else {
                    Binary::Max
                };
                self.extremum(op, reference)
            }
            F::Clamp => self.clamp(reference),
            F::Atan2 => {
                let Some((a, b)) = self.two_alike(reference) else {
                    return Typed::error(span);
                };
                self.lifted(
                    Type::Quantity(Dim::ANGLE),
                    span,
                    &[&a, &b],
                    |pool, ids| match ids {
                        [a, b] => Some(pool.binary(Binary::Atan2, *a, *b)),
                        _ => None,
                    },
                )
            }
            _ => self.function_of_one(function, reference),
        }
    }

    /// The positional arguments, if there are as many as are wanted.
    pub(super) fn positional(
        &mut self,
        reference: &'a Ref,
        least: usize,
        most: usize,
    ) -> Option<Vec<&'a ast::Expr>> {
        let Some(args) = &reference.args else {
            self.report(
                Diagnostic::new(
                    Code::E0305,
                    reference.span,
                    format!("`{}` is a function", reference.name.name),
                )
                .label(format!("call it: `{}(…)`", reference.name.name)),
            );
            return None;
        };
        let mut values = Vec::new();
        for arg in args {
            match &arg.kind {
                ArgKind::Positional(value) => values.push(value),
                ArgKind::Named(name, value) => {
                    self.report(
                        Diagnostic::new(
                            Code::E0305,
                            name.span,
                            format!("`{}` takes its arguments by position", reference.name.name),
                        )
                        .label("no parameter has a name"),
                    );
                    self.expr(value);
                    return None;
                }
                ArgKind::Binder { .. } => {
                    self.report(
                        Diagnostic::new(
                            Code::E0305,
                            arg.span,
                            format!("`{}` takes no `in`", reference.name.name),
                        )
                        .label("only any, all, count and nearest range over a kind"),
                    );
                    return None;
                }
            }
        }
        if (least..=most).contains(&values.len()) {
            return Some(values);
        }
        let wanted = match (least, most) {
            (1, 1) => "one argument".to_owned(),
            (a, usize::MAX) => format!("{a} arguments or more"),
            (a, b) if a == b => format!("{a} arguments"),
            (a, b) => format!("{a} to {b} arguments"),
        };
        let surplus = args.get(most).map_or(reference.span, |arg| arg.span);
        self.report(
            Diagnostic::new(
                Code::E0305,
                surplus,
                format!(
                    "`{}` takes {wanted}, not {}",
                    reference.name.name,
                    values.len()
                ),
            )
            .label(if values.len() > most {
                "one too many"
            } else {
                "too few"
            }),
        );
        for value in values {
            self.expr(value);
        }
        None
    }

    fn function_of_one(&mut self, function: Function, reference: &'a Ref) -> Typed {
        use Function as F;
        let span = reference.span;
        let Some(&[value]) = self.positional(reference, 1, 1).as_deref() else {
            return Typed::error(span);
        };
        let angle = Type::Quantity(Dim::ANGLE);
        let role = format!("the argument of `{}`", reference.name.name);
        let same = |ty: &Type| ty.clone();
        let (op, argument, ty): (Unary, Typed, Type) = match function {
            F::Sin | F::Cos | F::Tan => {
                let op = match function {
                    F::Sin => Unary::Sin,
                    F::Cos => Unary::Cos,
                    _ => Unary::Tan,
                };
                (op, self.expect(value, &angle, &role), Type::NUMBER)
            }
            F::Asin | F::Acos | F::Atan => {
                let op = match function {
                    F::Asin => Unary::Asin,
                    F::Acos => Unary::Acos,
                    _ => Unary::Atan,
                };
                (op, self.expect(value, &Type::NUMBER, &role), angle)
            }
            F::Wrap => (Unary::Wrap, self.expect(value, &angle, &role), angle),
            F::Exp | F::Ln | F::Floor | F::Ceil | F::Round => {
                let op = match function {
                    F::Exp => Unary::Exp,
                    F::Ln => Unary::Ln,
                    F::Floor => Unary::Floor,
                    F::Ceil => Unary::Ceil,
                    _ => Unary::Round,
                };
                (op, self.expect(value, &Type::NUMBER, &role), Type::NUMBER)
            }
            _ => {
                let argument = self.expr(value);
                let Some(dim) = self.number(&argument) else {
                    return Typed::error(span);
                };
                match function {
                    F::Sign => (Unary::Sign, argument, Type::NUMBER),
                    F::Sqrt => match dim.root() {
                        Some(root) => (Unary::Sqrt, argument, Type::Quantity(root)),
                        None => {
                            self.report(
                                Diagnostic::new(
                                    Code::E0301,
                                    argument.span,
                                    format!("{dim} has no square root with a unit"),
                                )
                                .label("the exponents of its unit are odd"),
                            );
                            return Typed::error(span);
                        }
                    },
                    _ => {
                        let ty = same(&argument.ty);
                        (Unary::Abs, argument, ty)
                    }
                }
            }
        };
        self.lifted(ty, span, &[&argument], |pool, ids| match ids {
            [a] => Some(pool.unary(op, *a)),
            _ => None,
        })
    }

    fn two_alike(&mut self, reference: &'a Ref) -> Option<(Typed, Typed)> {
        let values = self.positional(reference, 2, 2)?;
        let [first, second] = values.as_slice() else {
            return None;
        };
        let a = self.expr(first);
        self.number(&a)?;
        let role = format!("the second argument of `{}`", reference.name.name);
        let b = self.expect(second, &a.ty, &role);
        (b.ty != Type::Error).then_some((a, b))
    }

    fn extremum(&mut self, op: Binary, reference: &'a Ref) -> Typed {
        let span = reference.span;
        let Some(values) = self.positional(reference, 2, usize::MAX) else {
            return Typed::error(span);
        };
        let role = format!("every argument of `{}`", reference.name.name);
        let mut result: Option<Typed> = None;
        for value in values {
            let next = match &result {
                None => {
                    let first = self.expr(value);
                    if self.number(&first).is_none() {
                        return Typed::error(span);
                    }
                    first
                }
                Some(so_far) => {
                    let ty = so_far.ty.clone();
                    let next = self.expect(value, &ty, &role);
                    if next.ty == Type::Error {
                        return Typed::error(span);
                    }
                    self.lifted(ty, span, &[so_far, &next], |pool, ids| match ids {
                        [a, b] => Some(pool.binary(op, *a, *b)),
                        _ => None,
                    })
                }
            };
            result = Some(next);
        }
        result.unwrap_or_else(|| Typed::error(span))
    }

    /// `clamp(x, limit)` is x within ± limit, `clamp(x, low, high)` within an interval.
    fn clamp(&mut self, reference: &'a Ref) -> Typed {
        let span = reference.span;
        let Some(values) = self.positional(reference, 2, 3) else {
            return Typed::error(span);
        };
        let mut checked: Vec<Typed> = Vec::new();
        for value in values {
            let next = match checked.first() {
                None => {
                    let first = self.expr(value);
                    if self.number(&first).is_none() {
                        return Typed::error(span);
                    }
                    first
                }
                Some(first) => {
                    let ty = first.ty.clone();
                    self.expect(value, &ty, "a limit of `clamp`")
                }
            };
            if next.ty == Type::Error {
                return Typed::error(span);
            }
            checked.push(next);
        }
        let ty = checked.first().map_or(Type::Error, |x| x.ty.clone());
        let operands: Vec<&Typed> = checked.iter().collect();
        self.lifted(ty, span, &operands, |pool, ids| {
            let (x, low, high) = match ids {
                [x, limit] => (*x, pool.unary(Unary::Neg, *limit), *limit),
                [x, low, high] => (*x, *low, *high),
                _ => return None,
            };
            let floor = pool.binary(Binary::Max, x, low);
            Some(pool.binary(Binary::Min, floor, high))
        })
    }

    /// `success(b)`, `failure(b)`: the behaviour ended so in this tick; in a `history` line, that it did.
    fn ended(&mut self, function: Function, reference: &'a Ref) -> Typed {
        let span = reference.span;
        let Some(&[value]) = self.positional(reference, 1, 1).as_deref() else {
            return Typed::error(span);
        };
        let region = self.context.region;
        if matches!(function, Function::Done | Function::Failed) {
            return self.out_of_scope(span, "the history window is asked in the guards of trees");
        }
        if !region.sees_events() && !matches!(region, Region::StartHistory | Region::Let) {
            return self.out_of_scope(span, "behaviours end between events and effects only");
        }
        let behavior = self.expect(value, &Type::Behavior, "what ends");
        let failed = function == Function::Failure;
        let ty = if region == Region::StartHistory {
            Type::Termination
        } else {
            Type::Bool
        };
        let Value::Behavior(id) = behavior.value else {
            return Typed {
                ty: if behavior.ty == Type::Error {
                    Type::Error
                } else {
                    ty
                },
                value: Value::Unknown,
                span,
            };
        };
        if region == Region::StartHistory {
            let code = id.index() * 2 + usize::from(failed);
            let code = self.program.pool.num(code as f64);
            return Typed {
                ty,
                value: Value::Scalar(code),
                span,
            };
        }
        let status = if failed {
            Status::Failure
        } else {
            Status::Success
        };
        self.leaf(Expr::Ended(id, status), ty, span)
    }

    fn random(&mut self, function: Function, reference: &'a Ref) -> Typed {
        let span = reference.span;
        if !self.context.region.draws() {
            self.report(
                Diagnostic::new(
                    Code::E0306,
                    span,
                    format!(
                        "nothing is drawn at random in {}",
                        self.context.region.name()
                    ),
                )
                .label("its value would change from one look to the next")
                .help("draw it in a `local`, an effect or a `start` line, and read that"),
            );
            return Typed::error(span);
        }
        match function {
            Function::Uniform | Function::Normal => {
                let Some((a, b)) = self.two_alike(reference) else {
                    return Typed::error(span);
                };
                let ty = a.ty.clone();
                self.lifted(ty, span, &[&a, &b], |pool, ids| match ids {
                    [a, b] if function == Function::Uniform => {
                        Some(pool.draw(Draw::Uniform(*a, *b)))
                    }
                    [a, b] => Some(pool.draw(Draw::Normal(*a, *b))),
                    _ => None,
                })
            }
            Function::Chance => {
                let Some(&[value]) = self.positional(reference, 1, 1).as_deref() else {
                    return Typed::error(span);
                };
                let p = self.expect(value, &Type::Ratio, "a chance");
                self.lifted(Type::Bool, span, &[&p], |pool, ids| match ids {
                    [p] => Some(pool.draw(Draw::Chance(*p))),
                    _ => None,
                })
            }
            _ => self.one_of(reference),
        }
    }

    fn one_of(&mut self, reference: &'a Ref) -> Typed {
        let span = reference.span;
        let Some(values) = self.positional(reference, 1, usize::MAX) else {
            return Typed::error(span);
        };
        let mut choices: Vec<Typed> = Vec::new();
        for value in values {
            let next = match choices.first() {
                None => self.expr(value),
                Some(first) => {
                    let ty = first.ty.clone();
                    self.expect(value, &ty, "every choice of `one_of`")
                }
            };
            if next.ty == Type::Error {
                return Typed::error(span);
            }
            choices.push(next);
        }
        let count = u32::try_from(choices.len()).unwrap_or(u32::MAX);
        let index = self.program.pool.draw(Draw::Pick(count));
        let mut choices = choices.into_iter().enumerate().rev();
        let Some((_, mut result)) = choices.next() else {
            return Typed::error(span);
        };
        for (i, choice) in choices {
            let i = self.program.pool.num(i as f64);
            let is = self.program.pool.binary(Binary::Eq, index, i);
            let condition = Typed {
                ty: Type::Bool,
                value: Value::Scalar(is),
                span,
            };
            let ty = result.ty.clone();
            result = self.select(&condition, &choice, &result, ty, span);
        }
        result.span = span;
        result
    }

    /// `any(b in bush: …)` and its relatives.
    fn quantified(&mut self, function: Function, reference: &'a Ref) -> Typed {
        let span = reference.span;
        let binder = match reference.args.as_deref() {
            Some([arg]) => match &arg.kind {
                ArgKind::Binder { name, domain, body } => Some((name, domain, body)),
                _ => None,
            },
            _ => None,
        };
        let Some((name, domain, body)) = binder else {
            self.report(
                Diagnostic::new(
                    Code::E0305,
                    span,
                    format!("`{}` ranges over a kind", reference.name.name),
                )
                .label(format!("write `{}(x in KIND: …)`", reference.name.name)),
            );
            return Typed::error(span);
        };
        let ty = self.named_type(domain);
        if ty == Type::Error {
            return Typed::error(span);
        }
        if !matches!(ty, Type::Place(_) | Type::Wall(_) | Type::Enum(_)) {
            self.report(
                Diagnostic::new(
                    Code::E0302,
                    domain.span,
                    format!("`{}` has no members to range over", domain.name),
                )
                .label("a kind of places or walls, or an enum, is needed"),
            );
            return Typed::error(span);
        }
        self.context.scope.push(Binding {
            name: name.name.clone(),
            ty: ty.clone(),
            value: Value::Unknown,
            locals: Vec::new(),
            span: name.span,
        });
        if let Some(body) = body {
            let role = format!("what `{}` says of each", reference.name.name);
            self.expect(body, &Type::Bool, &role);
        } else if matches!(function, Function::Any | Function::All) {
            self.report(
                Diagnostic::new(
                    Code::E0305,
                    span,
                    format!("`{}` says nothing of its members", reference.name.name),
                )
                .label("a condition is missing: `… in KIND: condition`"),
            );
        }
        self.context.scope.pop();
        self.not_yet(span, "any, all, count and nearest");
        let ty = match function {
            Function::Count => Type::NUMBER,
            Function::Nearest => ty,
            _ => Type::Bool,
        };
        Typed {
            ty,
            value: Value::Unknown,
            span,
        }
    }
}
