//! Regions of a behaviour that it never gets to: what `requires`, `succeed when` and `fail when` leave of one another.

use super::cases::of_expr;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::law::Law;
use crate::source::Span;
use crate::syntax::ast::{BehaviorBody, Clause, ClauseKind, Item, ItemKind};

impl<'a> Checker<'a> {
    /// Warns of regions that no instance of a behaviour gets to.
    pub fn regions_without_effect(&mut self, items: impl Iterator<Item = &'a Item>) {
        for item in items {
            let ItemKind::Behavior(behavior) = &item.kind else {
                continue;
            };
            let BehaviorBody::Clauses(clauses) = &behavior.body else {
                continue;
            };
            let behaviors = self.program.behaviors.values();
            let laws: Vec<Law> = behaviors
                .filter(|other| other.name.family == behavior.name.name)
                .filter_map(|other| other.law.clone())
                .collect();
            if !laws.is_empty() {
                self.regions_of(clauses, &laws);
            }
        }
    }

    fn regions_of(&mut self, clauses: &'a [Clause], laws: &[Law]) {
        let first = |wanted: fn(&ClauseKind) -> bool| {
            let mut clauses = clauses.iter();
            clauses.find(|clause| wanted(&clause.kind)).map(place)
        };
        let requires = first(|kind| matches!(kind, ClauseKind::Requires(_)));
        let succeed = first(|kind| matches!(kind, ClauseKind::Succeed(_)));
        let fail = first(|kind| matches!(kind, ClauseKind::Fail(_)));
        let drives =
            first(|kind| matches!(kind, ClauseKind::Control(block) if !block.stmts.is_empty()));
        let program = &self.program;
        let every = |test: &dyn Fn(&Law) -> bool| laws.iter().all(test);
        let requires_never = every(&|law| of_expr(program, law.requires, true).is_never());
        let at_once = every(&|law| {
            let allowed = of_expr(program, law.requires, true);
            allowed.implies(&of_expr(program, law.succeed, true))
        });
        let shadowed = every(&|law| {
            let fails = of_expr(program, law.fail, true);
            fails.implies(&of_expr(program, law.succeed, true))
        });
        let fails_at_once = every(&|law| {
            let allowed = of_expr(program, law.requires, true);
            let goes_on = allowed.and(&of_expr(program, law.succeed, false));
            goes_on.implies(&of_expr(program, law.fail, true))
        });
        if let (true, Some(at)) = (requires_never, requires) {
            self.warning(Code::W0302, at, "this behaviour never runs")
                .label("what it requires never holds, so it fails at once");
        } else if let (true, Some(at), Some(control)) = (at_once, succeed, drives) {
            self.warning(Code::W0302, control, "this control law never runs")
                .label("never reached")
                .also(
                    at,
                    "this holds from the start, so the behaviour succeeds at once",
                );
        } else if let (true, Some(at), Some(before)) = (shadowed, fail, succeed) {
            self.warning(Code::W0302, at, "this behaviour never fails here")
                .label("wherever this holds, it has succeeded already")
                .also(before, "`succeed when` is looked at first");
        } else if let (true, Some(at), Some(control)) = (fails_at_once, fail, drives) {
            self.warning(Code::W0302, control, "this control law never runs")
                .label("never reached")
                .also(
                    at,
                    "this holds from the start, so the behaviour fails at once",
                );
        }
    }
}

/// The words that a clause begins with.
fn place(clause: &Clause) -> Span {
    let length = match clause.kind {
        ClauseKind::Requires(_) => "requires".len(),
        ClauseKind::Succeed(_) => "succeed when".len(),
        ClauseKind::Fail(_) => "fail when".len(),
        ClauseKind::Control(_) => "control".len(),
        ClauseKind::Local { .. } | ClauseKind::Error => return clause.span,
    };
    let start = clause.span.range().start;
    let end = (start + length).min(clause.span.range().end);
    Span::new(clause.span.file, start, end)
}
