//! Random draws.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::ir::expr::{Binary, Draw};
use crate::syntax::ast::Ref;

impl<'a> Checker<'a> {
    /// `uniform(a, b)`, `normal(mean, deviation)`, `chance(p)`, `one_of(…)`
    pub fn random(&mut self, function: Function, reference: &'a Ref) -> Typed {
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
                .typed();
        }
        match function {
            Function::Uniform | Function::Normal => {
                let Some((a, b)) = self.two_alike(reference) else {
                    return Typed::error(span);
                };
                let ty = a.ty.clone();
                self.lifted(ty, span, &[&a, &b], |pool, ids| match ids {
                    [a, b] if function == Function::Uniform => {
                        Some(pool.draw(Draw::Uniform(*a, *b)))
                    }
                    [a, b] => Some(pool.draw(Draw::Normal(*a, *b))),
                    _ => None,
                })
            }
            Function::Chance => {
                let Some(&[value]) = self.positional(reference, 1, 1).as_deref() else {
                    return Typed::error(span);
                };
                let p = self.expect(value, &Type::Ratio, "a chance");
                self.lifted(Type::Bool, span, &[&p], |pool, ids| match ids {
                    [p] => Some(pool.draw(Draw::Chance(*p))),
                    _ => None,
                })
            }
            _ => self.one_of(reference).unwrap_or_else(|| Typed::error(span)),
        }
    }

    fn one_of(&mut self, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        let values = self.positional(reference, 1, usize::MAX)?;
        let mut choices: Vec<Typed> = Vec::new();
        for value in values {
            let next = match choices.first() {
                None => self.expr(value),
                Some(first) => self.expect_like(value, first, "every choice of `one_of`"),
            };
            if next.ty == Type::Error {
                return None;
            }
            choices.push(next);
        }
        let count = u32::try_from(choices.len()).unwrap_or(u32::MAX);
        let index = self.program.pool.draw(Draw::Pick(count));
        let mut choices = choices.into_iter().enumerate().rev();
        let (_, mut result) = choices.next()?;
        for (i, choice) in choices {
            let i = self.program.pool.num(i as f64);
            let is = self.program.pool.binary(Binary::Eq, index, i);
            let condition = Typed::new(Type::Bool, Value::Scalar(is), span);
            let ty = result.ty.clone();
            result = self.select(&condition, &choice, &result, ty, span)?;
        }
        Some(result)
    }
}
