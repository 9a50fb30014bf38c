//! Choices, and the values that blocks yield.

use crate::check::Checker;
use crate::check::context::Binding;
use crate::check::expr::expect::is_literal;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::ir::expr::ExprId;
use crate::source::Span;
use crate::syntax::ast::{self, Expr, Otherwise};

impl<'a> Checker<'a> {
    /// `if … { … } else { … }`
    pub fn choice(&mut self, choice: &'a ast::Choice, span: Span) -> Option<Typed> {
        self.choice_after(choice, span, &mut Vec::new())
    }

    /// A choice; `before` holds what the choices around it ask, in whose `else` it stands.
    fn choice_after(
        &mut self,
        choice: &'a ast::Choice,
        span: Span,
        before: &mut Vec<(Span, ExprId)>,
    ) -> Option<Typed> {
        let condition = self.expect(&choice.cond, &Type::Bool, "a condition");
        self.chooses_by(&choice.cond, condition.scalar());
        self.links(&choice.cond, condition.scalar(), before);
        let then = self.yielded(&choice.then);
        if let Otherwise::Yield(other) = &choice.otherwise
            && choice.then.bindings.is_empty()
            && other.bindings.is_empty()
        {
            self.same_branches(&choice.then.value, &other.value);
        }
        let (otherwise, last) = match &choice.otherwise {
            Otherwise::If(inner, span) => (self.choice_after(inner, *span, before), None),
            Otherwise::Yield(other) => {
                self.ends_chain(other.value.span, before);
                (Some(self.yielded(other)), Some(&*other.value))
            }
        };
        let otherwise = otherwise?;
        if then.ty == Type::Error || otherwise.ty == Type::Error {
            return None;
        }
        let Some(ty) = then.ty.join(&otherwise.ty) else {
            let units = then.ty.dim().filter(|_| otherwise.ty.dim().is_some());
            let what = if units.is_some() { "unit" } else { "type" };
            let message = format!("both sides of a choice are of one {what}");
            let draft = self
                .unlike(&otherwise, &then.ty, message)
                .this_is(&otherwise.ty)
                .also(then.span, format!("this is {}", then.ty));
            return match last {
                Some(expr) => draft.unit_for(expr, then.ty.dim()).none(),
                None => draft.none(),
            };
        };
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
    ) -> Option<Typed> {
        let pool = &mut self.program.pool;
        let value = match (condition.scalar(), &then.value, &otherwise.value) {
            (Some(c), Value::Scalar(a), Value::Scalar(b)) => Value::Scalar(pool.select(c, *a, *b)),
            (Some(c), Value::Point(ax, ay), Value::Point(bx, by)) => {
                Value::Point(pool.select(c, *ax, *bx), pool.select(c, *ay, *by))
            }
            (Some(_), Value::Unknown, _) | (Some(_), _, Value::Unknown) | (None, ..) => {
                Value::Unknown
            }
            (Some(c), a, b) => match self.either(c, a, b) {
                Some(chosen) => chosen,
                None => {
                    return self
                        .error(
                            Code::E0303,
                            span,
                            format!("{} is chosen before the program runs", then.ty),
                        )
                        .label("this choice is made while it runs")
                        .none();
                }
            },
        };
        Some(Typed::new(ty, value, span))
    }

    /// `{ let … value }`
    pub fn yielded(&mut self, body: &'a ast::Yield) -> Typed {
        let depth = self.context.scope.len();
        for binding in &body.bindings {
            let Typed { ty, value, .. } = self.binding_value(binding);
            self.bind(Binding::new(&binding.name, ty, value), "value", depth);
        }
        let value = self.expr(&body.value);
        self.context.scope.truncate(depth);
        value
    }

    /// The value of a `let`, of the type that it says.
    pub fn binding_value(&mut self, binding: &'a ast::Binding) -> Typed {
        self.declared_or_unsure(binding.ty.as_ref(), &binding.value, &binding.name.name)
    }

    /// A value with its declared type, if there is one. Where the two do not agree nobody knows which is right, unless it
    /// is only the unit that is missing.
    pub fn declared_or_unsure(
        &mut self,
        ty: Option<&ast::TypeExpr>,
        value: &'a Expr,
        name: &str,
    ) -> Typed {
        let Some(written) = ty else {
            return self.expr(value);
        };
        let ty = self.type_expr(written);
        let typed = self.expr_like(value, &ty);
        let plain = typed.ty == Type::Error || is_literal(value);
        let mut typed = self.coerce(typed, value, &ty, &format!("`{name}`"));
        if ty != Type::Error && (plain || typed.ty != Type::Error) {
            typed.ty = ty;
        }
        typed
    }

    /// A value with its declared type, if there is one.
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
}
