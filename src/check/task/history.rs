//! The history window: what a task keeps of how its behaviours end.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::context::Region;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::ir::Name;
use crate::ir::task::{History, StartLine};
use crate::source::Span;
use crate::syntax::ast::{Expr, ExprKind, Outcome, Ref, Spanned};

/// Where an outcome is needed that the history of a task does not keep.
pub struct Unkept {
    place: Span,
    outcome: Outcome,
    /// What is said there.
    label: &'static str,
}

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

    /// Notes a history that starts with an outcome it does not keep: it would be forgotten at once.
    pub fn kept_in_history(&mut self, function: Function, reference: &Ref) {
        let starts = self.context.region == Region::StartHistory;
        let Some((task, history)) = self.kept.clone().filter(|_| starts) else {
            return;
        };
        let outcome = match function {
            Function::Failure => Outcome::Failure,
            _ => Outcome::Success,
        };
        let place = reference.name.span;
        self.unkept(
            (&task, history),
            place,
            outcome,
            "so it cannot start with one",
        );
    }

    /// Notes that an outcome is needed at a place which the history of a task may not keep.
    pub fn unkept(
        &mut self,
        (task, history): (&Name, History),
        place: Span,
        outcome: Outcome,
        label: &'static str,
    ) {
        let kept = match outcome {
            Outcome::Success => history.success,
            Outcome::Failure => history.failure,
        };
        if kept || self.names.is_lost("history") {
            return;
        }
        let (_, all) = self
            .unkept
            .entry(task.to_string())
            .or_insert((history, Vec::new()));
        all.push(Unkept {
            place,
            outcome,
            label,
        });
    }

    /// Reports what tasks do not keep in their histories, one message each.
    pub fn histories_that_keep_too_little(&mut self) {
        for (task, (history, mut all)) in std::mem::take(&mut self.unkept) {
            all.sort_by_key(|it| it.place);
            let needs = |outcome| all.iter().any(|it| it.outcome == outcome);
            let needed = [Outcome::Success, Outcome::Failure].map(needs);
            let places: Vec<Span> = all.iter().map(|it| it.place).collect();
            let Some((first, further)) = all.first().zip(places.get(1..)) else {
                continue;
            };
            let [message, help] = kept_too_little(&task, history, needed);
            let told = self
                .error(Code::E0607, first.place, message)
                .label(first.label)
                .and_at(further, "and here");
            told.help(help);
        }
    }
}

/// What is said of a task whose history does not keep the successes or failures that are needed, and what helps.
pub fn kept_too_little(task: &str, history: History, needed: [bool; 2]) -> [String; 2] {
    let outcomes = match needed {
        [true, true] => "neither success nor failure",
        [true, false] => "no success",
        _ => "no failure",
    };
    [
        format!("the task `{task}` keeps {outcomes} in its history"),
        format!("let the task say `{}`", keeping(history, needed)),
    ]
}

/// Whether a name says that the history begins empty, see [`Checker::no_end`].
pub fn is_no_end(value: &Expr) -> bool {
    matches!(&value.kind, ExprKind::Ref(reference) if reference.args.is_none() && reference.name.name == NO_END)
}

/// The `history` line that keeps successes and failures as they are needed, in addition to those it keeps already.
fn keeping(history: History, [success, failure]: [bool; 2]) -> String {
    let window = history.window.max(1);
    let outcomes = match (history.success || success, history.failure || failure) {
        (true, true) => "success, failure",
        (true, false) => "success",
        _ => "failure",
    };
    format!("history last {window} {outcomes}")
}
