//! Expressions: the entry point, and one file for each kind.

mod arithmetic;
mod call;
mod choice;
mod distance;
mod draw;
mod ending;
pub mod expect;
mod finite;
mod literal;
mod operator;
mod quantifier;
mod ratios;
mod reading;
mod reference;
mod tune;

pub use literal::grouped;
use operator::is_arithmetic;
pub use ratios::InPercent;

use super::Checker;
use super::types::{Type, Typed, Value};
use crate::syntax::ast::{Axis, Expr, ExprKind, Ref};

/// How many expressions may be checked within one another, those of unrolled bodies included.
const DEEP: usize = 400;

impl<'a> Checker<'a> {
    /// Checks an expression; one with a mistake is of `Type::Error`.
    pub fn expr(&mut self, expr: &'a Expr) -> Typed {
        self.depth += 1;
        let wanted = self.wanted.take();
        if plain_ref(expr).is_some() {
            self.wanted = wanted;
        }
        let typed = if self.depth > DEEP {
            self.too_much(expr.span, "this is nested too deeply within");
            None
        } else {
            self.meaning(expr)
        };
        self.depth -= 1;
        self.wanted = None;
        let typed = self.settled(typed, expr);
        if let ExprKind::Ref(reference) = &expr.kind {
            self.is_of_type(&reference.name, &typed.ty);
        }
        typed
    }

    /// Checks an expression that stands where one of type `like` is meant.
    pub fn expr_like(&mut self, expr: &'a Expr, like: &Type) -> Typed {
        self.wanted = Some(like.clone()).filter(|like| *like != Type::Error);
        self.expr(expr)
    }

    /// What an expression came to, as a value of that expression.
    pub(super) fn settled(&mut self, typed: Option<Typed>, expr: &'a Expr) -> Typed {
        let typed = typed.filter(|typed| self.is_finite(typed, expr));
        typed.map_or(Typed::error(expr.span), |typed| Typed {
            span: expr.span,
            ..typed
        })
    }

    fn meaning(&mut self, expr: &'a Expr) -> Option<Typed> {
        let span = expr.span;
        match &expr.kind {
            ExprKind::Number(literal) => self.literal(literal, span),
            ExprKind::Bool(value) => {
                let id = self.program.pool.bool(*value);
                Some(Typed::new(Type::Bool, Value::Scalar(id), span))
            }
            ExprKind::Ref(reference) => self.reference(reference),
            ExprKind::If(choice) => self.choice(choice, span),
            ExprKind::Point(x, y) => Some(self.point(x, y, span)),
            ExprKind::Paren(inner) => Some(self.expr(inner)),
            ExprKind::Coordinate(point, axis) => {
                let point = self.expect(point, &Type::Point, "what has coordinates");
                if point.ty == Type::Error {
                    return None;
                }
                let coordinate = match (point.value, axis) {
                    (Value::Point(x, _), Axis::X) => Some(x),
                    (Value::Point(_, y), Axis::Y) => Some(y),
                    _ => None,
                };
                Some(Typed::new(Type::LENGTH, coordinate, span))
            }
            ExprKind::Unary { op, operand } => self.unary(op.node, operand, span),
            ExprKind::Binary { .. } if self.is_lost_with_a_dash(expr) => None,
            ExprKind::Binary { op, left, right } => match is_arithmetic(op.node) {
                true => self.arithmetic(expr),
                false => self.binary(*op, left, right, span),
            },
            ExprKind::Error => None,
        }
    }
}

/// The reference that an expression is, perhaps in brackets.
pub fn plain_ref(expr: &Expr) -> Option<&Ref> {
    match &expr.kind {
        ExprKind::Ref(reference) => Some(reference),
        ExprKind::Paren(inner) => plain_ref(inner),
        _ => None,
    }
}
