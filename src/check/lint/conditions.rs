//! Conditions of events, effects, doors and prices that always or never hold.

use super::apart::because;
use super::cases::of_expr;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::{Expr, ExprId};
use crate::source::Span;
use std::collections::BTreeMap;

impl<'a> Checker<'a> {
    /// Notes a condition, to be looked at once the program is whole.
    pub fn asks(&mut self, at: Span, condition: Option<ExprId>) {
        if let (Some(condition), false) = (condition, self.context.library) {
            self.conditions.push((at, condition));
        }
    }

    /// Warns of the conditions that always or never hold. Of what stands in the text once for each member of a kind, all
    /// have to; what is a constant is meant to be one.
    pub fn conditions_without_effect(&mut self) {
        let mut places: BTreeMap<Span, Vec<ExprId>> = BTreeMap::new();
        for (at, condition) in std::mem::take(&mut self.conditions) {
            places.entry(at).or_default().push(condition);
        }
        for (at, conditions) in places {
            let pool = &self.program.pool;
            let told = |id: &ExprId| {
                // Of an event that never happens it is told where that is declared.
                pool.constant(*id).is_some() || matches!(pool.get(*id), Expr::Event(_))
            };
            if conditions.iter().any(told) || self.says_one_thing_twice(at) {
                continue;
            }
            let never = |wanted| {
                let mut all = conditions.iter();
                all.all(|id| of_expr(&self.program, *id, wanted).is_never())
            };
            let says = match (never(true), never(false)) {
                (true, _) => "never",
                (_, true) => "always",
                _ => continue,
            };
            let why = conditions
                .first()
                .and_then(|id| because(&self.program, *id));
            self.warning(Code::W0601, at, format!("this condition {says} holds"))
                .label("whatever happens in the world")
                .note_if(why);
        }
    }
}
