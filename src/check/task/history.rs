//! The history window: what a task keeps of how its behaviours end.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::context::Region;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::ir::task::{History, StartLine};
use crate::source::Span;
use crate::syntax::ast::{Expr, ExprKind, Outcome, Ref, Spanned};

/// The word for no end of a behaviour in a `history` line of a start.
pub const NO_END: &str = "none";

impl<'a> Checker<'a> {
    /// `history last n outcome, …`
    pub fn history(&mut self, window: &'a Expr, outcomes: &[Spanned<Outcome>]) -> History {
        let length = self.constant(window, &Type::NUMBER, "the length of the history");
        let window_length = match length {
            Some(n) if n.fract() == 0.0 && (1.0..=64.0).contains(&n) => n as usize,
            Some(n) => {
                let label = if n.fract() != 0.0 {
                    "this is not a whole number"
                } else if n < 1.0 {
                    "nothing would be remembered"
                } else {
                    "these are too many"
                };
                self.out_of_range(window.span, "a history holds 1 to 64 terminations", label);
                0
            }
            None => 0,
        };
        let mut kept: Vec<Outcome> = Vec::new();
        for outcome in outcomes {
            self.once(&mut kept, outcome.node, outcome.span);
        }
        let keeps = |outcome| outcomes.iter().any(|kept| kept.node == outcome);
        History {
            window: window_length,
            success: keeps(Outcome::Success),
            failure: keeps(Outcome::Failure),
        }
    }

    /// `none`, where an episode begins with nothing in its history.
    pub fn no_end(&mut self, span: Span) -> Typed {
        let code = self.program.pool.num(StartLine::NO_END);
        Typed::new(Type::Termination, Value::Scalar(code), span)
    }

    /// Reports a history that starts with an outcome it does not keep: it would be forgotten at once.
    pub fn kept_in_history(&mut self, function: Function, reference: &Ref) {
        let Some(history) = self
            .kept
            .filter(|_| self.context.region == Region::StartHistory)
        else {
            return;
        };
        let kept = match function {
            Function::Failure => history.failure,
            _ => history.success,
        };
        if !kept && !self.names.is_lost("history") {
            let outcome = function.name();
            self.error(
                Code::E0607,
                reference.name.span,
                format!("the history of the task keeps no {outcome}"),
            )
            .label("so it cannot start with one")
            .help(format!("let the task say `{}`", keeping(history, outcome)));
        }
    }
}

/// Whether a name says that the history begins empty, see [`Checker::no_end`].
pub fn is_no_end(value: &Expr) -> bool {
    matches!(&value.kind, ExprKind::Ref(reference) if reference.args.is_none() && reference.name.name == NO_END)
}

/// The `history` line that keeps an outcome in addition to those it keeps already.
pub fn keeping(history: History, outcome: &str) -> String {
    let window = history.window.max(1);
    if history.success || history.failure {
        format!("history last {window} success, failure")
    } else {
        format!("history last {window} {outcome}")
    }
}
