//! `fail when elapsed > 10 min`, where no episode lasts so long.

use super::cases::{About, Case, Cases, Says, of_expr};
use super::regions::FailClause;
use super::view::View;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::{Expr, ExprId};
use crate::source::Span;
use crate::syntax::ast::{self, BinaryOp, ExprKind};

impl Checker<'_> {
    /// Warns of a `fail when` that holds only after more time than any episode has.
    pub fn fails_too_late(&mut self, test: &ast::Expr, found: &[FailClause]) -> bool {
        let pool = &self.program.pool;
        let elapsed = pool.iter().find(|(_, expr)| *expr == Expr::Elapsed);
        let tick = self.program.world.as_ref().map(|world| world.tick);
        let (Some((elapsed, _)), Some(tick), Some(ticks)) = (elapsed, tick, self.longest_episode())
        else {
            return false;
        };
        let view = View::from(&self.program);
        let longest = ticks as f64 * tick;
        let mut all = found.iter();
        let late = all.all(|it| is_late(&of_expr(view, it.when, true), elapsed, longest));
        if !late {
            return false;
        }
        self.warning(Code::W0512, time(test), "no episode lasts so long")
            .label("so this behaviour never fails here")
            .note(format!("an episode ends after {ticks} ticks"));
        true
    }
}

/// Whether something holds only where more time than this has passed.
fn is_late(cases: &Cases, elapsed: ExprId, longest: f64) -> bool {
    let Cases::Some(cases) = cases else {
        return false;
    };
    let late = |case: &Case| match case.get(&About::Number(elapsed)) {
        Some(Says::Within(within)) => within.ends().0 > longest,
        _ => false,
    };
    !cases.is_empty() && cases.iter().all(late)
}

/// What `elapsed` is compared with, if that is all that is asked.
fn time(test: &ast::Expr) -> Span {
    match &test.kind {
        ExprKind::Paren(inner) => time(inner),
        ExprKind::Binary { op, left, right } => match (op.node, &left.kind, &right.kind) {
            (BinaryOp::Gt | BinaryOp::Ge, ExprKind::Ref(_), _) => right.span,
            (BinaryOp::Lt | BinaryOp::Le, _, ExprKind::Ref(_)) => left.span,
            _ => test.span,
        },
        _ => test.span,
    }
}
