//! Expressions: literals, operators, choices.

pub mod draw;
pub mod ending;
pub mod quantifier;
pub mod reading;
pub mod reference;

use super::Checker;
use super::context::Binding;
use super::types::units::{self, Dim};
use super::types::{Type, Typed, Value};
use crate::diagnostic::{Applicability, Code, Diagnostic, Label};
use crate::ir::expr::{Binary, ExprId, Unary};
use crate::source::Span;
use crate::syntax::ast::{self, BinaryOp, Expr, ExprKind, Otherwise, UnaryOp};

/// How many expressions may be checked within one another, those of unrolled bodies included.
const DEEP: usize = 700;

impl<'a> Checker<'a> {
    /// Checks an expression.
    pub fn expr(&mut self, expr: &'a Expr) -> Typed {
        self.depth += 1;
        let typed = if self.depth > DEEP {
            self.too_much(expr.span, "this stands too deep within");
            Typed::error(expr.span)
        } else {
            self.expr_within(expr)
        };
        self.depth -= 1;
        typed
    }

    fn expr_within(&mut self, expr: &'a Expr) -> Typed {
        let mut typed = match &expr.kind {
            ExprKind::Number(literal) => self.literal(literal, expr.span),
            ExprKind::Bool(value) => {
                let id = self.program.pool.bool(*value);
                Typed {
                    ty: Type::Bool,
                    value: Value::Scalar(id),
                    span: expr.span,
                }
            }
            ExprKind::Ref(reference) => self.reference(reference),
            ExprKind::If(choice) => self.choice(choice, expr.span),
            ExprKind::Point(x, y) => self.point(x, y, expr.span),
            ExprKind::Paren(inner) => self.expr(inner),
            ExprKind::Unary { op, operand } => self.unary(op.node, operand, expr.span),
            ExprKind::Binary { op, left, right } => self.binary(*op, left, right, expr.span),
            ExprKind::Error => Typed::error(expr.span),
        };
        typed.span = expr.span;
        typed
    }

    /// Checks an expression that has to be of a type.
    pub fn expect(&mut self, expr: &'a Expr, wanted: &Type, role: &str) -> Typed {
        let typed = self.expr(expr);
        self.coerce(typed, expr, wanted, role)
    }

    /// Reports an expression that is not of the wanted type; what comes back is of that type or an error.
    pub fn coerce(&mut self, typed: Typed, expr: &Expr, wanted: &Type, role: &str) -> Typed {
        if typed.ty.fits(wanted) {
            self.warn_plain_ratio(expr, wanted);
            return typed;
        }
        let message = format!("{role} is {wanted}, not {}", typed.ty);
        let diagnostic = match (typed.ty.dim(), wanted.dim()) {
            (Some(_), Some(dim)) => with_unit_fix(
                Diagnostic::new(Code::E0301, typed.span, message)
                    .label(format!("this is {}", typed.ty)),
                expr,
                dim,
            ),
            _ => Diagnostic::new(Code::E0302, typed.span, message)
                .label(format!("this is {}", typed.ty)),
        };
        self.report(diagnostic);
        Typed::error(typed.span)
    }

    /// Checks an expression that has to be of the type of another one.
    pub fn expect_like(&mut self, expr: &'a Expr, first: &Typed, role: &str) -> Typed {
        let ty = first.ty.clone();
        let before = self.diagnostics.len();
        let typed = self.expr(expr);
        let fits = typed.ty.fits(&ty);
        let typed = self.coerce(typed, expr, &ty, role);
        if !fits
            && self.diagnostics.len() > before
            && let Some(said) = self.diagnostics.last_mut()
        {
            said.labels.push(Label {
                span: first.span,
                message: format!("this is {ty}"),
            });
        }
        typed
    }

    /// Checks an expression that has to be a constant number of a dimension.
    pub fn constant(&mut self, expr: &'a Expr, wanted: &Type, role: &str) -> Option<f64> {
        let typed = self.expect(expr, wanted, role);
        self.constant_of(&typed, role)
    }

    /// The number that a checked expression is, reported where it is not a constant.
    pub fn constant_of(&mut self, typed: &Typed, role: &str) -> Option<f64> {
        let id = typed.scalar()?;
        let value = self.program.pool.constant(id);
        if value.is_none() {
            self.report(
                Diagnostic::new(
                    Code::E0303,
                    typed.span,
                    format!("{role} has to be a constant"),
                )
                .label("this changes as the program runs"),
            );
        }
        match value {
            Some(number) if !number.is_finite() => {
                let what = if number.is_nan() {
                    "no number at all"
                } else {
                    "a number without end"
                };
                self.report(
                    Diagnostic::new(Code::E0309, typed.span, format!("{role} is not a number"))
                        .label(format!("this comes to {what}")),
                );
                None
            }
            other => other,
        }
    }

    fn literal(&mut self, literal: &ast::Literal, span: Span) -> Typed {
        let Some(unit) = &literal.unit else {
            let id = self.program.pool.num(literal.value);
            return Typed {
                ty: Type::NUMBER,
                value: Value::Scalar(id),
                span,
            };
        };
        match units::meaning(unit, self.tick) {
            Some(meaning) => {
                let id = self.program.pool.num(meaning.scale.apply(literal.value));
                Typed {
                    ty: if meaning.percent {
                        Type::Ratio
                    } else {
                        Type::Quantity(meaning.dim)
                    },
                    value: Value::Scalar(id),
                    span,
                }
            }
            // Ticks before the world has said how long they are: the type is known all the same.
            None => match units::meaning(unit, Some(1.0)) {
                Some(meaning) => {
                    // A world says how long a tick is before it says anything else.
                    let saying = self.has_world && self.program.world.is_none();
                    if !self.has_world || saying {
                        let message = if saying {
                            "a tick is not measured in ticks"
                        } else {
                            "ticks are counted by a world, and there is none"
                        };
                        self.report(
                            Diagnostic::new(Code::E0407, unit.span, message)
                                .label("how many seconds are these?"),
                        );
                    }
                    Typed {
                        ty: Type::Quantity(meaning.dim),
                        value: Value::Unknown,
                        span,
                    }
                }
                None => Typed::error(span),
            },
        }
    }

    fn point(&mut self, x: &'a Expr, y: &'a Expr, span: Span) -> Typed {
        let length = Type::Quantity(Dim::LENGTH);
        let x = self.expect(x, &length, "a coordinate");
        let y = self.expect(y, &length, "a coordinate");
        let value = match (x.scalar(), y.scalar()) {
            (Some(x), Some(y)) => Value::Point(x, y),
            _ => Value::Unknown,
        };
        Typed {
            ty: Type::Point,
            value,
            span,
        }
    }

    fn unary(&mut self, op: UnaryOp, operand: &'a Expr, span: Span) -> Typed {
        if op == UnaryOp::Not {
            let operand = self.expect(operand, &Type::Bool, "what `not` negates");
            return self.lifted(Type::Bool, span, &[&operand], |pool, ids| match ids {
                [a] => Some(pool.not(*a)),
                _ => None,
            });
        }
        let operand = self.expr(operand);
        if operand.ty == Type::Error {
            return Typed::error(span);
        }
        if operand.ty.dim().is_none() {
            self.report(
                Diagnostic::new(
                    Code::E0302,
                    operand.span,
                    format!("a sign stands before a number, not before {}", operand.ty),
                )
                .label(format!("this is {}", operand.ty)),
            );
            return Typed::error(span);
        }
        self.lifted(
            operand.ty.clone(),
            span,
            &[&operand],
            |pool, ids| match ids {
                [a] if op == UnaryOp::Neg => Some(pool.unary(Unary::Neg, *a)),
                [a] => Some(*a),
                _ => None,
            },
        )
    }

    fn binary(
        &mut self,
        op: ast::Spanned<BinaryOp>,
        left: &'a Expr,
        right: &'a Expr,
        span: Span,
    ) -> Typed {
        match op.node {
            BinaryOp::And | BinaryOp::Or => {
                let word = if op.node == BinaryOp::And {
                    "and"
                } else {
                    "or"
                };
                let role = format!("each side of `{word}`");
                let a = self.expect(left, &Type::Bool, &role);
                let b = self.expect(right, &Type::Bool, &role);
                let op = if op.node == BinaryOp::And {
                    Binary::And
                } else {
                    Binary::Or
                };
                self.lift_binary(op, Type::Bool, &a, &b, span)
            }
            BinaryOp::Eq
            | BinaryOp::Ne
            | BinaryOp::Lt
            | BinaryOp::Le
            | BinaryOp::Gt
            | BinaryOp::Ge => self.comparison(op, left, right, span),
            BinaryOp::Add | BinaryOp::Sub => {
                let (a, b) = (self.expr(left), self.expr(right));
                let Some((a, b)) = self.same_dimension(op, (left, a), (right, b)) else {
                    return Typed::error(span);
                };
                let ty = match (&a.ty, &b.ty) {
                    (Type::Ratio, _) | (_, Type::Ratio) => Type::Ratio,
                    _ => a.ty.clone(),
                };
                let op = if op.node == BinaryOp::Add {
                    Binary::Add
                } else {
                    Binary::Sub
                };
                self.lift_binary(op, ty, &a, &b, span)
            }
            BinaryOp::Mul | BinaryOp::Div => {
                let (a, b) = (self.expr(left), self.expr(right));
                let (Some(x), Some(y)) = (self.number(&a), self.number(&b)) else {
                    return Typed::error(span);
                };
                let (op, power) = if op.node == BinaryOp::Mul {
                    (Binary::Mul, 1)
                } else {
                    (Binary::Div, -1)
                };
                let ty = match (&a.ty, &b.ty) {
                    (Type::Ratio, Type::Ratio) if power == 1 => Type::Ratio,
                    _ => Type::Quantity(x.times(y, power)),
                };
                self.lift_binary(op, ty, &a, &b, span)
            }
            BinaryOp::Pow => self.power(left, right, span),
        }
    }

    fn comparison(
        &mut self,
        op: ast::Spanned<BinaryOp>,
        left: &'a Expr,
        right: &'a Expr,
        span: Span,
    ) -> Typed {
        let (a, b) = (self.expr(left), self.expr(right));
        if a.ty == Type::Error || b.ty == Type::Error {
            return Typed {
                ty: Type::Bool,
                value: Value::Unknown,
                span,
            };
        }
        let equality = matches!(op.node, BinaryOp::Eq | BinaryOp::Ne);
        let words = matches!(a.ty, Type::Bool | Type::Enum(_)) && a.ty == b.ty;
        let operands = if equality && words {
            Some((a, b))
        } else if a.ty.dim().is_some() && b.ty.dim().is_some() {
            self.same_dimension(op, (left, a), (right, b))
        } else {
            self.report(incomparable(op.span, &a, &b));
            None
        };
        let Some((a, b)) = operands else {
            return Typed {
                ty: Type::Bool,
                value: Value::Unknown,
                span,
            };
        };
        self.warn_plain_ratio(left, &b.ty);
        self.warn_plain_ratio(right, &a.ty);
        let (op, a, b) = match op.node {
            BinaryOp::Eq => (Binary::Eq, a, b),
            BinaryOp::Ne => (Binary::Ne, a, b),
            BinaryOp::Lt => (Binary::Lt, a, b),
            BinaryOp::Le => (Binary::Le, a, b),
            BinaryOp::Gt => (Binary::Lt, b, a),
            _ => (Binary::Le, b, a),
        };
        self.lift_binary(op, Type::Bool, &a, &b, span)
    }

    /// `base ^ exponent`: with a unit, the exponent has to be a whole constant.
    fn power(&mut self, base: &'a Expr, exponent: &'a Expr, span: Span) -> Typed {
        let base = self.expr(base);
        let power = self.expect(exponent, &Type::NUMBER, "an exponent");
        let Some(dim) = self.number(&base) else {
            return Typed::error(span);
        };
        let ty = if dim == Dim::NONE {
            Type::NUMBER
        } else {
            let known = power.scalar().and_then(|id| self.program.pool.constant(id));
            match known {
                Some(n) if n.fract() == 0.0 && n.abs() <= 16.0 => {
                    Type::Quantity(Dim::NONE.times(dim, n as i32))
                }
                _ if power.ty == Type::Error => return Typed::error(span),
                _ => {
                    self.report(
                        Diagnostic::new(
                            Code::E0308,
                            power.span,
                            format!("{dim} can only be raised to a whole constant"),
                        )
                        .label("the unit of the result would not be known"),
                    );
                    return Typed::error(span);
                }
            }
        };
        self.lift_binary(Binary::Pow, ty, &base, &power, span)
    }

    fn choice(&mut self, choice: &'a ast::Choice, span: Span) -> Typed {
        let condition = self.expect(&choice.cond, &Type::Bool, "a condition");
        let then = self.yielded(&choice.then);
        let (otherwise, other_expr) = match &choice.otherwise {
            Otherwise::If(inner, span) => (self.choice(inner, *span), None),
            Otherwise::Yield(other) => (self.yielded(other), Some(&*other.value)),
        };
        if then.ty == Type::Error || otherwise.ty == Type::Error {
            return Typed::error(span);
        }
        if !otherwise.ty.fits(&then.ty) {
            let what = match (then.ty.dim(), otherwise.ty.dim()) {
                (Some(_), Some(_)) => "unit",
                _ => "type",
            };
            let code = match (then.ty.dim(), otherwise.ty.dim()) {
                (Some(_), Some(_)) => Code::E0301,
                _ => Code::E0302,
            };
            let mut diagnostic = Diagnostic::new(
                code,
                otherwise.span,
                format!("both sides of a choice are of one {what}"),
            )
            .label(format!("this is {}", otherwise.ty))
            .also(then.span, format!("this is {}", then.ty));
            if let (Some(expr), Some(dim)) = (other_expr, then.ty.dim()) {
                diagnostic = with_unit_fix(diagnostic, expr, dim);
            }
            self.report(diagnostic);
            return Typed::error(span);
        }
        let ty = then.ty.clone();
        self.select(&condition, &then, &otherwise, ty, span)
    }

    /// A choice between two values of one type.
    pub fn select(
        &mut self,
        condition: &Typed,
        then: &Typed,
        otherwise: &Typed,
        ty: Type,
        span: Span,
    ) -> Typed {
        let pool = &mut self.program.pool;
        let value = match (condition.scalar(), &then.value, &otherwise.value) {
            (Some(c), Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(pool.select(c, *a, *b)),
            (Some(c), Value::Point(ax, ay), Value::Point(bx, by)) => {
                Value::Point(pool.select(c, *ax, *bx), pool.select(c, *ay, *by))
            }
            (Some(_), Value::Unknown, _) | (Some(_), _, Value::Unknown) | (None, ..) => {
                Value::Unknown
            }
            (Some(c), a, b) => match pool.constant(c) {
                Some(holds) => if holds != 0.0 { a } else { b }.clone(),
                None if a == b => a.clone(),
                None => {
                    self.not_yet(span, "targets that are chosen while the program runs");
                    return Typed::error(span);
                }
            },
        };
        Typed { ty, value, span }
    }

    /// `{ let … value }`
    pub fn yielded(&mut self, body: &'a ast::Yield) -> Typed {
        let depth = self.context.scope.len();
        for binding in &body.bindings {
            let value = self.binding_value(binding);
            self.binds_anew(&binding.name, "value", depth);
            self.context.scope.push(Binding {
                name: binding.name.name.clone(),
                ty: value.ty,
                value: value.value,
                locals: Vec::new(),
                settable: false,
                span: binding.name.span,
            });
        }
        let value = self.expr(&body.value);
        self.context.scope.truncate(depth);
        value
    }

    /// The value of a `let`, of the type that it says.
    pub fn binding_value(&mut self, binding: &'a ast::Binding) -> Typed {
        self.declared(binding.ty.as_ref(), &binding.value, &binding.name.name)
    }

    /// A value of the type that is written beside it, if one is.
    pub fn declared(&mut self, ty: Option<&ast::TypeExpr>, value: &'a Expr, name: &str) -> Typed {
        match ty {
            Some(written) => {
                let ty = self.type_expr(written);
                let mut typed = self.expect(value, &ty, &format!("`{name}`"));
                if ty != Type::Error {
                    typed.ty = ty;
                }
                typed
            }
            None => self.expr(value),
        }
    }

    /// The dimension of a number; anything else is reported.
    pub fn number(&mut self, typed: &Typed) -> Option<Dim> {
        if typed.ty == Type::Error {
            return None;
        }
        let dim = typed.ty.dim();
        if dim.is_none() {
            self.report(
                Diagnostic::new(
                    Code::E0302,
                    typed.span,
                    format!("a number is needed here, not {}", typed.ty),
                )
                .label(format!("this is {}", typed.ty)),
            );
        }
        dim
    }

    /// Both operands, if they are numbers of one dimension; reported if not.
    fn same_dimension(
        &mut self,
        op: ast::Spanned<BinaryOp>,
        (left, a): (&Expr, Typed),
        (right, b): (&Expr, Typed),
    ) -> Option<(Typed, Typed)> {
        let dims = (self.number(&a), self.number(&b));
        let (Some(x), Some(y)) = dims else {
            return None;
        };
        if x == y {
            return Some((a, b));
        }
        let verb = match op.node {
            BinaryOp::Add => "added to",
            BinaryOp::Sub => "subtracted from",
            _ => "compared with",
        };
        let (one, other) = if op.node == BinaryOp::Sub {
            (&b.ty, &a.ty)
        } else {
            (&a.ty, &b.ty)
        };
        let message = format!("{one} cannot be {verb} {other}");
        // The side without a unit is the likely mistake.
        let (wrong, expr, fine, dim) = if x == Dim::NONE && is_literal(left) {
            (&a, left, &b, y)
        } else {
            (&b, right, &a, x)
        };
        let diagnostic = Diagnostic::new(Code::E0301, wrong.span, message)
            .label(format!("this is {}", wrong.ty))
            .also(fine.span, format!("this is {}", fine.ty));
        self.report(with_unit_fix(diagnostic, expr, dim));
        None
    }

    /// `battery <= 25`: a plain number above 1 where a ratio is meant.
    fn warn_plain_ratio(&mut self, expr: &Expr, wanted: &Type) {
        if *wanted != Type::Ratio {
            return;
        }
        if let ExprKind::Number(literal) = &expr.kind
            && literal.unit.is_none()
            && literal.value > 1.0
        {
            let percent = format!("{}%", literal.digits);
            self.report(
                Diagnostic::new(
                    Code::W0301,
                    expr.span,
                    format!(
                        "`{}` stands for {} %",
                        literal.digits,
                        literal.value * 100.0
                    ),
                )
                .label("a ratio goes from 0 to 1, or from 0% to 100%")
                .fix(
                    format!("write `{percent}`"),
                    expr.span,
                    percent.clone(),
                    Applicability::Unsafe,
                ),
            );
        }
    }

    /// A value that is made of scalars; unknown where one of them is.
    pub fn lifted(
        &mut self,
        ty: Type,
        span: Span,
        operands: &[&Typed],
        make: impl FnOnce(&mut crate::ir::Pool, &[ExprId]) -> Option<ExprId>,
    ) -> Typed {
        let ids: Option<Vec<ExprId>> = operands.iter().map(|operand| operand.scalar()).collect();
        let value = ids
            .and_then(|ids| make(&mut self.program.pool, &ids))
            .map_or(Value::Unknown, Value::Scalar);
        Typed { ty, value, span }
    }

    fn lift_binary(&mut self, op: Binary, ty: Type, a: &Typed, b: &Typed, span: Span) -> Typed {
        self.lifted(ty, span, &[a, b], |pool, ids| match ids {
            [a, b] => Some(pool.binary(op, *a, *b)),
            _ => None,
        })
    }
}

/// Why two values are not compared: they are of different types, or what they are is not compared so.
fn incomparable(op: Span, a: &Typed, b: &Typed) -> Diagnostic {
    if a.ty != b.ty {
        let message = format!("{} cannot be compared with {}", a.ty, b.ty);
        return Diagnostic::new(Code::E0302, b.span, message)
            .label(format!("this is {}", b.ty))
            .also(a.span, format!("this is {}", a.ty));
    }
    let (message, label) = match a.ty {
        Type::Bool => (
            "truth values have no order",
            "only `==` and `!=` compare them",
        ),
        Type::Enum(_) => (
            "the values of an enum have no order",
            "only `==` and `!=` compare them",
        ),
        _ => (
            "only numbers, truth values and enums are compared",
            "these are none of them",
        ),
    };
    Diagnostic::new(Code::E0302, op, message)
        .label(label)
        .also(a.span, format!("this is {}", a.ty))
}

/// Whether an expression is a literal without a unit, perhaps signed.
fn is_literal(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(literal) => literal.unit.is_none(),
        ExprKind::Unary { operand, .. } => is_literal(operand),
        ExprKind::Paren(inner) => is_literal(inner),
        _ => false,
    }
}

/// Offers to write the unit after a literal that lacks it.
pub fn with_unit_fix(diagnostic: Diagnostic, expr: &Expr, dim: Dim) -> Diagnostic {
    let (true, Some(unit)) = (is_literal(expr), dim.unit()) else {
        return diagnostic;
    };
    let zero = matches!(&expr.kind, ExprKind::Number(literal) if literal.value == 0.0);
    diagnostic.fix(
        format!("give it its unit, ` {unit}`"),
        expr.span.after(),
        format!(" {unit}"),
        if zero {
            Applicability::Safe
        } else {
            Applicability::Unsafe
        },
    )
}
