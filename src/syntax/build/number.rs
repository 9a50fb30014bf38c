//! Numbers with their units.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Expr, ExprKind, Literal, Unit, UnitFactor};
use crate::syntax::diagnose::units_note;
use crate::syntax::grammar::{Node, Parts, Rule};
use crate::syntax::words::UNITS;

/// What other units are called here.
const FOREIGN_UNITS: [(&str, &str); 13] = [
    ("millim", "mm"),
    ("centim", "cm"),
    ("kilom", "km"),
    ("met", "m"),
    ("millis", "ms"),
    ("msec", "ms"),
    ("sec", "s"),
    ("min", "min"),
    ("h", "h"),
    ("deg", "deg"),
    ("rad", "rad"),
    ("per", "%"),
    ("°", "deg"),
];

/// What an inherited unit is in metric ones.
const INHERITED: [(&str, &str); 4] = [
    ("f", "1 foot is 30.48 cm"),
    ("in", "1 inch is 25.4 mm"),
    ("yard", "1 yard is 91.44 cm"),
    ("mile", "1 mile is 1.609344 km"),
];

impl<'i> Builder<'i> {
    pub(super) fn quantity(&mut self, node: Node<'i>) -> Expr {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let digits = parts
            .maybe(Rule::number)
            .map(|node| (self.span(&node), node.as_str()));
        let Some((place, digits)) = digits else {
            return self.error_expr(span);
        };
        let value = self.number(place, digits);
        let unit = match parts.next() {
            Some(unit) if unit.as_rule() == Rule::wrong_unit => {
                let span = self.span(&unit);
                self.wrong_unit(span);
                return self.error_expr(place.to(span));
            }
            Some(unit) => Some(unit_of(unit.as_str(), self.span(&unit))),
            None => None,
        };
        let Some(value) = value else {
            return self.error_expr(span);
        };
        let literal = Literal {
            digits: digits.to_owned(),
            value,
            unit,
        };
        Expr {
            kind: ExprKind::Number(literal),
            span,
        }
    }

    /// `1 s` before a `=` that should be a `:`.
    pub(super) fn price_time(&mut self, node: Node<'i>) -> Expr {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let Some(number) = parts.maybe(Rule::number) else {
            return self.error_expr(span);
        };
        let value = self.number(self.span(&number), number.as_str());
        let unit = parts.maybe(Rule::paid_unit);
        match (value, unit) {
            (Some(value), Some(unit)) => Expr {
                kind: ExprKind::Number(Literal {
                    digits: number.as_str().to_owned(),
                    value,
                    unit: Some(unit_of(unit.as_str(), self.span(&unit))),
                }),
                span,
            },
            _ => self.error_expr(span),
        }
    }

    /// The value of a number, if it is written as the language writes numbers.
    fn number(&mut self, span: Span, digits: &str) -> Option<f64> {
        let plain: String = digits.chars().filter(|&letter| letter != '_').collect();
        let value = plain.parse::<f64>().ok().filter(|value| value.is_finite());
        if let Some(value) = value.filter(|_| is_well_written(digits)) {
            return Some(value);
        }
        let mut diagnostic =
            Diagnostic::new(Code::E0124, span, format!("`{digits}` is not a number"));
        if is_well_written(digits) {
            diagnostic = diagnostic.label("larger than any number that can be held");
        } else if let Some(hexadecimal) = digits
            .strip_prefix("0x")
            .or_else(|| digits.strip_prefix("0X"))
        {
            diagnostic = diagnostic.label("numbers are decimal");
            if let Ok(value) = u64::from_str_radix(hexadecimal, 16) {
                diagnostic = diagnostic.fix(
                    "write it in decimal",
                    span,
                    value.to_string(),
                    Applicability::Safe,
                );
            }
        } else {
            let right = well_written(digits);
            diagnostic = diagnostic
                .label("digits stand on both sides of a point and of each `_`")
                .fix(format!("write `{right}`"), span, right, Applicability::Safe);
        }
        self.report(diagnostic);
        None
    }

    fn wrong_unit(&mut self, span: Span) {
        let written = self.slice(span);
        let mut right = String::new();
        let mut note = None;
        for (index, factor) in written.split('/').enumerate() {
            let (name, power) = factor.split_once('^').unwrap_or((factor, ""));
            if index > 0 {
                right.push('/');
            }
            let lower = name.to_ascii_lowercase();
            if UNITS.contains(&name) {
                right.push_str(name);
            } else if lower == "hz" || lower == "hertz" {
                right.push_str("Hz");
            } else if let Some((_, fact)) =
                INHERITED.iter().find(|(start, _)| lower.starts_with(start))
            {
                note = Some(*fact);
            } else if let Some((_, unit)) = FOREIGN_UNITS
                .iter()
                .find(|(start, _)| lower.starts_with(start))
            {
                right.push_str(unit);
            }
            if !power.is_empty() {
                right.push('^');
                right.push_str(power);
            }
        }
        let mut diagnostic =
            Diagnostic::new(Code::E0114, span, format!("`{written}` is not a unit"));
        diagnostic = match note {
            Some(fact) => diagnostic.label("not a unit here").note(fact),
            None => diagnostic.write(span, right, Applicability::Safe),
        };
        self.report(diagnostic.note(units_note()));
    }

    /// `6 m / s`, where `s` is not a name in this file: a unit with blanks inside.
    pub(super) fn blank_in_unit(&mut self, left: &Expr, right: &Expr, span: Span) -> Option<Expr> {
        let ExprKind::Number(literal) = &left.kind else {
            return None;
        };
        let ExprKind::Ref(divisor) = &right.kind else {
            return None;
        };
        let name = divisor.name.name.as_str();
        let is_unit = UNITS.contains(&name) && !matches!(name, "tick" | "ticks" | "min");
        if divisor.args.is_some()
            || !is_unit
            || self.slice(right.span).starts_with('`')
            || self.glance().declares(name)
        {
            return None;
        }
        let Some(unit) = &literal.unit else {
            let digits = &literal.digits;
            let diagnostic = Diagnostic::new(
                Code::E0114,
                right.span,
                format!("`/{name}` is not a unit of its own"),
            )
            .label("per what?")
            .help(rates(digits));
            self.report(diagnostic);
            return Some(self.error_expr(span));
        };
        let merged = format!("{}/{name}", unit.text);
        let place = unit.span.to(right.span);
        let diagnostic = Diagnostic::new(Code::E0115, place, "a unit has no blanks inside")
            .label(format!("write `{merged}`"))
            .note(format!(
                "with blanks this divides by something named `{name}`, and nothing here is"
            ))
            .fix(
                format!("write `{merged}`"),
                place,
                merged.clone(),
                Applicability::Safe,
            );
        self.report(diagnostic);
        Some(Expr {
            kind: ExprKind::Number(Literal {
                unit: Some(unit_of(&merged, place)),
                ..literal.clone()
            }),
            span,
        })
    }
}

/// The unit in a text that is not of a program, such as `m/s`; `None` if it cannot be one.
pub fn unit(text: &str) -> Option<Unit> {
    let is_factor = |factor: &str| {
        let (name, power) = factor.split_once('^').unwrap_or((factor, "1"));
        let small = matches!(power.as_bytes(), [b'1'..=b'9']);
        small && (name == "%" || !name.is_empty() && name.chars().all(|c| c.is_ascii_alphabetic()))
    };
    let whole = text.split('/').all(is_factor);
    whole.then(|| unit_of(text, Span::default()))
}

/// The unit that the grammar has taken.
fn unit_of(text: &str, span: Span) -> Unit {
    let factors = text
        .split('/')
        .enumerate()
        .map(|(index, factor)| {
            let (name, power) = factor.split_once('^').unwrap_or((factor, "1"));
            let power = power.parse::<i32>().unwrap_or(i32::MAX);
            UnitFactor {
                name: name.to_owned(),
                power: if index == 0 { power } else { -power },
            }
        })
        .collect();
    Unit {
        text: text.to_owned(),
        factors,
        span,
    }
}

/// `digits { "_" digits } [ "." digits ] [ exponent ]`
fn is_well_written(digits: &str) -> bool {
    let is_run = |run: &str| !run.is_empty() && run.chars().all(|letter| letter.is_ascii_digit());
    let (mantissa, exponent) = match digits.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (digits, None),
    };
    let (whole, fraction) = match mantissa.split_once('.') {
        Some((whole, fraction)) => (whole, Some(fraction)),
        None => (mantissa, None),
    };
    whole.split('_').all(is_run)
        && fraction.is_none_or(is_run)
        && exponent
            .is_none_or(|exponent| is_run(exponent.strip_prefix(['-', '+']).unwrap_or(exponent)))
}

/// The number that a badly written one says.
fn well_written(digits: &str) -> String {
    let (mantissa, exponent) = match digits.find(['e', 'E']) {
        Some(at) => digits.split_at(at),
        None => (digits, ""),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let runs: Vec<&str> = whole.split('_').filter(|run| !run.is_empty()).collect();
    let whole = if runs.is_empty() {
        "0".to_owned()
    } else {
        runs.join("_")
    };
    let fraction: String = fraction.chars().filter(|&letter| letter != '_').collect();
    let point = if fraction.is_empty() { "" } else { "." };
    format!("{whole}{point}{fraction}{exponent}")
}

/// How rates of a number are written.
pub(super) fn rates(digits: &str) -> String {
    format!("a frequency is `{digits} Hz`, a turn rate `{digits} rad/s`, a speed `{digits} m/s`")
}
