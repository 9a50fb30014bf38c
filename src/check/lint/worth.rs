//! Rewards that depend on what the event of their line says already: `on pickup: if carrying { 1 } else { 2 }`.

use super::cases::of_expr;
use super::tree::as_it_succeeds;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::Expr;
use crate::ir::task::Task;
use crate::syntax::ast::{self, Choice, ExprKind};

impl Checker<'_> {
    /// Warns of a choice between two rewards whose condition holds always, or never, where the line of this number pays.
    pub fn chooses_what_is_so(&mut self, value: &ast::Expr, (checked, place): (&Task, usize)) {
        let Some(choice) = choice(value) else {
            return;
        };
        let at = choice.cond.span;
        let lines = checked.written.reward.iter().zip(&checked.reward);
        let mut own = lines.filter(|(of, _)| **of == place).peekable();
        if own.peek().is_none() || self.is_told_within(Code::W0601, at) {
            return;
        }
        let (mut always, mut never) = (true, true);
        for (_, line) in own {
            let Expr::Select(asked, ..) = self.program.pool.get(line.value) else {
                return;
            };
            let happens = of_expr(&self.program, line.event, true)
                .and(&as_it_succeeds(&self.program, line.event));
            if happens.is_never() {
                return;
            }
            let asked = |wanted| of_expr(&self.program, asked, wanted);
            // What holds whatever happens is told as such.
            if asked(true).is_never() || asked(false).is_never() {
                return;
            }
            never &= happens.and(&asked(true)).is_never();
            always &= happens.and(&asked(false)).is_never();
        }
        let (says, label) = match (always, never) {
            (true, _) => ("always", "what this line waits for says so already"),
            (_, true) => ("never", "what this line waits for rules it out"),
            _ => return,
        };
        let message = format!("this condition {says} holds where the line pays");
        self.warning(Code::W0601, at, message)
            .label(label)
            .note("rewards read the states as they are before the effects of an event");
    }
}

/// A choice between two values.
fn choice(value: &ast::Expr) -> Option<&Choice> {
    match &value.kind {
        ExprKind::Paren(inner) => choice(inner),
        ExprKind::If(choice) => Some(choice),
        _ => None,
    }
}
