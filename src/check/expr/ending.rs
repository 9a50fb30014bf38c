//! How behaviours end: what events ask and what a history starts with.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::context::Region;
use crate::check::lint::Asked;
use crate::check::names::Decl;
use crate::check::signature::{Signature, Takes};
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::ir::Id;
use crate::ir::expr::Expr as Pooled;
use crate::ir::task::StartLine;
use crate::ir::tree::Status;
use crate::ir::world::Robot;
use crate::syntax::ast::{ArgKind, Expr, ExprKind, Ref};
use crate::syntax::print;

impl<'a> Checker<'a> {
    /// `success(b)`, `failure(b)`, `running(b)`: whether the behaviour ended so in this tick, or runs, perhaps one of another
    /// robot; in a `history` line, that end.
    pub fn ended(&mut self, function: Function, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        let (value, robot) = self.one_by(reference)?;
        let region = self.context.region;
        if matches!(function, Function::Done | Function::Failed) {
            let name = function.name();
            let message = format!("`{name}` cannot be asked in {}", region.name());
            return self
                .error(Code::E0307, reference.name.span, message)
                .label("the history window is asked in the guards of trees")
                .help(format!(
                    "a tree asks it: `{name}(…) => …`; an event asks for the end itself"
                ))
                .none();
        }
        // What runs is known from the tick before.
        let runs = function == Function::Running && region == Region::EachTick;
        if !region.sees_events() && !runs && !matches!(region, Region::StartHistory | Region::Let) {
            let message = format!("`{}` cannot be asked in {}", function.name(), region.name());
            let (label, help) = match function {
                Function::Running => (
                    "only events, effects and rewards see what runs",
                    "remember it in a state: `each tick { busy = running(…) }`",
                ),
                _ => (
                    "only events, effects and rewards see a behaviour end",
                    "remember it in a state: `on success(…) { seen = true }`",
                ),
            };
            return self
                .error(Code::E0307, reference.name.span, message)
                .label(label)
                .help(help)
                .none();
        }
        if function == Function::Running && region == Region::StartHistory {
            let why = "a history holds what has ended";
            return self.out_of_scope(function.name(), reference.name.span, why);
        }
        self.kept_in_history(function, reference);
        let robot = robot.unwrap_or(self.subject);
        let behavior = self.as_robot(robot, |checker| {
            let typed = checker.expr_like(value, &Type::Behavior);
            if matches!(typed.ty, Type::Place(_)) {
                let name = &reference.name.name;
                let message = format!("what ends is {}, not {}", Type::Behavior, typed.ty);
                let place = crate::syntax::print::expr(value);
                return checker
                    .unlike(&typed, &Type::Behavior, message)
                    .this_is(&typed.ty)
                    .help(format!(
                        "say what the robot does there: `{name}(goto({place}))`"
                    ))
                    .typed();
            }
            checker.coerce(typed, value, &Type::Behavior, "what ends")
        });
        let status = match function {
            Function::Failure => Status::Failure,
            Function::Running => Status::Running,
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
                status,
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
        Some(self.leaf(Pooled::Ended(id, status), Type::Bool, span))
    }

    /// What is meant by a second argument that is no robot: `success(dock, tap)`, `inside(sheep, fold)`.
    fn another_by(&mut self, of: &'a Expr, by: &'a Expr, is: &Type) -> Option<(String, String)> {
        if !matches!(is, Type::Place(_)) {
            return None;
        }
        let ExprKind::Ref(reference) = &of.kind else {
            return None;
        };
        let name = &reference.name.name;
        let (first, second) = (print::expr(of), print::expr(by));
        if reference.args.is_none()
            && matches!(self.names.value(name, false), Some((Decl::Behavior(_), _)))
        {
            let message = format!("the arguments of `{name}` stand in parentheses of their own");
            return Some((message, format!("{first}({second})")));
        }
        let (typed, _) = self.captured(|checker| checker.expr(of));
        (typed.ty == Type::Robot).then(|| {
            let message = "the place goes first, then the robot".to_owned();
            (message, format!("{second}, by = {first}"))
        })
    }

    /// The one argument of a call that may say of which robot it is: `success(goto(A), by = raider)`.
    pub fn one_by(&mut self, reference: &'a Ref) -> Option<(&'a Expr, Option<Id<Robot>>)> {
        let name = &reference.name.name;
        let signature = Signature {
            owner: &format!("`{name}`"),
            takes: Takes::Parameters {
                names: &["of", "by"],
                words: "one argument, and the robot as `by = …`",
            },
        };
        let args = reference.args.as_deref().unwrap_or_default();
        let matched = self.matched(&signature, args);
        let mut values = matched.values();
        let (of, by) = (values.next().flatten(), values.next().flatten());
        if !matched.fine {
            return None;
        }
        let Some(of) = of else {
            return self
                .error(
                    Code::E0305,
                    reference.span,
                    format!("`{name}` takes one argument, not 0"),
                )
                .label("too few")
                .help(format!("of a behaviour it is asked so: `{name}(BEHAVIOR)`"))
                .none();
        };
        let Some(by) = by else {
            return Some((of, None));
        };
        let typed = self.expr(by);
        let by_position = args
            .iter()
            .any(|arg| matches!(&arg.kind, ArgKind::Positional(value) if value.span == by.span));
        if by_position && typed.ty == Type::LENGTH && name == "inside" {
            let near = format!("distance({}) <= {}", print::expr(of), print::expr(by));
            return self
                .error(Code::E0305, by.span, "`inside` takes a place alone")
                .label("this is a length (m)")
                .fix(
                    format!("to be so near to it, write `{near}`"),
                    reference.span,
                    near,
                    crate::diagnostic::Applicability::Unsafe,
                )
                .none();
        }
        let robot = match self.another_by(of, by, &typed.ty) {
            Some((message, right)) => {
                let span = of.span.to(by.span);
                return self
                    .error(Code::E0305, by.span, message)
                    .label("this is no robot")
                    .fix(
                        format!("write `{right}`"),
                        span,
                        right,
                        crate::diagnostic::Applicability::Unsafe,
                    )
                    .none();
            }
            None => self.coerce(typed, by, &Type::Robot, "`by`"),
        };
        match robot.value {
            Value::Robot(id) => Some((of, Some(id))),
            Value::Chosen(..) => self
                .error(Code::E0303, by.span, "`by` names one robot")
                .label("this is chosen while the program runs")
                .none(),
            _ => None,
        }
    }
}
