//! How behaviours end: what events ask and what a history starts with.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::context::Region;
use crate::check::lint::Asked;
use crate::check::types::{Type, Typed, Value};
use crate::ir::expr::Expr;
use crate::ir::task::StartLine;
use crate::ir::tree::Status;
use crate::syntax::ast::Ref;

impl<'a> Checker<'a> {
    /// `success(b)`, `failure(b)`: whether the behaviour ended so in this tick; in a `history` line, that end.
    pub fn ended(&mut self, function: Function, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        let &[value] = self.positional(reference, 1, 1)?.as_slice() else {
            return None;
        };
        let region = self.context.region;
        if matches!(function, Function::Done | Function::Failed) {
            return self.out_of_scope(
                function.name(),
                reference.name.span,
                "the history window is asked in the guards of trees",
            );
        }
        if !region.sees_events() && !matches!(region, Region::StartHistory | Region::Let) {
            return self.out_of_scope(
                function.name(),
                reference.name.span,
                "only events, effects and rewards see a behaviour end",
            );
        }
        self.kept_in_history(function, reference);
        let behavior = self.expect(value, &Type::Behavior, "what ends");
        let status = match function {
            Function::Failure => Status::Failure,
            _ => Status::Success,
        };
        if behavior.ty == Type::Error {
            return None;
        }
        if let Value::Behavior(behavior) = behavior.value
            && !self.context.library
        {
            self.endings.insert(Asked {
                span,
                behavior,
                failure: status == Status::Failure,
            });
        }
        if region == Region::StartHistory {
            let code = match behavior.value {
                Value::Behavior(id) => Some(self.program.pool.num(StartLine::code(id, status))),
                _ => None,
            };
            return Some(Typed::new(Type::Termination, code, span));
        }
        let Value::Behavior(id) = behavior.value else {
            return Some(Typed::unknown(Type::Bool, span));
        };
        Some(self.leaf(Expr::Ended(id, status), Type::Bool, span))
    }
}
