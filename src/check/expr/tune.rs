//! `tune(value, low .. high)`: a constant that may be tuned.

use crate::check::Checker;
use crate::check::context::Region;
use crate::check::tune::Key;
use crate::check::types::units::{Dim, Scale, meaning};
use crate::check::types::{Type, Typed};
use crate::diagnostic::{Applicability, Code};
use crate::ir::tunable::{Tunable, Unit};
use crate::source::Span;
use crate::syntax::ast::{ArgKind, Expr, ExprKind, Literal, Ref};
use crate::syntax::print;

/// The arguments of a `tune`: the value, and perhaps a range.
type Arguments<'a> = (&'a Expr, Option<(&'a Expr, &'a Expr)>);

impl<'a> Checker<'a> {
    /// `tune(value)`, `tune(value, low .. high)`: the value, or another one that is tried in its place.
    pub fn tune(&mut self, reference: &'a Ref) -> Option<Typed> {
        let (value, range) = self.tune_arguments(reference)?;
        let typed = self.expr(value);
        self.number(&typed)?;
        if !self.may_tune(reference) {
            return None;
        }
        if self.mentions_parameter(value) {
            return self
                .error(
                    Code::E0303,
                    value.span,
                    "what is tuned has to be a constant",
                )
                .label("this is another number in every use")
                .help("write `tune(…)` where the argument is given")
                .none();
        }
        let number = self.constant_part(typed.scalar()?, value.span, "what is tuned")?;
        let (low, high) = match range {
            Some((low, high)) => {
                let from = self.end_of_range(low, &typed)?;
                let to = self.end_of_range(high, &typed)?;
                self.in_range(number, value.span, (from, to), low.span.to(high.span))?
            }
            None => self.half_to_double(number, &typed.ty, value.span)?,
        };
        let Some(unit) = self.unit_of_tuned(value, range.map(|(low, _)| low), &typed.ty) else {
            return self
                .error(
                    Code::E0304,
                    value.span,
                    format!("{} cannot be tuned", typed.ty),
                )
                .label("no literal has a unit of this kind")
                .help("tune a part of it that has one")
                .none();
        };
        let tunable = Tunable {
            name: String::new(),
            value: in_unit(&unit, number),
            low: in_unit(&unit, low),
            high: in_unit(&unit, high),
            unit,
        };
        let key = match self.given {
            Some((of, parameter)) => {
                let range = range.map(|(low, high)| (print::expr(low), print::expr(high)));
                let text = format!("{} {range:?}", print::expr(value));
                Key::Argument(of.to_owned(), parameter.to_owned(), text)
            }
            None => Key::At(value.span),
        };
        let tried = self.tunes.meet(key, value.span, tunable);
        let id = self.program.pool.num(tried.unwrap_or(number));
        Some(Typed::new(typed.ty, Some(id), reference.span))
    }

    fn tune_arguments(&mut self, reference: &'a Ref) -> Option<Arguments<'a>> {
        let kinds: Vec<&'a ArgKind> = match &reference.args {
            Some(args) => args.iter().map(|arg| &arg.kind).collect(),
            None => Vec::new(),
        };
        match kinds.as_slice() {
            [ArgKind::Positional(value)] => Some((value, None)),
            [ArgKind::Positional(value), ArgKind::Range(low, high)] => {
                Some((value, Some((low, high))))
            }
            kinds => {
                let message = "`tune` takes a value and a range";
                let draft = self
                    .error(Code::E0305, reference.span, message)
                    .label("these are other arguments");
                match kinds {
                    [_, ArgKind::Positional(low), ArgKind::Positional(high)] => {
                        let gap = Span {
                            start: low.span.end,
                            end: high.span.start,
                            ..low.span
                        };
                        let title = "put `..` between the ends of the range";
                        draft.fix(title, gap, " .. ", Applicability::Unsafe).none()
                    }
                    _ => draft.help("for example: `tune(25%, 5% .. 60%)`").none(),
                }
            }
        }
    }

    /// Whether this part of the program is the robot's, and no part of what it has to solve; reported if not.
    fn may_tune(&mut self, reference: &Ref) -> bool {
        let region = self.context.region;
        let own = matches!(
            region,
            Region::Let
                | Region::Predicate
                | Region::Clause
                | Region::Local
                | Region::Control
                | Region::Tree
        );
        // An argument belongs to the behaviour or the predicate that it is given to.
        if !own && self.given.is_none() && !self.context.is_given {
            self.error(
                Code::E0307,
                reference.name.span,
                format!("nothing is tuned in {}", region.name()),
            )
            .label("this belongs to what the robot has to solve")
            .help(
                "tune predicates, behaviours and trees, and the shared expressions that they use",
            );
            return false;
        }
        true
    }

    fn end_of_range(&mut self, end: &'a Expr, value: &Typed) -> Option<f64> {
        let role = "the end of a range";
        let typed = self.expect_like(end, value, role);
        self.constant_part(typed.scalar()?, end.span, role)
    }

    /// The range, if the value is in it; reported if not.
    fn in_range(
        &mut self,
        value: f64,
        at: Span,
        (low, high): (f64, f64),
        range: Span,
    ) -> Option<(f64, f64)> {
        if low >= high {
            return self
                .out_of_range(range, "the range is empty", "this goes from less to more")
                .none();
        }
        if value < low || value > high {
            return self
                .out_of_range(
                    at,
                    "the value in use is outside of its range",
                    "this is used when nobody tunes",
                )
                .also(range, "the range")
                .none();
        }
        Some((low, high))
    }

    /// The range of a value that is given without one.
    fn half_to_double(&mut self, value: f64, ty: &Type, at: Span) -> Option<(f64, f64)> {
        if value == 0.0 {
            return self
                .out_of_range(
                    at,
                    "0 needs a range to be tuned in",
                    "half of it and double are 0, too",
                )
                .help("give the range: `tune(VALUE, LOW .. HIGH)`")
                .none();
        }
        let (low, high) = (value / 2.0, value * 2.0);
        Some(match ty {
            Type::Ratio if 0.0 < value && value < 1.0 => (low, high.min(1.0)),
            _ => (low.min(high), low.max(high)),
        })
    }

    /// The unit in which a number is tuned: its own, or that of its range.
    fn unit_of_tuned(&self, value: &Expr, low: Option<&Expr>, ty: &Type) -> Option<Unit> {
        let literals = [Some(value), low].into_iter().flatten().find_map(literal);
        let written = literals.and_then(|literal| {
            let unit = literal.unit.as_ref()?;
            Some(meaning(unit, self.tick)?.scale.of_unit(&unit.text))
        });
        let other = || match (ty, ty.dim()?) {
            (Type::Ratio, _) => Some(Scale::PERCENT.of_unit("%")),
            (_, Dim::NONE) => Some(Scale::ONE.of_unit("")),
            (_, dim) => Some(Scale::ONE.of_unit(&dim.unit()?)),
        };
        written.or_else(other)
    }
}

/// The literal that an expression is, perhaps signed.
fn literal(expr: &Expr) -> Option<&Literal> {
    match &expr.kind {
        ExprKind::Number(literal) => Some(literal),
        ExprKind::Unary { operand, .. } => literal(operand),
        ExprKind::Paren(inner) => literal(inner),
        _ => None,
    }
}

/// A number in SI base units in another unit, without the last digits, which the conversion leaves.
fn in_unit(unit: &Unit, number: f64) -> f64 {
    let number = unit.of_si(number);
    format!("{number:.11e}").parse().unwrap_or(number)
}
