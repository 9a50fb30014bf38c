//! Step sizes and exploration rates as functions of `visits` and `progress`.

use crate::ir::expr::Expr;
use crate::ir::{ExprId, Pool};

/// A schedule of a learner.
#[derive(Clone, Copy, Debug)]
pub struct Schedule<'a> {
    pool: &'a Pool,
    value: ExprId,
}

impl<'a> Schedule<'a> {
    /// The schedule that an expression says.
    pub fn new(pool: &'a Pool, value: ExprId) -> Self {
        Self { pool, value }
    }

    /// Its value, within [0, 1]; what is not a number is 0.
    pub fn at(&self, visits: f64, progress: f64) -> f64 {
        let value = self.eval(self.value, visits, progress);
        if value > 0.0 { value.min(1.0) } else { 0.0 }
    }

    fn eval(&self, id: ExprId, visits: f64, progress: f64) -> f64 {
        let value = |id| self.eval(id, visits, progress);
        match self.pool.get(id) {
            Expr::Num(number) => number,
            Expr::Bool(truth) => f64::from(truth),
            Expr::Visits => visits,
            Expr::Progress => progress,
            Expr::Unary(op, a) => op.apply(value(a)),
            Expr::Binary(op, a, b) => op.apply(value(a), value(b)),
            Expr::Select(c, a, b) => value(if value(c) != 0.0 { a } else { b }),
            // The checker lets nothing else into a schedule.
            _ => 0.0,
        }
    }
}
