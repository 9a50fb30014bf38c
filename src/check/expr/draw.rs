//! Random draws.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::{Applicability, Code};
use crate::ir::expr::{Binary, Draw};
use crate::syntax::ast::Ref;

impl<'a> Checker<'a> {
    /// `uniform(a, b)`, `normal(mean, deviation)`, `chance(p)`, `one_of(…)`
    pub fn random(&mut self, function: Function, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        if !self.context.region.draws() {
            return self
                .error(
                    Code::E0306,
                    span,
                    format!(
                        "nothing is drawn at random in {}",
                        self.context.region.name()
                    ),
                )
                .label("its value would change from one look to the next")
                .help("draw it in a `local`, an effect or a `start` line, and read that")
                .none();
        }
        self.same_draws(reference);
        match function {
            Function::Uniform | Function::Normal => {
                let [a, b] = self.two_alike(reference)?;
                self.range_of_draw(function, &a, &b)?;
                let draw = match function {
                    Function::Uniform => Draw::Uniform,
                    _ => Draw::Normal,
                };
                let ty = a.ty.clone();
                Some(self.lift(ty, span, [&a, &b], |pool, [a, b]| pool.draw(draw(a, b))))
            }
            Function::Chance => {
                let &[value] = self.positional(reference, 1, 1)?.as_slice() else {
                    return None;
                };
                let p = self.expect(value, &Type::Ratio, "a chance");
                self.probability(&p, "a chance")?;
                self.draws_always(value, p.scalar());
                Some(self.lift(Type::Bool, span, [&p], |pool, [p]| {
                    pool.draw(Draw::Chance(p))
                }))
            }
            _ => self.one_of(reference),
        }
    }

    /// Reports a range from more to less, and a standard deviation below zero, where they are constant.
    fn range_of_draw(&mut self, function: Function, a: &Typed, b: &Typed) -> Option<()> {
        let low = a.scalar().and_then(|id| self.program.pool.constant(id));
        let high = b.scalar().and_then(|id| self.program.pool.constant(id));
        match (function, low, high) {
            (Function::Uniform, Some(low), Some(high)) if low > high => {
                // `uniform(50, 100%)`
                let percent = b.ty == Type::Ratio && a.ty == Type::NUMBER && low <= high * 100.0;
                let draft = self.out_of_range(
                    a.span.to(b.span),
                    "`uniform` draws from less to more",
                    "this goes from more to less",
                );
                match percent {
                    true => {
                        let after = a.span.after();
                        draft.fix("write `%`", after, "%", Applicability::Unsafe)
                    }
                    false => draft.help("exchange the two"),
                }
                .none()
            }
            (Function::Normal, _, Some(deviation)) if deviation < 0.0 => self
                .out_of_range(
                    b.span,
                    "a standard deviation is not below zero",
                    "this is the second argument: how far the values scatter",
                )
                .none(),
            _ => Some(()),
        }
    }

    fn one_of(&mut self, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        let values = self.positional(reference, 1, usize::MAX)?;
        let (first, rest) = values.split_first()?;
        let typed = self.expr(first);
        if typed.ty == Type::Error {
            return None;
        }
        let choices = self.alike((first, typed), rest, "every choice of `one_of`")?;
        let count = u32::try_from(choices.len()).unwrap_or(u32::MAX);
        let index = self.program.pool.draw(Draw::Pick(count));
        let mut choices = choices.into_iter().enumerate().rev();
        let (_, mut result) = choices.next()?;
        for (i, choice) in choices {
            let i = self.program.pool.num(i as f64);
            let is = self.program.pool.binary(Binary::Eq, index, i);
            let condition = Typed::new(Type::Bool, Value::Scalar(is), span);
            let ty = result.ty.join(&choice.ty)?;
            result = self.select(&condition, &choice, &result, ty, span)?;
        }
        Some(result)
    }
}
