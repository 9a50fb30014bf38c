//! The names of instances: a family with the arguments that a reference gives it.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::context::Binding;
use crate::check::types::{Type, Value};
use crate::ir::name::{Argument, Given, Name};
use crate::syntax::ast::{self, ArgKind, ExprKind, Ref};
use crate::syntax::print;

impl Checker<'_> {
    /// The name of what a reference makes of a family, its parameters bound in `scope`. An argument that says what the
    /// default says is left out, so that one instance has one name.
    pub fn instance_name(
        &self,
        params: Option<&ast::Params>,
        reference: &Ref,
        scope: &[Binding],
    ) -> Name {
        let params: &[ast::Param] = params.map_or(&[], |params| &params.params);
        let args = reference.args.as_deref().unwrap_or_default();
        let mut positional = args.iter().filter_map(|arg| match &arg.kind {
            ArgKind::Positional(value) => Some(value),
            ArgKind::Binder { member, .. } => Some(&**member),
            _ => None,
        });
        let arguments = params.iter().zip(scope).map(|(param, binding)| {
            let named = args.iter().find_map(|arg| match &arg.kind {
                ArgKind::Named(name, value) if name.name == param.name.name => Some(value),
                _ => None,
            });
            let given = positional.next().or(named);
            let value = given.map(|given| self.argument(given, &binding.ty, &binding.value));
            let default = param.default.as_ref().map(print::expr);
            Argument {
                parameter: param.name.name.clone(),
                value: value.filter(|value| default != Some(value.to_string())),
            }
        });
        Name::instance(&reference.name.name, arguments.collect())
    }

    /// An argument in a name: a target by its own name, a literal in its own spelling.
    pub fn argument(&self, given: &ast::Expr, ty: &Type, value: &Value) -> Given {
        // What a parameter of the body at hand was given has its name already.
        if let ExprKind::Ref(Ref {
            name, args: None, ..
        }) = &given.kind
            && let Some(bound) = self.context.lookup(&name.name)
            && let Some(known) = &bound.given
        {
            return known.clone();
        }
        if let Some(named) = self.given_member(ty, value) {
            return named;
        }
        match (value, &given.kind) {
            // A parameter of a subtree or a shared expression stands for a number that is not written here.
            (Value::Scalar(id), _)
                if self.mentions_parameter(given)
                    && let Some(number) = self.program.pool.constant(*id) =>
            {
                Given::Text(number.to_string())
            }
            (
                _,
                ExprKind::Ref(Ref {
                    name, args: None, ..
                }),
            ) => Given::Name(Name::word(&name.name)),
            _ => match tuned(given) {
                Some(value) => Given::Tuned {
                    written: print::expr(given),
                    value: print::expr(value),
                },
                None => Given::Text(print::expr_with(given, &|name| self.text_of(name))),
            },
        }
    }

    /// What a name of the body at hand was given, as an operand.
    fn text_of(&self, name: &str) -> Option<String> {
        let bound = self.context.lookup(name)?;
        let known = bound.given.clone();
        let given = known.or_else(|| self.given_member(&bound.ty, &bound.value))?;
        Some(match given {
            Given::Text(text) if !is_operand(&text) => format!("({text})"),
            given => given.to_string(),
        })
    }

    pub fn mentions_parameter(&self, given: &ast::Expr) -> bool {
        match &given.kind {
            ExprKind::Ref(reference) => self.context.lookup(&reference.name.name).is_some(),
            ExprKind::Paren(inner) | ExprKind::Coordinate(inner, _) => {
                self.mentions_parameter(inner)
            }
            ExprKind::Unary { operand, .. } => self.mentions_parameter(operand),
            ExprKind::Binary { left, right, .. } => {
                self.mentions_parameter(left) || self.mentions_parameter(right)
            }
            _ => false,
        }
    }
}

/// Whether a text may stand beside an operator as it is: a call, a name, or a number with its unit.
fn is_operand(text: &str) -> bool {
    let mut open = 0_usize;
    let blanks = text.chars().filter(|c| {
        match c {
            '(' => open += 1,
            ')' => open = open.saturating_sub(1),
            _ => {}
        }
        *c == ' ' && open == 0
    });
    let is_number = |word: &str| word.parse::<f64>().is_ok();
    match blanks.count() {
        0 => true,
        1 => text.split(' ').next().is_some_and(is_number),
        _ => false,
    }
}

/// The value in use of a `tune`.
fn tuned(given: &ast::Expr) -> Option<&ast::Expr> {
    let ExprKind::Ref(reference) = &given.kind else {
        return None;
    };
    let first = reference.args.as_ref()?.first()?;
    match &first.kind {
        ArgKind::Positional(value) if reference.name.name == Function::Tune.name() => Some(value),
        _ => None,
    }
}
