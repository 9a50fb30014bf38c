//! Words and marks behind numbers that are no units.

use super::Place;
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::Span;
use crate::spelling::RESERVED;
use crate::syntax::expected;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, Token};
use crate::syntax::words::UNITS;

impl Place<'_> {
    pub(super) fn unit(&self) -> Option<Diagnostic> {
        let after_number = self.before.is_some_and(|token| token.kind == Kind::Number);
        let counts = |token: Token| token.kind == Kind::Number || token.of(self.text) == "/";
        let after_unit = UNITS.contains(&self.before()) && self.second_before.is_some_and(counts);
        let word = self.found();
        if !(after_number || after_unit)
            || self.found.kind != Kind::Word
            || !self.same_line_as_before()
            || RESERVED.contains(&word)
            || matches!(
                word,
                "within" | "with" | "of" | "per" | "to" | "x" | "while"
            )
            || expected::words(&self.failure.expected).contains(&word)
        {
            return None;
        }
        if self.failure.strict == Rule::strict_test_entry && self.line_begins_with("tick") {
            return Some(
                Diagnostic::new(Code::E0101, self.span(), "how long goes behind what holds")
                    .label("a number stands before this")
                    .help(format!("several ticks are `tick {word} for 3 ticks => …`")),
            );
        }
        let links: &[&str] = if self.failure.strict == Rule::strict_learn_entry {
            &["of", "per"]
        } else {
            &[]
        };
        if self.open_paren().is_some() && matches!(self.after_found(), ":" | "=") {
            return Some(comma_before(self.span(), word, self.before));
        }
        if after_unit && expected::words(&[Rule::wrong_unit]).is_empty() && is_unit_word(word) {
            let first = self
                .before
                .map_or(self.span(), |before| self.span_of(before));
            return Some(one_unit(self.text, first, self.span()));
        }
        // `2 m = true`: a unit before `=` is taken for the beginning of the next line.
        let next = self.next().filter(|next| next.of(self.text) == "=");
        if let Some(next) = next.filter(|_| UNITS.contains(&word) && after_number) {
            let span = self.span_of(next);
            return Some(
                Diagnostic::new(
                    Code::E0109,
                    span,
                    "two values are compared with `==`, not with `=`",
                )
                .write(span, "==", Applicability::Unsafe),
            );
        }
        Some(no_such_unit(self.span(), word, links))
    }

    /// `0.0.5`: a second point.
    pub(super) fn second_point(&self) -> Option<Diagnostic> {
        let before = self.before?;
        let is_number = before.kind == Kind::Number && before.of(self.text).contains('.');
        let digits = self.found().strip_prefix('.')?;
        let is_fraction = digits.starts_with(|c: char| c.is_ascii_digit());
        if !is_number || !is_fraction || before.end != self.found.start {
            return None;
        }
        let span = self.span_of(before).to(self.span());
        let message = format!("`{}{}` is not a number", before.of(self.text), self.found());
        Some(Diagnostic::new(Code::E0124, span, message).label("a number has one point"))
    }

    /// `2,000`: digits in groups.
    pub(super) fn grouped_digits(&self) -> Option<Diagnostic> {
        let (first, comma) = (self.second_before?, self.before?);
        let touching = first.end == comma.start && comma.end == self.found.start;
        let is_group = self.found.kind == Kind::Number && self.found().len() == 3;
        if !touching || !is_group || first.kind != Kind::Number || comma.of(self.text) != "," {
            return None;
        }
        let span = self.span_of(first).to(self.span());
        let digits = format!("{}_{}", first.of(self.text), self.found());
        let message = "digits are not grouped by commas";
        Some(Diagnostic::new(Code::E0124, span, message).write(span, digits, Applicability::Safe))
    }
}

/// Whether a word is a unit as other languages spell it.
fn is_unit_word(word: &str) -> bool {
    let plain = word.trim_end_matches('s');
    UNITS.contains(&word)
        || matches!(
            plain,
            "percent"
                | "meter"
                | "metre"
                | "second"
                | "sec"
                | "minute"
                | "hour"
                | "degree"
                | "radian"
        )
}

/// The message for a number with two units, at these places: `m s^-1` is `m/s`, and in `% percent` one is spare.
pub(in crate::syntax) fn one_unit(text: &str, first: Span, second: Span) -> Diagnostic {
    const BELOW: &str = "^-1";
    let slice = |span: Span| text.get(span.range()).unwrap_or_default();
    let (unit, below) = (slice(first), slice(second));
    let diagnostic = Diagnostic::new(Code::E0114, second, "a number has one unit");
    let end = second.range().end;
    if text.get(end..).is_some_and(|rest| rest.starts_with(BELOW)) {
        let whole = Span::new(first.file, first.range().start, end + BELOW.len());
        let right = format!("{unit}/{below}");
        let title = format!("write `{right}`");
        return diagnostic.label("a unit is divided by `/`").fix(
            title,
            whole,
            right,
            Applicability::Unsafe,
        );
    }
    let spare = Span::new(first.file, first.range().end, end);
    diagnostic.label(format!("`{unit}` says it already")).fix(
        format!("drop `{below}`"),
        spare,
        "",
        Applicability::Unsafe,
    )
}

/// The message for a comma that is missing before a word of arguments.
fn comma_before(span: Span, word: &str, before: Option<Token>) -> Diagnostic {
    let at = before.map_or(span.before(), |before| Span {
        start: u32::try_from(before.end).unwrap_or(span.start),
        end: u32::try_from(before.end).unwrap_or(span.start),
        ..span
    });
    Diagnostic::new(
        Code::E0112,
        span,
        format!("a comma is missing before `{word}`"),
    )
    .label("this begins another one")
    .fix("put a comma", at, ",", Applicability::Safe)
}

/// What is said of a unit behind a point, such as `(5, 2) m`.
pub(in crate::syntax) fn unit_of_a_point(span: Span, point: &str, unit: &str) -> Diagnostic {
    let inner = point.trim_start_matches('(').trim_end_matches(')');
    let is_number = |part: &str| part.trim().parse::<f64>().is_ok();
    let (x, y) = inner
        .split_once(',')
        .filter(|(x, y)| is_number(x) && is_number(y))
        .map_or(("1", "2"), |(x, y)| (x.trim(), y.trim()));
    Diagnostic::new(Code::E0114, span, "a unit follows a number")
        .label("this follows a point")
        .help(format!(
            "each number has its own: `({x} {unit}, {y} {unit})`"
        ))
}

/// `min30s`, which follows a number, with what adds its two amounts.
fn parted_time(word: &str) -> Option<String> {
    let digits = word.find(|c: char| c.is_ascii_digit())?;
    let (first, rest) = word.split_at_checked(digits)?;
    let letters = rest.find(|c: char| !c.is_ascii_digit())?;
    let (number, second) = rest.split_at_checked(letters)?;
    let known = UNITS.contains(&first) && UNITS.contains(&second);
    known.then(|| format!("{first} + {number} {second}"))
}

/// The units, as advice.
pub(in crate::syntax) fn units_note() -> String {
    format!(
        "the units are {}",
        UNITS.map(|unit| format!("`{unit}`")).join(", ")
    )
}

/// The message for a word that follows a number and is not a unit; `others` may follow a number too.
pub(in crate::syntax) fn no_such_unit(span: Span, word: &str, others: &[&str]) -> Diagnostic {
    if matches!(word, "then" | "do") {
        return Diagnostic::new(
            Code::E0101,
            span,
            format!("a block follows without `{word}`"),
        )
        .label("not said here")
        .fix(format!("drop `{word}`"), span, "", Applicability::Unsafe)
        .help("its form is `if CONDITION { … }`");
    }
    let diagnostic = Diagnostic::new(Code::E0114, span, format!("`{word}` is not a unit"));
    let units = UNITS.into_iter().filter(|unit| unit.len() > 1);
    let foreign = match word {
        "step" | "steps" | "frame" | "frames" | "iterations" => Some("ticks"),
        "secs" | "second" | "seconds" => Some("s"),
        "millis" | "msecs" => Some("ms"),
        "kmh" | "kph" | "kmph" => Some("km/h"),
        "mps" => Some("m/s"),
        "dps" => Some("deg/s"),
        _ => None,
    };
    if matches!(
        word,
        "kg" | "g" | "N" | "Nm" | "V" | "A" | "W" | "J" | "lb" | "lbs" | "mAh" | "Wh"
    ) {
        return diagnostic
            .label("this follows a number")
            .help("there are lengths, times and angles, and what is made of them: no masses, no forces, no currents")
            .note(units_note());
    }
    if matches!(word, "k" | "K") {
        return diagnostic
            .label("this follows a number")
            .help("thousands are written out: 1k is `1_000`");
    }
    if matches!(word, "rpm" | "RPM" | "rps") {
        let turns = if word == "rps" {
            "1 rps is `360 deg/s`"
        } else {
            "1 rpm is `6 deg/s`"
        };
        return diagnostic
            .label("this follows a number")
            .help(turns)
            .note(units_note());
    }
    if let Some(right) = parted_time(word) {
        return diagnostic.label("two amounts are added").fix(
            format!("write `{right}`"),
            span,
            right,
            Applicability::Unsafe,
        );
    }
    let near = foreign
        .or_else(|| suggest::nearest(word, units.chain(others.iter().copied())))
        .or_else(|| {
            UNITS
                .into_iter()
                .find(|unit| unit.eq_ignore_ascii_case(word))
        });
    let diagnostic = match near {
        Some(near) => diagnostic.label(format!("did you mean `{near}`?")).fix(
            format!("write `{near}`"),
            span,
            near,
            Applicability::Unsafe,
        ),
        None => diagnostic
            .label("this follows a number")
            .help("a plain number stands without a unit"),
    };
    diagnostic.note(units_note())
}
