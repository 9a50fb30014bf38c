//! Guards: formulas over predicates and the history.

use crate::check::Checker;
use crate::check::expr::plain_ref;
use crate::check::lint::Asked;
use crate::check::names::{Decl, is_built_in};
use crate::check::types::Type;
use crate::diagnostic::{Applicability, Code};
use crate::ir::tree::{Atom, Guard, Status};
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::ast::{BinaryOp, Expr, ExprKind, Outcome, Ref, UnaryOp};
use crate::syntax::print;

impl<'a> Checker<'a> {
    /// A formula over predicates and the history.
    pub fn guard(&mut self, expr: &'a Expr) -> Option<Guard> {
        match &expr.kind {
            ExprKind::Bool(value) => Some(Guard::Const(*value)),
            ExprKind::Paren(inner) => self.guard(inner),
            ExprKind::Unary { op, operand } if op.node == UnaryOp::Not => {
                if let Some(node) = self.node_named(operand) {
                    let help =
                        format!("success and failure are exchanged by `invert {{ {node} }}`");
                    return self.no_guard(operand, help);
                }
                self.guard(operand).map(|guard| Guard::Not(Box::new(guard)))
            }
            ExprKind::Binary { op, left, right }
                if matches!(op.node, BinaryOp::And | BinaryOp::Or) =>
            {
                if let (Some(first), Some(second)) = (self.node_named(left), self.node_named(right))
                {
                    let (word, what) = match op.node {
                        BinaryOp::And => ("sequence", "nodes that follow each other"),
                        _ => ("selector", "one node, and another if it fails"),
                    };
                    let help = format!("{what}: `{word} {{ {first}, {second} }}`");
                    return self.no_guard(left, help);
                }
                if let (BinaryOp::And, None, Some(node)) =
                    (op.node, self.node_named(left), self.node_named(right))
                {
                    let help = format!("what a condition guards follows `=>`: `… => {node}`");
                    return self.no_guard(right, help);
                }
                self.same_operands(*op, left, right);
                let (left, right) = (self.guard(left), self.guard(right));
                Some(joined(op.node == BinaryOp::And, left?, right?))
            }
            ExprKind::Ref(reference) => self.atom(reference).map(Guard::Atom),
            ExprKind::Error => None,
            ExprKind::Binary { .. } if self.is_lost_with_a_dash(expr) => None,
            ExprKind::Binary { op, left, right }
                if matches!(op.node, BinaryOp::Eq | BinaryOp::Ne)
                    && let ExprKind::Bool(value) = right.kind
                    && let ExprKind::Ref(asked) = &left.kind
                    && matches!(
                        self.names.value(&asked.name.name, false),
                        Some((Decl::Predicate(_), _))
                    ) =>
            {
                let asked = print::expr(left);
                let right = match value == (op.node == BinaryOp::Eq) {
                    true => asked,
                    false => format!("not {asked}"),
                };
                self.error(Code::E0601, expr.span, "a guard asks predicates by name")
                    .label("a predicate holds or does not, without a comparison")
                    .fix(
                        format!("write `{right}`"),
                        expr.span,
                        right,
                        Applicability::Unsafe,
                    )
                    .none()
            }
            ExprKind::Binary { op, left, right }
                if matches!(op.node, BinaryOp::Eq | BinaryOp::Ne)
                    && let Some(asked) = self.outcome_asked(left, right) =>
            {
                let right = match op.node {
                    BinaryOp::Eq => asked,
                    _ => format!("not {asked}"),
                };
                self.error(Code::E0601, expr.span, "a guard asks predicates by name")
                    .label("what a behaviour answers is no value")
                    .help(format!("the history says what has ended: `{right}`"))
                    .none()
            }
            ExprKind::Binary { op, right, .. }
                if op.node <= BinaryOp::Ge && self.node_named(right).is_some() =>
            {
                let sign = op.node.spelling();
                let message = format!("a guard is followed by `=>`, not by `{sign}`");
                self.error(Code::E0116, op.span, message)
                    .write(op.span, "=>", Applicability::Unsafe)
                    .none()
            }
            ExprKind::Binary { op, .. } if op.node <= BinaryOp::Ge => {
                let help = format!("give it one: {}", declaration(expr));
                self.no_predicate(expr.span, "this comparison has none", Some(help))
            }
            _ => {
                let label = "this is neither a predicate nor `and`, `or`, `not` of some";
                let number =
                    matches!(&expr.kind, ExprKind::Number(number) if number.unit.is_some());
                let written = print::expr(expr).replace(' ', "");
                if self.names.value(&written, false).is_some() {
                    let right = spelled(&written);
                    return self
                        .error(
                            Code::E0202,
                            expr.span,
                            "a name with marks stands in backquotes",
                        )
                        .label(format!("write `{right}`"))
                        .fix(
                            "put it in backquotes",
                            expr.span,
                            right,
                            Applicability::Unsafe,
                        )
                        .none();
                }
                let help = "in a test `for` says how long: `tick for 3 s => …`";
                self.no_predicate(expr.span, label, number.then(|| help.to_owned()))
            }
        }
    }

    fn atom(&mut self, reference: &'a Ref) -> Option<Atom> {
        let name = reference.name.name.as_str();
        match name {
            "done" | "failed" => {
                self.is_built_in(&reference.name);
                let outcome = match name {
                    "done" => Outcome::Success,
                    _ => Outcome::Failure,
                };
                return self.asked(reference, outcome);
            }
            _ => {}
        }
        match self.value_of(&reference.name) {
            Some((Decl::Predicate(predicate), library)) => self
                .predicate_instance(predicate, library, reference)
                .map(Atom::Predicate),
            Some((decl, _)) => {
                let help = match decl {
                    Decl::Behavior(_) | Decl::Tree(_) => {
                        Some("nodes that follow each other: `sequence { …, … }`".to_owned())
                    }
                    _ => self.predicate_of(reference),
                };
                let label = format!("`{name}` is {}", decl.what());
                self.no_predicate(reference.span, &label, help)
            }
            None if is_built_in(name) || matches!(name, "running" | "pose") => {
                let label = format!("`{name}` is built in");
                let help = self.predicate_of(reference);
                self.no_predicate(reference.span, &label, help)
            }
            None => self
                .undeclared_value(&reference.name, "predicate", |decl| {
                    matches!(decl, Decl::Predicate(_))
                })
                .none(),
        }
    }

    /// What to do about a reference that stands where a predicate is needed, if it names something else.
    pub fn predicate_of(&self, reference: &Ref) -> Option<String> {
        let name = reference.name.name.as_str();
        let decl = self.names.value(name, self.context.library);
        if decl.is_none() && !is_built_in(name) && name != "running" {
            return None;
        }
        let is_number = |ty: &Type| ty.dim().is_some();
        Some(match decl.map(|(decl, _)| decl) {
            Some(Decl::Predicate(_)) => return None,
            Some(Decl::Behavior(_)) => "behaviours are listed by `choose`".to_owned(),
            Some(Decl::Tree(_)) => return None,
            Some(Decl::Event(_)) => {
                "remember it in a state, and ask that by a predicate".to_owned()
            }
            Some(Decl::Place(..) | Decl::Wall(..) | Decl::Robot(_)) => {
                let called = spelled(name);
                format!("say what is asked of it: `predicate NAME = visible({called})`")
            }
            Some(Decl::Sensor(_)) => {
                let called = spelled(name);
                format!("say what is asked of it: `predicate NAME = distance({called}) < …`")
            }
            Some(Decl::Variant(_, of, _)) => {
                let (called, of) = (spelled(name), &of.name.name);
                format!("ask a state of the enum `{of}`: `predicate NAME = STATE == {called}`")
            }
            None if matches!(name, "success" | "failure") => {
                let history = match name {
                    "success" => "done",
                    _ => "failed",
                };
                format!(
                    "the history says what has ended: `{history}(…)`, with `history last 1 {name}` in the task"
                )
            }
            None if name == "running" => {
                "what runs goes on when it is reached again: no guard asks for it".to_owned()
            }
            None if matches!(name, "done" | "failed") => {
                "what has ended is observed by `history last 1 success, failure`".to_owned()
            }
            Some(Decl::State(_)) if self.states.get(name).is_some_and(|it| is_number(&it.ty)) => {
                let asked = print::expr(&called(reference));
                format!("compare it, and give that a name: `predicate NAME = {asked} > …`")
            }
            Some(Decl::State(_))
                if (self.states.get(name)).is_some_and(|it| matches!(it.ty, Type::Enum(_))) =>
            {
                let asked = print::expr(&called(reference));
                format!("compare it, and give that a name: `predicate NAME = {asked} == …`")
            }
            None if !TRUTHS.contains(&name) => {
                let asked = print::expr(&called(reference));
                format!("compare it, and give that a name: `predicate NAME = {asked} > …`")
            }
            _ => format!("give it a name: {}", declaration(&called(reference))),
        })
    }

    /// `done(b)`, `failed(b)`: whether the history window holds that end of a behaviour.
    fn asked(&mut self, reference: &'a Ref, outcome: Outcome) -> Option<Atom> {
        let &[ended] = self.positional(reference, 1, 1)?.as_slice() else {
            return None;
        };
        let Some(behavior) = plain_ref(ended) else {
            let name = &reference.name.name;
            return self
                .error(
                    Code::E0203,
                    ended.span,
                    format!("`{name}` asks a behaviour"),
                )
                .label("this is an expression")
                .none();
        };
        let id = self.behavior_ref(behavior)?;
        self.asked.push((reference.span, outcome));
        self.endings.insert(Asked {
            span: reference.span,
            behavior: id,
            status: match outcome {
                Outcome::Success => Status::Success,
                Outcome::Failure => Status::Failure,
            },
        });
        Some(match outcome {
            Outcome::Success => Atom::Done(id),
            Outcome::Failure => Atom::Failed(id),
        })
    }

    /// The behaviour or tree that an expression names, as it is written.
    fn node_named(&self, expr: &Expr) -> Option<String> {
        let reference = plain_ref(expr)?;
        let (decl, _) = self
            .names
            .value(&reference.name.name, self.context.library)?;
        matches!(decl, Decl::Behavior(_) | Decl::Tree(_)).then(|| print::expr(expr))
    }

    /// Reports a node that stands where a guard asks.
    fn no_guard<T>(&mut self, node: &'a Expr, help: String) -> Option<T> {
        let reference = plain_ref(node)?;
        let (decl, _) = self.value_of(&reference.name)?;
        let label = format!("`{}` is {}", reference.name.name, decl.what());
        self.no_predicate(node.span, &label, Some(help))
    }

    /// `goto(A) == FAILURE`: what asks the history for it.
    fn outcome_asked(&self, left: &Expr, right: &Expr) -> Option<String> {
        let node = self.node_named(left)?;
        let outcome = plain_ref(right)?.name.name.to_ascii_lowercase();
        match outcome.as_str() {
            "success" | "succeeded" => Some(format!("done({node})")),
            "failure" | "failed" => Some(format!("failed({node})")),
            _ => None,
        }
    }

    fn no_predicate<T>(&mut self, span: Span, label: &str, help: Option<String>) -> Option<T> {
        self.error(Code::E0601, span, "a guard asks predicates by name")
            .label(label)
            .help_if(help)
            .none()
    }
}

/// What is built in and holds or does not.
const TRUTHS: [&str; 5] = ["visible", "inside", "touching", "any", "all"];

/// A reference as an expression.
fn called(reference: &Ref) -> Expr {
    Expr {
        kind: ExprKind::Ref(reference.clone()),
        span: reference.span,
    }
}

/// The predicate that gives what is asked a name.
fn declaration(asked: &Expr) -> String {
    format!("`predicate NAME = {}`", print::expr(asked))
}

/// A conjunction or a disjunction, kept flat.
fn joined(and: bool, left: Guard, right: Guard) -> Guard {
    let mut parts = Vec::new();
    for side in [left, right] {
        match side {
            Guard::And(inner) if and => parts.extend(inner),
            Guard::Or(inner) if !and => parts.extend(inner),
            other => parts.push(other),
        }
    }
    if and {
        Guard::And(parts)
    } else {
        Guard::Or(parts)
    }
}
