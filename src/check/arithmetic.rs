//! Functions of numbers.

use super::Checker;
use super::builtin::Function;
use super::types::units::Dim;
use super::types::{Type, Typed};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Binary, Unary};
use crate::syntax::ast::Ref;

impl<'a> Checker<'a> {
    /// A function of one number.
    pub fn function_of_one(&mut self, function: Function, reference: &'a Ref) -> Typed {
        use Function as F;
        let span = reference.span;
        let Some(&[value]) = self.positional(reference, 1, 1).as_deref() else {
            return Typed::error(span);
        };
        let angle = Type::Quantity(Dim::ANGLE);
        let role = format!("the argument of `{}`", reference.name.name);
        let same = |ty: &Type| ty.clone();
        let (op, argument, ty): (Unary, Typed, Type) = match function {
            F::Sin | F::Cos | F::Tan => {
                let op = match function {
                    F::Sin => Unary::Sin,
                    F::Cos => Unary::Cos,
                    _ => Unary::Tan,
                };
                (op, self.expect(value, &angle, &role), Type::NUMBER)
            }
            F::Asin | F::Acos | F::Atan => {
                let op = match function {
                    F::Asin => Unary::Asin,
                    F::Acos => Unary::Acos,
                    _ => Unary::Atan,
                };
                (op, self.expect(value, &Type::NUMBER, &role), angle)
            }
            F::Wrap => (Unary::Wrap, self.expect(value, &angle, &role), angle),
            F::Exp | F::Ln | F::Floor | F::Ceil | F::Round => {
                let op = match function {
                    F::Exp => Unary::Exp,
                    F::Ln => Unary::Ln,
                    F::Floor => Unary::Floor,
                    F::Ceil => Unary::Ceil,
                    _ => Unary::Round,
                };
                (op, self.expect(value, &Type::NUMBER, &role), Type::NUMBER)
            }
            _ => {
                let argument = self.expr(value);
                let Some(dim) = self.number(&argument) else {
                    return Typed::error(span);
                };
                match function {
                    F::Sign => (Unary::Sign, argument, Type::NUMBER),
                    F::Sqrt => match dim.root() {
                        Some(root) => (Unary::Sqrt, argument, Type::Quantity(root)),
                        None => {
                            self.report(
                                Diagnostic::new(
                                    Code::E0301,
                                    argument.span,
                                    format!("{dim} has no square root with a unit"),
                                )
                                .label("the exponents of its unit are odd"),
                            );
                            return Typed::error(span);
                        }
                    },
                    _ => {
                        let ty = same(&argument.ty);
                        (Unary::Abs, argument, ty)
                    }
                }
            }
        };
        self.lifted(ty, span, &[&argument], |pool, ids| match ids {
            [a] => Some(pool.unary(op, *a)),
            _ => None,
        })
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

    pub fn extremum(&mut self, op: Binary, reference: &'a Ref) -> Typed {
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
