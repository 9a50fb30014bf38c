//! How tightly expressions bind.

use crate::syntax::ast::{BinaryOp, Expr, ExprKind, UnaryOp};

/// How tightly an expression binds, loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Level {
    Or,
    And,
    Not,
    Comparison,
    Sum,
    Term,
    Unary,
    Power,
    Primary,
}

impl Level {
    /// The level of `expr`.
    pub(super) fn of(expr: &Expr) -> Self {
        match &expr.kind {
            ExprKind::Unary { op, .. } => Self::of_unary(op.node),
            ExprKind::Binary { op, .. } => Self::of_binary(op.node),
            _ => Self::Primary,
        }
    }

    /// The level of an expression with this prefix, which its operand reaches, too.
    pub(super) fn of_unary(op: UnaryOp) -> Self {
        match op {
            UnaryOp::Not => Self::Not,
            UnaryOp::Neg | UnaryOp::Pos => Self::Unary,
        }
    }

    fn of_binary(op: BinaryOp) -> Self {
        match op {
            BinaryOp::Or => Self::Or,
            BinaryOp::And => Self::And,
            BinaryOp::Add | BinaryOp::Sub => Self::Sum,
            BinaryOp::Mul | BinaryOp::Div => Self::Term,
            BinaryOp::Pow => Self::Power,
            BinaryOp::Eq
            | BinaryOp::Ne
            | BinaryOp::Lt
            | BinaryOp::Le
            | BinaryOp::Gt
            | BinaryOp::Ge => Self::Comparison,
        }
    }

    /// The levels that the operands of a binary operator reach.
    pub(super) fn sides(op: BinaryOp) -> (Self, Self) {
        match Self::of_binary(op) {
            Self::Or => (Self::Or, Self::And),
            Self::And => (Self::And, Self::Not),
            Self::Sum => (Self::Sum, Self::Term),
            Self::Term => (Self::Term, Self::Unary),
            Self::Power => (Self::Primary, Self::Unary),
            _ => (Self::Sum, Self::Sum),
        }
    }
}
