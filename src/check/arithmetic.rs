//! Functions of numbers.

use super::Checker;
use super::types::units::Dim;
use super::types::{Type, Typed};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Binary, Kind, Unary};
use crate::syntax::ast::Ref;

impl<'a> Checker<'a> {
    /// A function of one number.
    pub fn function_of_one(&mut self, op: Unary, reference: &'a Ref) -> Typed {
        let span = reference.span;
        let Some(&[value]) = self.positional(reference, 1, 1).as_deref() else {
            return Typed::error(span);
        };
        let role = format!("the argument of `{}`", op.name());
        let argument = match fixed_type(op.takes()) {
            Some(ty) => self.expect(value, &ty, &role),
            None => {
                let argument = self.expr(value);
                if self.number(&argument).is_none() {
                    return Typed::error(span);
                }
                argument
            }
        };
        let ty = match fixed_type(op.gives()) {
            Some(ty) => Some(ty),
            None if op.gives() == Kind::Derived => self.root(&argument),
            None => Some(argument.ty.clone()),
        };
        let Some(ty) = ty else {
            return Typed::error(span);
        };
        self.lifted(ty, span, &[&argument], |pool, ids| match ids {
            [a] => Some(pool.unary(op, *a)),
            _ => None,
        })
    }

    /// A function of two numbers of one unit; of more, where its result is of that unit, too.
    pub fn function_of_two(&mut self, op: Binary, reference: &'a Ref) -> Typed {
        let span = reference.span;
        let Some(ty) = fixed_type(op.gives()) else {
            return self.fold(op, reference);
        };
        let Some((a, b)) = self.two_alike(reference) else {
            return Typed::error(span);
        };
        self.lifted(ty, span, &[&a, &b], |pool, ids| match ids {
            [a, b] => Some(pool.binary(op, *a, *b)),
            _ => None,
        })
    }

    /// The type of a square root.
    fn root(&mut self, square: &Typed) -> Option<Type> {
        let dim = square.ty.dim()?;
        let root = dim.root();
        if root.is_none() {
            let message = format!("{dim} has no square root with a unit");
            self.report(
                Diagnostic::new(Code::E0301, square.span, message)
                    .label("the exponents of its unit are odd"),
            );
        }
        root.map(Type::Quantity)
    }

    pub fn two_alike(&mut self, reference: &'a Ref) -> Option<(Typed, Typed)> {
        let values = self.positional(reference, 2, 2)?;
        let [first, second] = values.as_slice() else {
            return None;
        };
        let a = self.expr(first);
        self.number(&a)?;
        let role = format!("the second argument of `{}`", reference.name.name);
        let b = self.expect_like(second, &a, &role);
        (b.ty != Type::Error).then_some((a, b))
    }

    /// `op(a, b, c)` is `op(op(a, b), c)`.
    fn fold(&mut self, op: Binary, reference: &'a Ref) -> Typed {
        let span = reference.span;
        let Some(values) = self.positional(reference, 2, usize::MAX) else {
            return Typed::error(span);
        };
        let role = format!("every argument of `{}`", reference.name.name);
        let mut result: Option<Typed> = None;
        for value in values {
            let next = match &result {
                None => {
                    let first = self.expr(value);
                    if self.number(&first).is_none() {
                        return Typed::error(span);
                    }
                    first
                }
                Some(so_far) => {
                    let ty = so_far.ty.clone();
                    let next = self.expect_like(value, so_far, &role);
                    if next.ty == Type::Error {
                        return Typed::error(span);
                    }
                    self.lifted(ty, so_far.span, &[so_far, &next], |pool, ids| match ids {
                        [a, b] => Some(pool.binary(op, *a, *b)),
                        _ => None,
                    })
                }
            };
            result = Some(next);
        }
        result.unwrap_or_else(|| Typed::error(span))
    }

    /// `clamp(x, limit)` is x within ± limit, `clamp(x, low, high)` within an interval.
    pub fn clamp(&mut self, reference: &'a Ref) -> Typed {
        let span = reference.span;
        let Some(values) = self.positional(reference, 2, 3) else {
            return Typed::error(span);
        };
        let mut checked: Vec<Typed> = Vec::new();
        for value in values {
            let next = match checked.first() {
                None => {
                    let first = self.expr(value);
                    if self.number(&first).is_none() {
                        return Typed::error(span);
                    }
                    first
                }
                Some(first) => self.expect_like(value, first, "a limit of `clamp`"),
            };
            if next.ty == Type::Error {
                return Typed::error(span);
            }
            checked.push(next);
        }
        let ty = checked.first().map_or(Type::Error, |x| x.ty.clone());
        let operands: Vec<&Typed> = checked.iter().collect();
        self.lifted(ty, span, &operands, |pool, ids| {
            let (x, low, high) = match ids {
                [x, limit] => (*x, pool.unary(Unary::Neg, *limit), *limit),
                [x, low, high] => (*x, *low, *high),
                _ => return None,
            };
            let floor = pool.binary(Binary::Max, x, low);
            Some(pool.binary(Binary::Min, floor, high))
        })
    }
}

/// The type of a kind; `None` if it depends on the operands.
fn fixed_type(kind: Kind) -> Option<Type> {
    match kind {
        Kind::Truth => Some(Type::Bool),
        Kind::Number => Some(Type::NUMBER),
        Kind::Angle => Some(Type::Quantity(Dim::ANGLE)),
        Kind::Quantity | Kind::Derived => None,
    }
}
