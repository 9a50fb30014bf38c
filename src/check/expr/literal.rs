//! Literals and points.

use crate::check::Checker;
use crate::check::types::units::meaning;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::{Applicability, Code};
use crate::source::Span;
use crate::syntax::ast::{Expr, Literal};
use std::f64::consts::TAU;

/// More than a turn, in radians.
const ROUND: f64 = 6.3;

impl<'a> Checker<'a> {
    /// A number, perhaps with a unit.
    pub fn literal(&mut self, literal: &Literal, span: Span) -> Option<Typed> {
        let Some(unit) = &literal.unit else {
            let id = self.program.pool.num(literal.value);
            return Some(Typed::new(Type::NUMBER, Value::Scalar(id), span));
        };
        if let Some(meaning) = meaning(unit, self.tick) {
            if matches!(unit.text.as_str(), "tick" | "ticks") {
                self.point_in_count(literal, span);
            }
            if unit.text == "rad" && literal.value.abs() > ROUND {
                self.many_turns(literal, unit.span);
            }
            let value = meaning.scale.apply(literal.value);
            self.notes_quantity(meaning.dim, value, span);
            let id = self.program.pool.num(value);
            let ty = if meaning.percent {
                Type::Ratio
            } else {
                Type::Quantity(meaning.dim)
            };
            return Some(Typed::new(ty, Value::Scalar(id), span));
        }
        // Ticks of a length that is not known yet: the type is known, the value is not.
        let meaning = meaning(unit, Some(1.0))?;
        // The tick is checked before the rest of the world.
        let in_tick = self.has_world && self.program.world.is_none();
        if in_tick || !self.has_world {
            let message = if in_tick {
                "a tick is not measured in ticks"
            } else {
                "ticks are counted by a world, and there is none"
            };
            self.error(Code::E0407, unit.span, message)
                .label("how many seconds are these?");
        }
        Some(Typed::unknown(Type::Quantity(meaning.dim), span))
    }

    /// Warns of a whole number whose point was to group its digits: `3.000` is 3.
    pub fn point_in_count(&mut self, literal: &Literal, at: Span) {
        let Some(grouped) = grouped(literal).filter(|_| literal.value.fract() == 0.0) else {
            return;
        };
        self.warning(
            Code::W0305,
            at,
            format!("`{}` is {}", literal.digits, literal.value),
        )
        .label("a point begins the decimals")
        .help(format!("digits are grouped by `_`: `{grouped}`"));
    }

    /// Warns of an angle of several turns in radians, whose number is one of degrees.
    fn many_turns(&mut self, literal: &Literal, unit: Span) {
        let turns = (literal.value.abs() / TAU * 10.0).round() / 10.0;
        self.warning(
            Code::W0402,
            unit,
            format!("`{} rad` is {turns} turns", literal.digits),
        )
        .write(unit, "deg", Applicability::Unsafe);
    }

    /// `(x, y)`
    pub fn point(&mut self, x: &'a Expr, y: &'a Expr, span: Span) -> Typed {
        let x = self.expect(x, &Type::LENGTH, "a coordinate");
        let y = self.expect(y, &Type::LENGTH, "a coordinate");
        if x.ty == Type::Error || y.ty == Type::Error {
            return Typed::error(span);
        }
        let value = match (x.scalar(), y.scalar()) {
            (Some(x), Some(y)) => Value::Point(x, y),
            _ => Value::Unknown,
        };
        Typed::new(Type::Point, value, span)
    }
}

/// A number as it was meant, where its point stands as if it grouped thousands: `3_000` for `3.000`.
pub fn grouped(literal: &Literal) -> Option<String> {
    let (thousands, rest) = literal.digits.split_once('.')?;
    let is_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let groups =
        (1..=3).contains(&thousands.len()) && rest.len() == 3 && !thousands.starts_with('0');
    (groups && is_digits(thousands) && is_digits(rest)).then(|| format!("{thousands}_{rest}"))
}
