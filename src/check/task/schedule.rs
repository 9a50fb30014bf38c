//! Schedules of a learner: step sizes and exploration, which follow `visits` and `progress`.

use crate::check::Checker;
use crate::check::types::{Type, Typed};
use crate::diagnostic::{Applicability, Code};
use crate::ir::Pool;
use crate::ir::expr::{Binary, Expr, ExprId};
use crate::syntax::ast::{self, ExprKind, Literal};

/// The visits at which a schedule is tried.
const VISITS: [f64; 6] = [1.0, 2.0, 3.0, 10.0, 1e3, 1e6];

/// The progress at which a schedule is tried.
const PROGRESS: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];

impl<'a> Checker<'a> {
    /// `a`, or `a -> b`, which goes from one to the other in step with `progress`: from 0 to 1.
    pub fn schedule(
        &mut self,
        value: &'a ast::Expr,
        tail: Option<&'a ast::Expr>,
        role: &str,
    ) -> Option<ExprId> {
        let from = self.expect(value, &Type::NUMBER, role);
        let to = tail.map(|tail| self.expect(tail, &Type::NUMBER, role));
        // One message is enough where both ends lack their `%`.
        let mut ends = std::iter::once((&from, value)).chain(to.as_ref().zip(tail));
        let fine = ends.all(|(end, written)| self.is_schedule(end, written, role));
        let from_id = from.scalar()?;
        let id = match to {
            Some(to) => self.ramp(from_id, to.scalar()?),
            None => from_id,
        };
        fine.then_some(id)
    }

    /// Whether an expression is a schedule from 0 to 1; reported if not.
    fn is_schedule(&mut self, typed: &Typed, written: &ast::Expr, role: &str) -> bool {
        let Some(id) = typed.scalar() else {
            return false;
        };
        let reads_world = self.program.pool.any(id, &mut |expr| {
            !matches!(
                expr,
                Expr::Num(_)
                    | Expr::Bool(_)
                    | Expr::Visits
                    | Expr::Progress
                    | Expr::Unary(..)
                    | Expr::Binary(..)
                    | Expr::Select(..)
            )
        });
        if reads_world {
            let message = format!("{role} depends on `visits` and `progress` only");
            self.error(Code::E0307, typed.span, message)
                .label("this reads the world");
            return false;
        }
        let outside = tried(&self.program.pool, id).find(|(_, value)| !(0.0..=1.0).contains(value));
        let Some(([visits, progress], value)) = outside else {
            return true;
        };
        let pool = &self.program.pool;
        let reads = |leaf: Expr| pool.any(id, &mut |expr| expr == leaf);
        let label = match (reads(Expr::Visits), reads(Expr::Progress)) {
            (true, _) => format!("this is {value} at {visits} visits"),
            (false, true) => format!("this is {value} when `progress` is {progress}"),
            (false, false) => format!("this is {value}"),
        };
        let message = format!("{role} goes from 0 to 1, or from 0% to 100%");
        let draft = self.out_of_range(typed.span, message, &label);
        if let ExprKind::Number(Literal {
            digits, unit: None, ..
        }) = &written.kind
            && (1.0..=100.0).contains(&value)
        {
            let percent = format!("{digits}%");
            let title = format!("write `{percent}`");
            draft.fix(title, typed.span, percent, Applicability::Unsafe);
        }
        false
    }

    /// `from + (to - from) * progress`
    pub fn ramp(&mut self, from: ExprId, to: ExprId) -> ExprId {
        let pool = &mut self.program.pool;
        let progress = pool.leaf(Expr::Progress);
        let rise = pool.binary(Binary::Sub, to, from);
        let risen = pool.binary(Binary::Mul, rise, progress);
        pool.binary(Binary::Add, from, risen)
    }
}

/// A schedule early and late, as far as it depends on either: visits and progress, with its value there.
fn tried(pool: &Pool, id: ExprId) -> impl Iterator<Item = ([f64; 2], f64)> + '_ {
    let points = VISITS.into_iter();
    let points = points.flat_map(|visits| PROGRESS.map(|progress| [visits, progress]));
    points.map(move |at| (at, value(pool, id, at)))
}

/// The value of a schedule at these visits and this progress.
pub fn value(pool: &Pool, id: ExprId, at: [f64; 2]) -> f64 {
    // Operands stand before the nodes that use them, and what is shared is computed once.
    let mut values = rustc_hash::FxHashMap::default();
    let mut open = vec![id];
    while let Some(&id) = open.last() {
        let missing: Vec<ExprId> = pool
            .operands(id)
            .filter(|operand| !values.contains_key(operand))
            .collect();
        if !missing.is_empty() {
            open.extend(missing);
            continue;
        }
        open.pop();
        let of = |id: &ExprId| values.get(id).copied().unwrap_or(f64::NAN);
        let value = match pool.get(id) {
            Expr::Num(value) => value,
            Expr::Bool(value) => f64::from(value),
            Expr::Visits => at[0],
            Expr::Progress => at[1],
            Expr::Unary(op, a) => op.apply(of(&a)),
            Expr::Binary(op, a, b) => op.apply(of(&a), of(&b)),
            Expr::Select(c, a, b) => {
                if of(&c) != 0.0 {
                    of(&a)
                } else {
                    of(&b)
                }
            }
            _ => f64::NAN,
        };
        values.insert(id, value);
    }
    values.get(&id).copied().unwrap_or(f64::NAN)
}
