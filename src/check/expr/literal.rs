//! Literals and points.

use crate::check::Checker;
use crate::check::types::units::meaning;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::source::Span;
use crate::syntax::ast::{Expr, Literal};

impl<'a> Checker<'a> {
    /// A number, perhaps with a unit.
    pub fn literal(&mut self, literal: &Literal, span: Span) -> Option<Typed> {
        let Some(unit) = &literal.unit else {
            let id = self.program.pool.num(literal.value);
            return Some(Typed::new(Type::NUMBER, Value::Scalar(id), span));
        };
        if let Some(meaning) = meaning(unit, self.tick) {
            let id = self.program.pool.num(meaning.scale.apply(literal.value));
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
