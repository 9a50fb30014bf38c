//! Functions of numbers.

use crate::check::Checker;
use crate::check::expr::expect::is_literal;
use crate::check::types::units::Dim;
use crate::check::types::{Type, Typed};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::Pool;
use crate::ir::expr::{Binary, ExprId, Kind, Unary};
use crate::syntax::ast::{Expr, ExprKind, Ref};

impl<'a> Checker<'a> {
    /// A function of one number.
    pub fn function_of_one(&mut self, op: Unary, reference: &'a Ref) -> Option<Typed> {
        let &[value] = self.positional(reference, 1, 1)?.as_slice() else {
            return None;
        };
        let role = format!("the argument of `{}`", op.name());
        let argument = match fixed_type(op.takes()) {
            Some(ty) => self.expect(value, &ty, &role),
            None => self.number_of(value)?,
        };
        // Of `wrap(drift) > 0.3 rad/s` it is told once that `drift` is no angle.
        let mistaken = |found: &Diagnostic| found.code == Code::E0301 && found.span() == value.span;
        let alike = op.takes() == op.gives() && argument.ty == Type::Error;
        if alike && self.diagnostics.last().is_some_and(mistaken) {
            return None;
        }
        let ty = match fixed_type(op.gives()) {
            Some(ty) => ty,
            None if op.gives() == Kind::Derived => self.root(&argument)?,
            None => argument.ty.clone(),
        };
        Some(self.lift(ty, reference.span, [&argument], |pool, [a]| {
            pool.unary(op, a)
        }))
    }

    /// A function of two numbers of one unit; of more, where its result is of that unit, too.
    pub fn function_of_two(&mut self, op: Binary, reference: &'a Ref) -> Option<Typed> {
        let Some(ty) = fixed_type(op.gives()) else {
            return self.fold(op, reference);
        };
        let [a, b] = self.two_alike(reference)?;
        Some(self.lift(ty, reference.span, [&a, &b], |pool, [a, b]| {
            pool.binary(op, a, b)
        }))
    }

    /// The type of a square root.
    fn root(&mut self, square: &Typed) -> Option<Type> {
        let dim = square.ty.dim()?;
        match dim.root() {
            Some(root) => Some(Type::Quantity(root)),
            None => {
                let message = format!("{dim} has no square root with a unit");
                self.error(Code::E0301, square.span, message)
                    .label("the exponents of its unit are odd")
                    .none()
            }
        }
    }

    /// The arguments of a function of two numbers of one unit.
    pub fn two_alike(&mut self, reference: &'a Ref) -> Option<[Typed; 2]> {
        let values = self.positional(reference, 2, 2)?;
        let role = format!("the second argument of `{}`", reference.name.name);
        self.numbers(&values, &role)?.try_into().ok()
    }

    /// `op(a, b, c)` is `op(op(a, b), c)`.
    fn fold(&mut self, op: Binary, reference: &'a Ref) -> Option<Typed> {
        let values = self.positional(reference, 2, usize::MAX)?;
        let role = format!("every argument of `{}`", reference.name.name);
        let mut numbers = self.numbers(&values, &role)?.into_iter();
        let first = numbers.next()?;
        Some(numbers.fold(first, |so_far, next| {
            let (ty, span) = (so_far.ty.clone(), so_far.span);
            self.lift(ty, span, [&so_far, &next], |pool, [a, b]| {
                pool.binary(op, a, b)
            })
        }))
    }

    /// `clamp(x, limit)` is x within ± limit, `clamp(x, low, high)` within an interval.
    pub fn clamp(&mut self, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        let values = self.positional(reference, 2, 3)?;
        let numbers = self.within_limits(&values)?;
        let ty = numbers.first()?.ty.clone();
        match numbers.as_slice() {
            [_, limit] if self.is_negative(limit) => self
                .out_of_range(
                    limit.span,
                    "a limit of `clamp` is not below zero",
                    "a number goes from minus this to this",
                )
                .none(),
            [x, limit] => Some(self.lift(ty, span, [x, limit], |pool, [x, limit]| {
                let low = pool.unary(Unary::Neg, limit);
                clamped(pool, x, low, limit)
            })),
            [_, low, high] if self.is_more(low, high) => self
                .out_of_range(
                    low.span.to(high.span),
                    "`clamp` goes from less to more",
                    "this goes from more to less",
                )
                .help("exchange the two")
                .none(),
            [x, low, high] => Some(self.lift(ty, span, [x, low, high], |pool, [x, low, high]| {
                clamped(pool, x, low, high)
            })),
            _ => None,
        }
    }

    /// Whether this is a constant below zero.
    fn is_negative(&self, limit: &Typed) -> bool {
        let value = limit.scalar().and_then(|id| self.program.pool.constant(id));
        value.is_some_and(|value| value < 0.0) && !self.context.library
    }

    /// A number with its limits. These are measures that somebody knows, and the number is reckoned: where they have one unit
    /// and it has another, it is the number that is wrong.
    fn within_limits(&mut self, values: &[&'a Expr]) -> Option<Vec<Typed>> {
        let (value, limits) = values.split_first()?;
        let number = self.number_of(value)?;
        let limits = limits
            .iter()
            .map(|limit| (*limit, self.expr_like(limit, &number.ty)));
        let limits: Vec<(&'a Expr, Typed)> = limits.collect();
        let unit = unit_of(&limits).filter(|limit| limit.ty.dim() != number.ty.dim());
        if let (Some(limit), ExprKind::Binary { .. }) = (unit, &value.kind) {
            self.like(number, value, limit, "what `clamp` limits");
            return None;
        }
        let mut like = number.clone();
        let mut all = vec![number];
        for (limit, typed) in limits {
            all.push(self.next_alike(value, &mut like, (limit, typed), "a limit of `clamp`")?);
        }
        Some(all)
    }

    /// Whether one constant is more than another.
    fn is_more(&self, one: &Typed, other: &Typed) -> bool {
        let constant = |it: &Typed| it.scalar().and_then(|id| self.program.pool.constant(id));
        matches!((constant(one), constant(other)), (Some(one), Some(other)) if one > other)
    }

    /// Numbers, all of the unit of the first.
    fn numbers(&mut self, values: &[&'a Expr], role: &str) -> Option<Vec<Typed>> {
        let (first, rest) = values.split_first()?;
        let typed = self.number_of(first)?;
        self.alike((first, typed), rest, role)
    }

    /// The first of some values with the rest, which have to be of one type with it.
    pub fn alike(
        &mut self,
        (lead, first): (&'a Expr, Typed),
        rest: &[&'a Expr],
        role: &str,
    ) -> Option<Vec<Typed>> {
        let mut all = vec![first.clone()];
        let mut like = first;
        for value in rest {
            let next = self.expr_like(value, &like.ty);
            all.push(self.next_alike(lead, &mut like, (value, next), role)?);
        }
        Some(all)
    }

    /// A further value, which has to be of the type of those before it.
    fn next_alike(
        &mut self,
        lead: &'a Expr,
        like: &mut Typed,
        (value, next): (&'a Expr, Typed),
        role: &str,
    ) -> Option<Typed> {
        // A number without a unit says least of what is meant: it lacks the unit of the others.
        let unlike = next.ty.dim().is_some() && next.ty.join(&like.ty).is_none();
        if unlike && like.ty == Type::NUMBER && is_literal(lead) {
            self.lacks_the_unit_of(&next, (lead, like), role);
            return None;
        }
        let next = self.like(next, value, like, role);
        if next.ty == Type::Error {
            return None;
        }
        if let Some(joined) = like.ty.join(&next.ty) {
            like.ty = joined;
        }
        Some(next)
    }

    /// Reports a plain number that stands beside a number with a unit.
    fn lacks_the_unit_of(&mut self, other: &Typed, (value, typed): (&Expr, &Typed), role: &str) {
        let message = match role.strip_prefix("the second ") {
            Some(role) => format!("the first {role} is {}, not {}", other.ty, typed.ty),
            None => format!("{role} is {}, not {}", other.ty, typed.ty),
        };
        self.unlike(typed, &other.ty, message)
            .this_is(&typed.ty)
            .unit_for(value, other.ty.dim())
            .also(other.span, format!("this is {}", other.ty));
    }

    fn number_of(&mut self, value: &'a Expr) -> Option<Typed> {
        let typed = self.expr(value);
        self.number(&typed)?;
        Some(typed)
    }
}

/// The first of some values, if all of them have one unit.
fn unit_of<'v>(values: &'v [(&Expr, Typed)]) -> Option<&'v Typed> {
    let (_, first) = values.first()?;
    let dim = first.ty.dim().filter(|dim| *dim != Dim::NONE)?;
    let mut all = values.iter();
    all.all(|(_, value)| value.ty.dim() == Some(dim))
        .then_some(first)
}

fn clamped(pool: &mut Pool, x: ExprId, low: ExprId, high: ExprId) -> ExprId {
    let floor = pool.binary(Binary::Max, x, low);
    pool.binary(Binary::Min, floor, high)
}

/// The type of a kind; `None` if it depends on the operands.
fn fixed_type(kind: Kind) -> Option<Type> {
    match kind {
        Kind::Truth => Some(Type::Bool),
        Kind::Number => Some(Type::NUMBER),
        Kind::Angle => Some(Type::ANGLE),
        Kind::Quantity | Kind::Derived => None,
    }
}
