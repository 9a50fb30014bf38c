//! Expressions of an expected type, constants and numbers.

use crate::check::Checker;
use crate::check::context::Region;
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::check::report::{Draft, listed};
use crate::check::types::units::Dim;
use crate::check::types::{Type, Typed};
use crate::diagnostic::{Applicability, Code, suggest};
use crate::ir::expr::ExprId;
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::ast::{ArgKind, BinaryOp, Expr, ExprKind, Ref};
use crate::syntax::print;
use std::fmt;

/// What an expression is there for, as a message calls it.
#[derive(Clone, Copy, Debug)]
pub enum Role<'r> {
    /// What stands at one place of the text, such as "a condition".
    Called(&'r str),
    /// A parameter that is given a value, and whose it is.
    Argument(&'r str, &'r str),
}

impl fmt::Display for Role<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Called(what) => f.write_str(what),
            Self::Argument(parameter, of) => write!(f, "`{parameter}` of `{of}`"),
        }
    }
}

impl<'r> From<&'r str> for Role<'r> {
    fn from(what: &'r str) -> Self {
        Self::Called(what)
    }
}

impl<'r> From<&'r String> for Role<'r> {
    fn from(what: &'r String) -> Self {
        Self::Called(what)
    }
}

impl<'a> Checker<'a> {
    /// Checks an expression that has to be of a type.
    pub fn expect(&mut self, expr: &'a Expr, wanted: &Type, role: &str) -> Typed {
        let typed = self.expr_like(expr, wanted);
        self.coerce(typed, expr, wanted, role)
    }

    /// Reports an expression that is not of the wanted type; what comes back is of that type or an error.
    pub fn coerce<'r>(
        &mut self,
        typed: Typed,
        expr: &Expr,
        wanted: &Type,
        role: impl Into<Role<'r>>,
    ) -> Typed {
        if typed.ty.fits(wanted) {
            if typed.ty != Type::Error {
                self.warn_plain_ratio(expr, wanted);
            }
            return typed;
        }
        let found = self.mismatch(&typed, expr, wanted, role.into()).typed();
        self.clashes(expr, typed.span, wanted);
        found
    }

    /// Checks an expression that has to be of the type of another one.
    pub fn expect_like(&mut self, expr: &'a Expr, first: &Typed, role: &str) -> Typed {
        let typed = self.expr_like(expr, &first.ty);
        self.like(typed, expr, first, role)
    }

    /// Reports an expression that is not of the type of another one; what comes back is of that type or an error.
    pub fn like(&mut self, typed: Typed, expr: &'a Expr, first: &Typed, role: &str) -> Typed {
        if first.ty.join(&typed.ty).is_some() {
            self.warn_plain_ratio(expr, &first.ty);
            return typed;
        }
        self.mismatch(&typed, expr, &first.ty, role.into())
            .also(first.span, format!("this is {}", first.ty))
            .typed()
    }

    fn mismatch(&mut self, typed: &Typed, expr: &Expr, wanted: &Type, role: Role) -> Draft<'_> {
        let message = format!("{role} is {wanted}, not {}", typed.ty);
        let named = plain_ref(expr)
            .and_then(|name| self.names.value(&name.name.name, self.context.library));
        let is_variant = matches!(named, Some((Decl::Variant(..), _)));
        // A second place is no measure of how near the first one is.
        let is_place = typed.ty.is_named_target() || typed.ty == Type::Target;
        let is_argument = matches!(role, Role::Argument(..));
        let beside = is_place && is_argument && wanted.dim() == Some(Dim::LENGTH);
        let help = self
            .of_no_kind(typed, expr, wanted)
            .or_else(|| self.in_each_tick(typed, expr, wanted))
            .or_else(|| {
                self.of_the_moment(typed, expr, wanted)
                    .filter(|_| !is_argument)
            })
            .or_else(|| conversion(typed, expr, wanted, is_variant).filter(|_| !beside))
            .or_else(|| self.values_of(wanted));
        let kind = self.misspelt_kind(expr, &typed.ty, wanted);
        let place = (&typed.ty, wanted) == (&Type::Robot, &Type::Point);
        if let Some((kind, meant)) = kind {
            let name = print::expr(expr);
            let message = format!("`{name}` is used as one of the kind `{meant}`, and is none");
            let question = format!("did you mean the kind `{meant}`?");
            return self
                .error(Code::E0302, kind, message)
                .label(question.clone())
                .also(typed.span, format!("used as {wanted}"))
                .fix(question, kind, spelled(&meant), Applicability::Unsafe);
        }
        let draft = self
            .unlike(typed, wanted, message)
            .this_is(&typed.ty)
            .help_if(help)
            .unit_for(expr, wanted.dim().filter(|_| typed.ty.dim().is_some()))
            .minutes(expr, wanted.dim())
            .unit_of_gain(expr, &typed.ty, wanted)
            .units_within(expr, wanted.dim().filter(|_| typed.ty == Type::NUMBER));
        if place {
            let right = format!("pose({})", print::expr(expr));
            let title = format!("where it is: write `{right}`");
            return draft.fix(title, typed.span, right, Applicability::Unsafe);
        }
        draft
    }

    /// How a place gets the kind that is wanted: where it is declared, or where the parameter is that it stands for.
    fn of_no_kind(&self, typed: &Typed, expr: &Expr, wanted: &Type) -> Option<String> {
        let (Type::Place(None), Type::Place(Some(kind))) = (&typed.ty, wanted) else {
            return None;
        };
        let place = spelled(&plain_ref(expr).filter(|it| it.args.is_none())?.name.name);
        if self.context.lookup(&place).is_some() {
            return Some(format!("let it be of that kind: `{place}: {kind}`"));
        }
        match self.names.value(&place, self.context.library) {
            Some((Decl::Place(..), _)) => Some(format!(
                "a kind stands behind the name: `place {place}: {kind} = …`"
            )),
            _ => None,
        }
    }

    /// What keeps where the robot is, or a place, as the program runs.
    fn of_the_moment(&self, typed: &Typed, expr: &Expr, wanted: &Type) -> Option<String> {
        let runs = !matches!(
            self.context.region,
            Region::World | Region::Start | Region::StartHistory
        );
        let name = plain_ref(expr).map(|it| it.name.name.as_str());
        match (&typed.ty, wanted) {
            (Type::Point, Type::Place(_)) if matches!(name, Some("position" | "pose")) => {
                Some("what keeps where a robot was is a point: `state NAME: point = (1 m, 2 m)`".to_owned())
            }
            (Type::Place(_), Type::Point) if runs => Some(
                "where the robot is at this moment: `position`; what keeps a place is a `state NAME: place = …`"
                    .to_owned(),
            ),
            _ => None,
        }
    }

    /// What a rate comes to in a tick, where ticks go by.
    fn in_each_tick(&self, typed: &Typed, expr: &Expr, wanted: &Type) -> Option<String> {
        let ticks = self.context.region != Region::Schedule;
        let sought = is_rate(typed.ty.dim()?) && wanted.dim()? == Dim::NONE;
        (ticks && sought).then(|| format!("so much in every tick: `{} * tick`", print::expr(expr)))
    }

    /// The values of an enum, as advice.
    pub fn values_of(&self, wanted: &Type) -> Option<String> {
        let Type::Enum(of) = wanted else { return None };
        let names: Vec<String> = self.variants(of).iter().map(ToString::to_string).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        (!names.is_empty()).then(|| format!("`{of}` has {}", listed(&names, "and")))
    }

    /// Where the kind of a place or a wall is said, and the kind that was likely meant by it.
    fn misspelt_kind(&self, expr: &Expr, is: &Type, wanted: &Type) -> Option<(Span, String)> {
        let (
            Type::Place(Some(said)) | Type::Wall(Some(said)),
            Type::Place(Some(meant)) | Type::Wall(Some(meant)),
        ) = (is, wanted)
        else {
            return None;
        };
        let name = &plain_ref(expr)?.name.name;
        let (Decl::Place(_, Some(kind)) | Decl::Wall(_, Some(kind)), _) =
            self.names.value(name, false)?
        else {
            return None;
        };
        suggest::nearest(said, [meant.as_str()])?;
        Some((kind.span, meant.clone()))
    }

    /// Reports an expression whose unit, or else whose type, is not that of `wanted`.
    pub fn unlike(&mut self, typed: &Typed, wanted: &Type, message: String) -> Draft<'_> {
        let code = match (typed.ty.dim(), wanted.dim()) {
            (Some(_), Some(_)) => Code::E0301,
            _ => Code::E0302,
        };
        self.error(code, typed.span, message)
    }

    /// Checks an expression that has to be a constant number of a dimension.
    pub fn constant(&mut self, expr: &'a Expr, wanted: &Type, role: &str) -> Option<f64> {
        let typed = self.expect(expr, wanted, role);
        self.constant_part(typed.scalar()?, typed.span, role)
    }

    /// The number that a part of the expression at `span` is; reported where it is not a finite constant.
    pub fn constant_part(&mut self, part: ExprId, span: Span, role: &str) -> Option<f64> {
        match self.program.pool.constant(part) {
            Some(number) if number.is_finite() => Some(number),
            Some(number) => self
                .error(Code::E0309, span, format!("{role} is not a number"))
                .label(if number.is_nan() {
                    "the result is undefined"
                } else {
                    "the result is infinite"
                })
                .none(),
            None => self
                .error(Code::E0303, span, format!("{role} has to be a constant"))
                .label("this changes as the program runs")
                .none(),
        }
    }

    /// Reports a constant that is no probability.
    pub fn probability(&mut self, typed: &Typed, role: &str) -> Option<()> {
        let value = typed.scalar().and_then(|id| self.program.pool.constant(id));
        let Some(value) = value.filter(|value| !(0.0..=1.0).contains(value)) else {
            return Some(());
        };
        // The warning that it has no `%` is the lesser mistake.
        let at = typed.span;
        self.diagnostics
            .retain(|said| said.code != Code::W0301 || said.span() != at);
        let percent = value * 100.0;
        let is_percent = typed.ty == Type::NUMBER && (1.0..=100.0).contains(&value);
        let draft = self.out_of_range(
            at,
            format!("{role} goes from 0% to 100%"),
            &format!("this is {percent} %"),
        );
        match is_percent {
            true => draft.fix("write `%`", at.after(), "%", Applicability::Unsafe),
            false => draft,
        }
        .none()
    }

    /// The dimension of a number; anything else is reported.
    pub fn number(&mut self, typed: &Typed) -> Option<Dim> {
        if typed.ty == Type::Error {
            return None;
        }
        let dim = typed.ty.dim();
        if dim.is_none() {
            self.error(
                Code::E0302,
                typed.span,
                format!("a number is needed here, not {}", typed.ty),
            )
            .this_is(&typed.ty)
            .help_if((typed.ty == Type::Point).then(|| {
                "a point is reckoned with by its coordinates: `(p.x + 1 m, p.y)`".to_owned()
            }));
        }
        dim
    }
}

/// What to do about a wall that stands for a place.
pub const PLACE_FOR_WALL: &str =
    "what a robot goes to is a place: `place NAME = disc((1 m, 2 m), 20 cm)`";

/// How a number of one unit becomes one of another that people take for it, and a place one of a kind.
fn conversion(typed: &Typed, expr: &Expr, wanted: &Type, is_variant: bool) -> Option<String> {
    let is_target = typed.ty.is_named_target() || typed.ty == Type::Target;
    if is_target && matches!(expr.kind, ExprKind::Ref(_)) {
        let target = print::expr(expr);
        match wanted.dim() {
            Some(Dim::ANGLE) => return Some(format!("the way to it: `direction({target})`")),
            Some(Dim::LENGTH) => return Some(format!("how far it is: `distance({target})`")),
            _ => {}
        }
    }
    if let (Type::Point, Type::Shape) = (&typed.ty, wanted) {
        let point = print::expr(expr);
        return Some(format!("the disc around it: `disc({point}, 20 cm)`"));
    }
    if let (Type::Point, Type::Place(_)) = (&typed.ty, wanted) {
        let point = print::expr(expr);
        return Some(format!(
            "give it a name in the world: `place NAME = disc({point}, 20 cm)`"
        ));
    }
    if let (Type::Wall(_), Type::Place(_)) = (&typed.ty, wanted) {
        return Some(PLACE_FOR_WALL.to_owned());
    }
    if let (Type::Robot, Type::Place(_)) = (&typed.ty, wanted) {
        let robot = print::expr(expr);
        return Some(format!(
            "a robot is no place: `chase({robot})` and `approach({robot})` go after it"
        ));
    }
    if let (Type::Place(_), Type::Point) = (&typed.ty, wanted) {
        let place = print::expr(expr);
        return Some(format!(
            "a start in a place is `pose = {place}`; `distance({place})` measures to it"
        ));
    }
    if let (Type::Bool, Some(Dim::NONE), ExprKind::Ref(Ref { args: None, .. })) =
        (&typed.ty, wanted.dim(), &expr.kind)
    {
        let asked = print::expr(expr);
        return Some(format!(
            "a number for each: `if {asked} {{ 1 }} else {{ 0 }}`"
        ));
    }
    if let (Type::Point, ExprKind::Ref(word)) = (wanted, &expr.kind)
        && word.name.name == "anywhere"
    {
        return Some("anywhere, however it looks: `pose = anywhere`".to_owned());
    }
    if let (Type::Ratio, Type::Bool, ExprKind::Number(_)) = (&typed.ty, wanted, &expr.kind) {
        let odds = print::expr(expr);
        return Some(format!("in so many of all cases: `chance({odds})`"));
    }
    if *wanted == Type::Bool {
        return as_condition(typed, expr, is_variant);
    }
    let is_ratio = *wanted == Type::Ratio;
    let (is, wanted) = (typed.ty.dim()?, wanted.dim()?);
    let literal = match &expr.kind {
        ExprKind::Number(literal) => Some(literal),
        _ => None,
    };
    if is == wanted || is == Dim::NONE {
        return None;
    }
    if is.times(wanted, 1) == Dim::NONE {
        let asked = print::expr(expr);
        return Some(format!("it is one divided by that: `1 / ({asked})`"));
    }
    if gain(expr).is_some() && wanted.times(is, -1) == Dim::FREQUENCY {
        return None;
    }
    if is != Dim::TIME && is.times(Dim::TIME, -1) == wanted {
        let Some(literal) = literal else {
            let off = print::expr(expr);
            return Some(format!("a gain makes a rate of it: `2 Hz * {off}`"));
        };
        let unit = &literal.unit.as_ref()?.text;
        return Some(format!("per second: `{} {unit}/s`", literal.digits));
    }
    // What a rate comes to is said by `in_each_tick`.
    if wanted == Dim::NONE && !is_rate(is) {
        if let Some(literal) = literal {
            let digits = &literal.digits;
            return Some(match is_ratio {
                true => format!("a ratio is written in per cent: `{digits}%`"),
                false => format!("a plain number has no unit: `{digits}`"),
            });
        }
        let unit = is.unit()?;
        return Some(format!(
            "divided by a unit it is a plain number: `… / (1 {unit})`"
        ));
    }
    None
}

/// The plain number that a product begins with.
fn gain(expr: &Expr) -> Option<&Expr> {
    match &expr.kind {
        ExprKind::Binary { op, left, .. } if op.node == BinaryOp::Mul => match is_literal(left) {
            true => Some(left),
            false => gain(left),
        },
        _ => None,
    }
}

/// Whether it is so much in a time.
fn is_rate(dim: Dim) -> bool {
    dim.times(Dim::TIME, 1) == Dim::NONE
}

/// What asks whether something holds of a value that is no truth value.
fn as_condition(typed: &Typed, expr: &Expr, is_variant: bool) -> Option<String> {
    if matches!(expr.kind, ExprKind::Number(_)) {
        return None;
    }
    let asked = print::expr(expr);
    match &typed.ty {
        Type::Behavior => Some(format!("whether it has ended: `success({asked})`")),
        Type::Enum(_) if is_variant => Some(format!("compare something with it: `… == {asked}`")),
        Type::Enum(_) => Some(format!("compare it: `{asked} == …`")),
        Type::Place(_) => Some(format!("whether the robot is there: `inside({asked})`")),
        Type::Sensor => Some(format!("what it measures: `distance({asked}) < …`")),
        ty if ty.dim().is_some() => Some(format!("compare it: `{asked} > …`")),
        _ => None,
    }
}

/// The functions whose value is of the type of their arguments.
pub const PASSING: [&str; 7] = ["uniform", "normal", "one_of", "min", "max", "clamp", "tune"];

/// Whether an expression is a literal without a unit, perhaps signed.
pub fn is_literal(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(literal) => literal.unit.is_none(),
        ExprKind::Unary { operand, .. } => is_literal(operand),
        ExprKind::Paren(inner) => is_literal(inner),
        _ => false,
    }
}

impl Draft<'_> {
    /// Offers to write the unit of a dimension after each literal among the arguments of a function that passes it on.
    pub fn units_within(self, expr: &Expr, dim: Option<Dim>) -> Self {
        let ExprKind::Ref(Ref {
            name,
            args: Some(args),
            ..
        }) = &expr.kind
        else {
            return self;
        };
        let Some(unit) = dim.and_then(Dim::unit) else {
            return self;
        };
        let values = args.iter().map(|arg| match &arg.kind {
            ArgKind::Positional(value) if is_literal(value) => Some(print::expr(value)),
            _ => None,
        });
        let Some(values) = values.collect::<Option<Vec<String>>>() else {
            return self;
        };
        if !PASSING.contains(&name.name.as_str()) || values.is_empty() {
            return self;
        }
        // As for one number: whole angles are degrees.
        let whole = values.iter().all(|value| !value.contains('.'));
        let unit = if unit == "rad" && whole {
            "deg"
        } else {
            unit.as_str()
        };
        let values: Vec<String> = values
            .iter()
            .map(|value| format!("{value} {unit}"))
            .collect();
        let right = format!("{}({})", name.name, values.join(", "));
        self.fix(
            format!("give each its unit: `{right}`"),
            expr.span,
            right,
            Applicability::Unsafe,
        )
    }

    /// Offers to write `min` after a number of minutes, or `ms` after one of so many that they are hardly minutes.
    pub fn minutes(self, expr: &Expr, wanted: Option<Dim>) -> Self {
        let ExprKind::Number(literal) = &expr.kind else {
            return self;
        };
        let metres = literal.unit.as_ref().is_some_and(|unit| unit.text == "m");
        if !metres || wanted != Some(Dim::TIME) {
            return self;
        }
        let many = literal.value >= 100.0;
        let (what, unit) = if many {
            ("milliseconds", "ms")
        } else {
            ("minutes", "min")
        };
        let right = format!("{} {unit}", literal.digits);
        self.fix(
            format!("{what} are `{unit}`: write `{right}`"),
            expr.span,
            right,
            Applicability::Unsafe,
        )
    }

    /// Offers to write the unit of a gain that makes a rate of an error: `3 * error` is none, `3 Hz * error` is.
    fn unit_of_gain(self, expr: &Expr, is: &Type, wanted: &Type) -> Self {
        let rate = is.dim().zip(wanted.dim());
        match gain(expr) {
            Some(gain)
                if rate.is_some_and(|(is, wanted)| wanted.times(is, -1) == Dim::FREQUENCY) =>
            {
                let right = format!("{} Hz", print::expr(gain));
                self.fix(
                    format!("a gain that makes a rate of something has a unit: write `{right}`"),
                    gain.span,
                    right,
                    Applicability::Unsafe,
                )
            }
            _ => self,
        }
    }

    /// Offers to write the unit of a dimension after a literal that lacks it.
    pub fn unit_for(self, expr: &Expr, dim: Option<Dim>) -> Self {
        let Some(unit) = dim.filter(|_| is_literal(expr)).and_then(Dim::unit) else {
            return self;
        };
        // Who leaves the unit of an angle out has degrees in mind, unless it is no whole number.
        let whole = |expr: &Expr| matches!(&expr.kind, ExprKind::Number(literal) if literal.value.fract() == 0.0);
        let unit = match &expr.kind {
            _ if unit != "rad" => unit,
            ExprKind::Unary { operand, .. } if whole(operand) => "deg".to_owned(),
            _ if whole(expr) => "deg".to_owned(),
            _ => unit,
        };
        let zero = matches!(&expr.kind, ExprKind::Number(literal) if literal.value == 0.0);
        self.fix(
            format!("give it its unit, ` {unit}`"),
            expr.span.after(),
            format!(" {unit}"),
            if zero {
                Applicability::Safe
            } else {
                Applicability::Unsafe
            },
        )
    }
}
