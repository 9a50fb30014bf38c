//! Expressions that say one thing twice: `b < b`, `a or b or a`, `x = x`.

use crate::check::Checker;
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::diagnostic::{Applicability, Code};
use crate::source::Span;
use crate::syntax::ast::{
    Arg, ArgKind, BinaryOp, Block, Branch, Clause, ClauseKind, Else, Expr, ExprKind, Literal, Ref,
    Spanned, Stmt, StmtKind,
};
use crate::syntax::print;

/// The functions whose value is another one each time.
const DRAWS: [&str; 4] = ["uniform", "normal", "chance", "one_of"];

/// An expression that stands a second time: where it stands first, and what that makes of the whole.
#[derive(Clone, Debug)]
pub struct Again {
    first: Span,
    message: String,
    label: &'static str,
}

impl<'a> Checker<'a> {
    /// Whether an expression is an input: what it is compared with may be a word that is called so, too.
    fn is_input(&self, expr: &Expr) -> bool {
        let named = plain_ref(expr).map(|name| name.name.name.as_str());
        let decl = named.and_then(|name| self.names.value(name, false));
        matches!(decl, Some((Decl::Input(_), _)))
    }

    /// Notes it where the operands of an operator are the same.
    pub fn same_operands(&mut self, op: Spanned<BinaryOp>, left: &'a Expr, right: &'a Expr) {
        if self.context.library {
            return;
        }
        if matches!(op.node, BinaryOp::And | BinaryOp::Or) {
            if let Some(first) = operand_like(op.node, left, right) {
                let message = format!("one side of `{}` stands on both", op.node.spelling());
                self.again(right.span, first, message, "asked a second time");
            }
            return;
        }
        let tells = op.node >= BinaryOp::Eq && op.node <= BinaryOp::Ge
            || matches!(op.node, BinaryOp::Sub | BinaryOp::Div);
        if tells && !is_literal(left) && is_like(left, right) && !self.is_input(left) {
            let message = format!("both sides of `{}` are the same", op.node.spelling());
            self.again(right.span, left.span, message, "the same as on the left");
        }
    }

    /// Notes it where all that is drawn from is the same.
    pub fn same_draws(&mut self, draw: &'a Ref) {
        if matches!(draw.name.name.as_str(), "uniform" | "one_of") {
            self.same_values(draw, "draws from one value");
        }
        if let ("one_of", Some([only])) = (draw.name.name.as_str(), draw.args.as_deref())
            && let ArgKind::Positional(value) = &only.kind
            && is_literal(value)
            && !self.context.library
        {
            let right = print::expr(value);
            self.warning(Code::W0303, draw.span, "`one_of` draws from one value")
                .label("this is always the same")
                .fix(
                    format!("write `{right}`"),
                    draw.span,
                    right,
                    Applicability::Unsafe,
                );
        }
    }

    /// Notes it where the less or the greater of two values is asked for that are the same.
    pub fn same_bounds(&mut self, bound: &'a Ref) {
        self.same_values(bound, "compares one value with itself");
    }

    fn same_values(&mut self, call: &'a Ref, does: &str) {
        let args = call.args.as_deref().unwrap_or_default();
        let values = args.iter().filter_map(|arg| match &arg.kind {
            ArgKind::Positional(value) => Some(value),
            _ => None,
        });
        let values: Vec<&Expr> = values.collect();
        let [first, .., last] = values.as_slice() else {
            return;
        };
        if !self.context.library && values.iter().all(|value| is_like(first, value)) {
            let message = format!("`{}` {does}", call.name.name);
            self.again(last.span, first.span, message, "the same again");
        }
    }

    /// Notes it where both branches of a choice are the same.
    pub fn same_branches(&mut self, then: &'a Expr, otherwise: &'a Expr) {
        if !self.context.library && is_like(then, otherwise) {
            let message = "both branches of this choice are the same".to_owned();
            self.again(otherwise.span, then.span, message, "whatever holds");
        }
    }

    /// Notes it where both branches of a statement do the same.
    pub fn same_blocks(&mut self, then: &'a Block, otherwise: &'a Block) {
        if !self.context.library && !then.stmts.is_empty() && does_the_same(then, otherwise) {
            let message = "both branches do the same".to_owned();
            self.again(otherwise.span, then.span, message, "whatever holds");
        }
    }

    /// Notes it where something is set to itself.
    pub fn set_to_itself(&mut self, target: &'a Ref, value: &'a Expr) {
        if let ExprKind::Ref(reference) = &value.kind
            && !self.context.library
            && is_same(target, reference)
        {
            let message = format!("`{}` is set to itself", target.name.name);
            self.again(value.span, target.span, message, "it is this already");
        }
    }

    /// Notes it where a behaviour says one clause twice.
    pub fn same_clauses(&mut self, clauses: &'a [Clause]) {
        let mut before: Vec<(&str, &'a Expr)> = Vec::new();
        for clause in clauses {
            let (word, test) = match &clause.kind {
                ClauseKind::Requires(test) => ("requires", test),
                ClauseKind::Succeed(test) => ("succeed when", test),
                ClauseKind::Fail(test) => ("fail when", test),
                _ => continue,
            };
            let same =
                |(other, earlier): &&(&str, &'a Expr)| *other == word && is_like(earlier, test);
            if let Some((_, first)) = before.iter().find(same).filter(|_| !self.context.library) {
                let message = format!("this `{word}` is there already");
                self.again(test.span, first.span, message, "asked a second time");
            }
            before.push((word, test));
        }
    }

    fn again(&mut self, second: Span, first: Span, message: String, label: &'static str) {
        let again = Again {
            first,
            message,
            label,
        };
        self.again.insert(second, again);
    }

    /// Warns of what has been noted.
    pub fn same_on_both_sides(&mut self) {
        for (second, again) in std::mem::take(&mut self.again) {
            self.warning(Code::W0303, second, again.message)
                .label(again.label)
                .also(again.first, "the first time");
        }
    }

    /// Whether there was a warning of this within a span.
    pub fn says_one_thing_twice(&self, span: Span) -> bool {
        self.is_told_within(Code::W0303, span)
    }
}

/// The operand of a chain of `and` or of `or` that is like another expression.
fn operand_like(op: BinaryOp, chain: &Expr, other: &Expr) -> Option<Span> {
    match &chain.kind {
        ExprKind::Binary {
            op: joins,
            left,
            right,
        } if joins.node == op => {
            operand_like(op, right, other).or_else(|| operand_like(op, left, other))
        }
        _ => is_like(chain, other).then_some(chain.span),
    }
}

/// Whether two expressions are written alike and have one value.
fn is_like(a: &Expr, b: &Expr) -> bool {
    match (&a.kind, &b.kind) {
        (ExprKind::Paren(a), _) => is_like(a, b),
        (_, ExprKind::Paren(b)) => is_like(a, b),
        (ExprKind::Number(a), ExprKind::Number(b)) => {
            let unit = |of: &Literal| of.unit.as_ref().map(|unit| unit.text.clone());
            a.value == b.value && unit(a) == unit(b)
        }
        (ExprKind::Bool(a), ExprKind::Bool(b)) => a == b,
        (ExprKind::Ref(a), ExprKind::Ref(b)) => is_same(a, b),
        (ExprKind::Point(a, b), ExprKind::Point(c, d)) => is_like(a, c) && is_like(b, d),
        (ExprKind::Coordinate(a, x), ExprKind::Coordinate(b, y)) => x == y && is_like(a, b),
        (ExprKind::Unary { op: x, operand: a }, ExprKind::Unary { op: y, operand: b }) => {
            x.node == y.node && is_like(a, b)
        }
        (
            ExprKind::Binary {
                op: x,
                left: a,
                right: b,
            },
            ExprKind::Binary {
                op: y,
                left: c,
                right: d,
            },
        ) => x.node == y.node && is_like(a, c) && is_like(b, d),
        _ => false,
    }
}

/// Whether two blocks are written alike and do the same.
pub fn does_the_same(a: &Block, b: &Block) -> bool {
    let mut both = a.stmts.iter().zip(&b.stmts);
    a.stmts.len() == b.stmts.len() && both.all(|(a, b)| is_like_stmt(a, b))
}

fn is_like_stmt(a: &Stmt, b: &Stmt) -> bool {
    match (&a.kind, &b.kind) {
        (StmtKind::Let(a), StmtKind::Let(b)) => {
            a.name.name == b.name.name && is_like(&a.value, &b.value)
        }
        (
            StmtKind::Assign {
                target: a,
                op: x,
                value: of_a,
            },
            StmtKind::Assign {
                target: b,
                op: y,
                value: of_b,
            },
        ) => x.node == y.node && is_same(a, b) && is_like(of_a, of_b),
        (StmtKind::Call(a), StmtKind::Call(b)) => is_same(a, b),
        (StmtKind::Branch(a), StmtKind::Branch(b)) => is_like_branch(a, b),
        _ => false,
    }
}

fn is_like_branch(a: &Branch, b: &Branch) -> bool {
    let otherwise = match (a.otherwise.as_deref(), b.otherwise.as_deref()) {
        (None, None) => true,
        (Some(Else::Block(a)), Some(Else::Block(b))) => does_the_same(a, b),
        (Some(Else::If(a)), Some(Else::If(b))) => is_like_branch(a, b),
        _ => false,
    };
    otherwise && is_like(&a.cond, &b.cond) && does_the_same(&a.then, &b.then)
}

/// Whether two references are written alike and have one value.
pub fn is_same(a: &Ref, b: &Ref) -> bool {
    let draws = DRAWS.contains(&a.name.name.as_str());
    if draws || a.name.name != b.name.name || a.args.is_some() != b.args.is_some() {
        return false;
    }
    let (a, b) = (
        a.args.as_deref().unwrap_or_default(),
        b.args.as_deref().unwrap_or_default(),
    );
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_given(a, b))
}

fn is_given(a: &Arg, b: &Arg) -> bool {
    match (&a.kind, &b.kind) {
        (ArgKind::Positional(a), ArgKind::Positional(b)) => is_like(a, b),
        (ArgKind::Named(x, a), ArgKind::Named(y, b)) => x.name == y.name && is_like(a, b),
        _ => false,
    }
}

/// Whether an expression is a number, perhaps with a sign.
fn is_literal(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(_) | ExprKind::Bool(_) => true,
        ExprKind::Paren(inner) | ExprKind::Unary { operand: inner, .. } => is_literal(inner),
        _ => false,
    }
}
