//! Expressions.

use crate::source::Span;
use crate::syntax::ast::{Binding, Ident, Spanned};

/// An expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where it stands.
    pub span: Span,
}

impl Expr {
    /// What has to hold for it to hold, part by part: `a`, `b` and `c` of `a and (b and c)`.
    pub fn conjuncts(&self) -> Vec<&Expr> {
        let mut found = Vec::new();
        let mut open = vec![self];
        while let Some(expr) = open.pop() {
            match &expr.kind {
                ExprKind::Paren(inner) => open.push(inner),
                ExprKind::Binary { op, left, right } if op.node == BinaryOp::And => {
                    open.extend([&**right, &**left]);
                }
                _ => found.push(expr),
            }
        }
        found
    }
}

/// The kinds of expressions.
#[derive(Clone, Debug, PartialEq)]
pub enum ExprKind {
    /// `5_000 ticks`
    Number(Literal),
    /// `true`, `false`
    Bool(bool),
    /// A name, or a call.
    Ref(Ref),
    /// `if c { a } else { b }`
    If(Box<Choice>),
    /// `(x, y)`
    Point(Box<Expr>, Box<Expr>),
    /// `(e)`
    Paren(Box<Expr>),
    /// `e.x`, `e.y`
    Coordinate(Box<Expr>, Axis),
    /// `-e`, `not e`
    Unary {
        /// The operator.
        op: Spanned<UnaryOp>,
        /// The operand.
        operand: Box<Expr>,
    },
    /// `a + b`
    Binary {
        /// The operator.
        op: Spanned<BinaryOp>,
        /// The left operand.
        left: Box<Expr>,
        /// The right operand.
        right: Box<Expr>,
    },
    /// Not understood, and reported.
    Error,
}

/// A coordinate of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    X,
    /// The second.
    Y,
}

/// A number with its unit, in its own spelling.
#[derive(Clone, Debug, PartialEq)]
pub struct Literal {
    /// The digits as they are written, such as `5_000` or `1e-3`.
    pub digits: String,
    /// What they say.
    pub value: f64,
    /// The unit.
    pub unit: Option<Unit>,
}

/// A unit, such as `m/s` or `rad/m`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// As it is written.
    pub text: String,
    /// Its factors.
    pub factors: Vec<UnitFactor>,
    /// Where it stands.
    pub span: Span,
}

/// A factor of a unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFactor {
    /// Its name, from the closed list of the grammar.
    pub name: String,
    /// Its exponent, negative after a `/`.
    pub power: i32,
}

/// A name with arguments.
#[derive(Clone, Debug, PartialEq)]
pub struct Ref {
    /// The name.
    pub name: Ident,
    /// The arguments; `None` where there are no parentheses.
    pub args: Option<Vec<Arg>>,
    /// From the name to the closing parenthesis.
    pub span: Span,
}

/// An argument.
#[derive(Clone, Debug, PartialEq)]
pub struct Arg {
    /// What it is.
    pub kind: ArgKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of arguments.
#[derive(Clone, Debug, PartialEq)]
pub enum ArgKind {
    /// `expr`
    Positional(Expr),
    /// `name = expr`
    Named(Ident, Expr),
    /// `low .. high`
    Range(Expr, Expr),
    /// `b in bush: expr`
    Binder {
        /// What binds.
        name: Ident,
        /// What it ranges over.
        domain: Ident,
        /// What is said of each.
        body: Option<Expr>,
        /// The name that binds, as an expression: what each call of a family is given.
        member: Box<Expr>,
    },
}

/// `if c { a } else { b }` as an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// The condition.
    pub cond: Expr,
    /// The value if it holds.
    pub then: Yield,
    /// The value else.
    pub otherwise: Otherwise,
}

/// What follows the `else` of a choice.
#[derive(Clone, Debug, PartialEq)]
pub enum Otherwise {
    /// `else if …`
    If(Box<Choice>, Span),
    /// `else { … }`
    Yield(Yield),
}

/// `{ let … expr }`
#[derive(Clone, Debug, PartialEq)]
pub struct Yield {
    /// What is bound first.
    pub bindings: Vec<Binding>,
    /// The value.
    pub value: Box<Expr>,
    /// From brace to brace.
    pub span: Span,
}

/// `-`, `+`, `not`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnaryOp {
    /// `-`
    Neg,
    /// `+`
    Pos,
    /// `not`
    Not,
}

/// The binary operators, loosest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum BinaryOp {
    /// `or`
    Or,
    /// `and`
    And,
    /// `==`
    Eq,
    /// `!=`
    Ne,
    /// `<`
    Lt,
    /// `<=`
    Le,
    /// `>`
    Gt,
    /// `>=`
    Ge,
    /// `+`
    Add,
    /// `-`
    Sub,
    /// `*`
    Mul,
    /// `/`
    Div,
    /// `^`
    Pow,
}

/// As many operands of a chain of `and` or `or` lean to the left.
const LEANING: usize = 16;

/// Operands joined by `and` or by `or`; `None` without operands. A long chain is divided into halves, so that depth grows with
/// the logarithm of its length.
pub fn chain(mut operands: Vec<Expr>, mut signs: Vec<Spanned<BinaryOp>>) -> Option<Expr> {
    let join = |left: Expr, op: Spanned<BinaryOp>, right: Expr| Expr {
        span: left.span.to(right.span),
        kind: ExprKind::Binary {
            op,
            left: Box::new(left),
            right: Box::new(right),
        },
    };
    if operands.len() > LEANING {
        let half = operands.len() / 2;
        let right = chain(operands.split_off(half), signs.split_off(half))?;
        let sign = signs.pop()?;
        return Some(join(chain(operands, signs)?, sign, right));
    }
    let mut operands = operands.into_iter();
    let first = operands.next()?;
    let rest = signs.into_iter().zip(operands);
    Some(rest.fold(first, |left, (op, right)| join(left, op, right)))
}

/// How deep a chain of so many operators is.
pub fn chain_depth(operators: usize) -> usize {
    let mut operands = operators + 1;
    let mut halved = 0;
    while operands > LEANING {
        operands = operands.div_ceil(2);
        halved += 1;
    }
    halved + operands - 1
}
