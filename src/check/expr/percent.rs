//! Percentages beside a state that starts as a whole number: `state battery: number = 100`, and then `battery <= 30%`.

use super::expect::{PASSING, plain_number};
use super::plain_ref;
use crate::check::Checker;
use crate::check::names::Decl;
use crate::check::types::Type;
use crate::diagnostic::{Applicability, Code};
use crate::source::Span;
use crate::syntax::ast::{ArgKind, BinaryOp, Expr, ExprKind, Ident, Ref, State};
use crate::syntax::print;

/// A state that starts at this or more does not count in hundredths.
const WHOLE: f64 = 10.0;

/// A state, and the percentages beside it with how they are written.
pub type InPercent<'a> = (&'a State, Vec<(Span, String)>);

impl<'a> Checker<'a> {
    /// Notes the percentages that a side of a comparison has beside a state on the other one.
    pub fn percent_beside(&mut self, state: &Expr, ty: &Type, value: &'a Expr) {
        if let Some(reference) = plain_ref(state) {
            self.percent_of(&reference.name, ty, value);
        }
    }

    /// Notes the percentages of a value that a state is compared with, or set to, if it is declared as a whole number.
    pub fn percent_of(&mut self, name: &Ident, ty: &Type, value: &'a Expr) {
        if *ty != Type::NUMBER || self.context.lookup(&name.name).is_some() {
            return;
        }
        let declared = self.names.value(&name.name, self.context.library);
        let Some((Decl::State(state), false)) = declared else {
            return;
        };
        if plain_number(&state.value).is_some_and(|start| start >= WHOLE) {
            let beside = self.percents.entry(state.value.span);
            let (_, beside) = beside.or_insert((state, Vec::new()));
            percents(value, beside);
        }
    }

    /// Warns of the whole numbers beside which percentages stand.
    pub fn percents_of_numbers(&mut self) {
        for (start, (state, beside)) in std::mem::take(&mut self.percents) {
            let mut beside = beside;
            beside.sort();
            beside.dedup();
            let Some((at, percent)) = beside.first() else {
                continue;
            };
            let name = &state.name.name;
            let digits = print::expr(&state.value);
            let percent_of_one = 100.0 * plain_number(&state.value).unwrap_or_default();
            let message = format!("`{name}` starts at {digits}, and is reckoned in percent");
            self.warning(Code::W0301, start, message)
                .label(format!("this is {percent_of_one} %"))
                .also(*at, format!("`{percent}` is a part of 1, not of {digits}"))
                .fix(
                    format!("write `{digits}%`"),
                    start,
                    format!("{digits}%"),
                    Applicability::Unsafe,
                )
                .help(format!("or count without `%` wherever `{name}` stands"));
        }
    }
}

/// The percentages up to 100 % in a value, with how they are written.
fn percents(value: &Expr, found: &mut Vec<(Span, String)>) {
    match &value.kind {
        ExprKind::Number(literal) => {
            let is_percent = literal.unit.as_ref().is_some_and(|unit| unit.text == "%");
            if is_percent && literal.value <= 100.0 {
                found.push((value.span, print::expr(value)));
            }
        }
        ExprKind::Paren(inner) => percents(inner, found),
        ExprKind::Unary { operand, .. } => percents(operand, found),
        ExprKind::Binary { op, left, right }
            if matches!(op.node, BinaryOp::Add | BinaryOp::Sub) =>
        {
            percents(left, found);
            percents(right, found);
        }
        ExprKind::Ref(Ref {
            name,
            args: Some(args),
            ..
        }) if PASSING.contains(&name.name.as_str()) => {
            for arg in args {
                match &arg.kind {
                    ArgKind::Positional(value) => percents(value, found),
                    ArgKind::Range(low, high) => {
                        percents(low, found);
                        percents(high, found);
                    }
                    ArgKind::Named(..) | ArgKind::Binder { .. } => {}
                }
            }
        }
        _ => {}
    }
}
