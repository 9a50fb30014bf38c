//! Constants that are no numbers: undefined or infinite results.

use crate::check::Checker;
use crate::check::types::Typed;
use crate::diagnostic::Code;
use crate::syntax::ast::{Expr, ExprKind};

impl Checker<'_> {
    /// Whether an expression is not a constant, or a finite one; reported if not. Under the arguments of a use nothing
    /// is reported: an `if` may keep the body from ever computing it.
    pub fn is_finite(&mut self, typed: &Typed, expr: &Expr) -> bool {
        let constant = typed.scalar().and_then(|id| self.program.pool.constant(id));
        let Some(number) = constant.filter(|number| !number.is_finite()) else {
            return true;
        };
        if self.bodies.is_unrolling() {
            return true;
        }
        // A literal that is too large is reported where it is read.
        let reported = matches!(&expr.kind, ExprKind::Number(read) if read.value.is_infinite());
        if !reported {
            let (message, label) = if number.is_nan() {
                ("the result of this is undefined", "no number is this")
            } else {
                ("the result of this is infinite", "no number is so large")
            };
            self.error(Code::E0309, expr.span, message).label(label);
        }
        false
    }

    /// Reports a divisor that is the constant zero.
    pub fn no_division_by_zero(&mut self, divisor: &Typed) -> Option<()> {
        let zero = divisor
            .scalar()
            .and_then(|id| self.program.pool.constant(id))
            == Some(0.0);
        if zero && !self.bodies.is_unrolling() {
            return self
                .error(Code::E0309, divisor.span, "nothing is divided by zero")
                .label("this is zero")
                .none();
        }
        Some(())
    }
}
