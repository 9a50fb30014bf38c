//! Plain numbers where ratios are meant, `battery <= 25`, also beside a state that only starts as one, `battery: number = 100%`;
//! and percentages beside a state that starts as a whole number: `battery: number = 100`, and then `battery <= 30%`.

use super::expect::{PASSING, is_literal};
use super::plain_ref;
use crate::check::Checker;
use crate::check::names::Decl;
use crate::check::types::Type;
use crate::diagnostic::{Applicability, Code};
use crate::source::Span;
use crate::syntax::ast::{
    Arg, ArgKind, BinaryOp, Choice, Expr, ExprKind, Ident, LetBody, Otherwise, Ref, State,
};
use crate::syntax::print;

/// A state that starts at this or more does not count in hundredths.
const WHOLE: f64 = 10.0;

/// A state, and the percentages beside it with how they are written.
pub type InPercent<'a> = (&'a State, Vec<(Span, String)>);

impl<'a> Checker<'a> {
    /// The number that a name stands for, if it is written as one.
    pub(super) fn plain_constant(&self, expr: &Expr) -> Option<&'a Expr> {
        let reference = plain_ref(expr).filter(|reference| reference.args.is_none())?;
        let name = reference.name.name.as_str();
        if self.context.lookup(name).is_some() {
            return None;
        }
        match self.names.value(name, self.context.library)? {
            (Decl::Let(shared), false) if shared.params.is_none() => match &shared.body {
                LetBody::Expr(value) => Some(value).filter(|value| is_literal(value)),
                LetBody::Yield(_) => None,
            },
            _ => None,
        }
    }

    /// Warns of the constants above 1 that were used as ratios by their names.
    pub fn named_ratios(&mut self) {
        for named in std::mem::take(&mut self.plain_ratios).into_values() {
            self.warn_plain_ratio(named, &Type::Ratio);
        }
    }

    /// `battery <= 25`: a plain number above 1 where a ratio is meant.
    pub fn warn_plain_ratio(&mut self, expr: &Expr, wanted: &Type) {
        if *wanted != Type::Ratio {
            return;
        }
        for (part, beside) in parts(expr) {
            if let Some(named) = self.plain_constant(part) {
                self.plain_ratios.insert(named.span, named);
            }
            // Beside 100, 1 is a percentage, too.
            if plain_number(part).is_some_and(|value| value > 1.0 || beside && value == 1.0) {
                self.plain_ratio(part);
            }
        }
    }

    /// Warns of a plain number that was likely meant as a percentage.
    fn plain_ratio(&mut self, expr: &Expr) {
        let ExprKind::Number(literal) = &expr.kind else {
            return;
        };
        let digits = &literal.digits;
        let message = format!("`{digits}` stands for {} %", literal.value * 100.0);
        let percent = format!("{digits}%");
        self.warning(Code::W0301, expr.span, message)
            .label("a ratio goes from 0 to 1, or from 0% to 100%")
            .fix(
                format!("write `{percent}`"),
                expr.span,
                percent,
                Applicability::Unsafe,
            );
    }

    /// Notes the percentages that a side of a comparison has beside a state on the other one.
    pub fn percent_beside(&mut self, state: &Expr, ty: &Type, value: &'a Expr) {
        if let Some(reference) = plain_ref(state) {
            self.percent_of(&reference.name, ty, value);
        }
    }

    /// Notes the percentages of a value that a state is compared with, or set to, if it is declared as a whole number; and warns of
    /// the plain numbers of it, if the state starts in percent.
    pub fn percent_of(&mut self, name: &Ident, ty: &Type, value: &'a Expr) {
        if *ty != Type::NUMBER || self.context.lookup(&name.name).is_some() {
            return;
        }
        let declared = self.names.value(&name.name, self.context.library);
        let Some((Decl::State(state), false)) = declared else {
            return;
        };
        if is_percentage(&state.value) {
            self.warn_plain_ratio(value, &Type::Ratio);
        }
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

/// The value of a number without a unit.
pub fn plain_number(expr: &Expr) -> Option<f64> {
    match &expr.kind {
        ExprKind::Number(literal) if literal.unit.is_none() => Some(literal.value),
        _ => None,
    }
}

/// The percentages up to 100 % in a value, with how they are written.
fn percents(value: &Expr, found: &mut Vec<(Span, String)>) {
    for (part, _) in parts(value) {
        if let ExprKind::Number(literal) = &part.kind
            && is_percentage(part)
            && literal.value <= 100.0
        {
            found.push((part.span, print::expr(part)));
        }
    }
}

/// Whether this is a number in percent.
fn is_percentage(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(literal) => literal.unit.as_ref().is_some_and(|unit| unit.text == "%"),
        _ => false,
    }
}

/// The parts of an expression that are of its own type: what it adds, chooses among, and gives to functions that pass it on; and
/// whether a plain number above 1 stands beside each in such a function.
fn parts(expr: &Expr) -> Vec<(&Expr, bool)> {
    let mut found = Vec::new();
    add_parts(expr, false, &mut found);
    found
}

fn add_parts<'e>(expr: &'e Expr, beside: bool, found: &mut Vec<(&'e Expr, bool)>) {
    match &expr.kind {
        ExprKind::Paren(inner) => add_parts(inner, beside, found),
        ExprKind::If(choice) => add_choices(choice, found),
        ExprKind::Binary { op, left, right }
            if matches!(op.node, BinaryOp::Add | BinaryOp::Sub) =>
        {
            add_parts(left, false, found);
            add_parts(right, false, found);
        }
        ExprKind::Ref(Ref {
            name,
            args: Some(args),
            ..
        }) if PASSING.contains(&name.name.as_str()) => {
            let values: Vec<&Expr> = args.iter().flat_map(values).collect();
            let beside = values.iter().filter_map(|value| plain_number(value));
            let beside = beside.fold(0.0, f64::max) > 1.0;
            for value in values {
                add_parts(value, beside, found);
            }
        }
        _ => found.push((expr, beside)),
    }
}

fn add_choices<'e>(choice: &'e Choice, found: &mut Vec<(&'e Expr, bool)>) {
    add_parts(&choice.then.value, false, found);
    match &choice.otherwise {
        Otherwise::If(choice, _) => add_choices(choice, found),
        Otherwise::Yield(value) => add_parts(&value.value, false, found),
    }
}

/// The values that an argument without a name gives.
fn values(arg: &Arg) -> Vec<&Expr> {
    match &arg.kind {
        ArgKind::Positional(value) => vec![value],
        ArgKind::Range(low, high) => vec![low, high],
        ArgKind::Named(..) | ArgKind::Binder { .. } => Vec::new(),
    }
}
