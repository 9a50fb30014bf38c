//! Numbers, units and signs that stand in pieces or where none belongs.

use super::Place;
use super::units::unit_of_a_point;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, Token};
use crate::syntax::words::UNITS;

/// What begins a line that gives a name its value.
const DEFINED: [&str; 8] = [
    "arena ",
    "event ",
    "let ",
    "place ",
    "predicate ",
    "state ",
    "tick ",
    "tree ",
];

impl Place<'_> {
    /// A number or a sign in two pieces, a unit behind no number, a value behind `return`.
    pub(super) fn in_pieces(&self) -> Option<Diagnostic> {
        self.decimal_comma()
            .or_else(|| self.decimal_commas_in_a_point())
            .or_else(|| self.torn_sign())
            .or_else(|| self.asked_for_truth())
            .or_else(|| self.mixed_units())
            .or_else(|| self.unit_of_a_call())
            .or_else(|| self.returned())
    }

    /// `1,5 m`: a decimal comma.
    fn decimal_comma(&self) -> Option<Diagnostic> {
        let (first, comma) = (self.second_before?, self.before?);
        let touching = first.end == comma.start && comma.end == self.found.start;
        let digits = self.is_digits(first) && self.is_digits(self.found);
        if !touching || !digits || comma.of(self.text) != "," {
            return None;
        }
        if self.found().len() == 3 {
            return None;
        }
        let span = self.span_of(first).to(self.span());
        let right = format!("{}.{}", first.of(self.text), self.found());
        self.told(span, "a decimal fraction has a point", right)
    }

    /// Whether a token is a number of digits alone.
    fn is_digits(&self, token: Token) -> bool {
        token.kind == Kind::Number && token.of(self.text).bytes().all(|it| it.is_ascii_digit())
    }

    /// `(2,5 m, 1 m)`: decimal commas in a point, which has too many coordinates by them.
    fn decimal_commas_in_a_point(&self) -> Option<Diagnostic> {
        if self.found() != "," || !self.is_third_coordinate() {
            return None;
        }
        let has = |token: &Token, text: &str| token.of(self.text) == text;
        let open = self.open()?;
        let from = self.tokens.partition_point(|it| it.end <= open.end);
        let inner = self.tokens.get(from..)?;
        let point = inner.get(..inner.iter().position(|it| has(it, ")"))?)?;
        let torn = |three: &[Token]| match three {
            [first, comma, last] => {
                let touch = first.end == comma.start && comma.end == last.start;
                let digits = self.is_digits(*first) && self.is_digits(*last);
                (touch && has(comma, ",") && digits).then_some((*first, *comma, *last))
            }
            _ => None,
        };
        let torn: Vec<(Token, Token, Token)> = point.windows(3).filter_map(torn).collect();
        let ((first, ..), (.., last)) = (torn.first()?, torn.last()?);
        let mut right = self.text.get(first.start..last.end)?.to_owned();
        for (_, comma, _) in &torn {
            let comma = comma.start - first.start;
            right.replace_range(comma..=comma, ".");
        }
        let span = self.span_of(*first).to(self.span_of(*last));
        self.told(span, "a decimal fraction has a point", right)
    }

    /// `< =`, `= >`: a sign in two pieces.
    fn torn_sign(&self) -> Option<Diagnostic> {
        if let (true, Some(next)) = (self.expects(Rule::guards), self.next())
            && (self.found(), next.of(self.text)) == ("=", ">")
            && !self.parted(self.found, next)
        {
            let span = self.span().to(self.span_of(next));
            return self.told(span, "`=>` is one sign", "=>");
        }
        let before = self.before.filter(|_| self.same_line_as_before())?;
        let sign = match (before.of(self.text), self.found()) {
            ("<", "=") => "<=",
            (">", "=") => ">=",
            ("=", "=") => "==",
            ("!", "=") => "!=",
            ("=", ">") => "=>",
            _ => return None,
        };
        let span = self.span_of(before).to(self.span());
        if sign == "==" && self.defines(before) {
            return self.told(span, "a value is given with one `=`", "=");
        }
        self.told(span, format!("`{sign}` is one sign"), sign)
    }

    /// Whether a `=` is the first of its line, which gives a name its value.
    fn defines(&self, sign: Token) -> bool {
        let before = self.text.get(..sign.start).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default();
        let begins = |word: &&str| line.trim_start().starts_with(*word);
        DEFINED.iter().any(begins) && !line.contains('=')
    }

    /// `low = true`: a guard is true or false by itself.
    fn asked_for_truth(&self) -> Option<Diagnostic> {
        let value = self.next()?;
        let asks = self.expects(Rule::guards) && matches!(self.found(), "=" | "==");
        let is = match value.of(self.text) {
            "true" if asks => true,
            "false" if asks => false,
            _ => return None,
        };
        let span = self.span().to(self.span_of(value));
        let message = format!("`{}` is not asked for here", value.of(self.text));
        let diagnostic = Diagnostic::new(Code::E0101, span, message)
            .label("a predicate is true or false by itself");
        Some(match is {
            true => diagnostic.fix("leave this out", span, "", Applicability::Unsafe),
            false => diagnostic.help(format!("where it is not: `not {}`", self.before())),
        })
    }

    /// `20 s 500 ms`: a quantity of two units.
    fn mixed_units(&self) -> Option<Diagnostic> {
        let (number, unit) = (self.second_before?, self.before?);
        let quantity = number.kind == Kind::Number && UNITS.contains(&unit.of(self.text));
        let next = self.next()?;
        let another = self.found.kind == Kind::Number && UNITS.contains(&next.of(self.text));
        if !quantity || !another || !self.same_line_as_before() || self.parted(number, unit) {
            return None;
        }
        let span = self.span_of(number).to(self.span_of(next));
        let first = self.text.get(number.start..unit.end)?;
        let second = self.text.get(self.found.start..next.end)?;
        if self.is_point(number.start, next.end) {
            return Some(
                Diagnostic::new(Code::E0101, span, "a comma stands between two coordinates")
                    .label("a point begins here")
                    .fix(
                        "put a `,`",
                        self.span_of(unit).after(),
                        ",",
                        Applicability::Unsafe,
                    ),
            );
        }
        self.told(
            span,
            "a quantity has one unit",
            format!("({first} + {second})"),
        )
    }

    /// Whether what stands between two places is all that stands in parentheses that belong to no call.
    fn is_point(&self, start: usize, end: usize) -> bool {
        let before = self.text.get(..start).unwrap_or_default().trim_end();
        let after = self.text.get(end..).unwrap_or_default().trim_start();
        let named = |c: char| c.is_alphanumeric() || matches!(c, '_' | '`');
        let opens = before.strip_suffix('(');
        opens.is_some_and(|before| !before.ends_with(named)) && after.starts_with(')')
    }

    /// `uniform(-90, 90) deg`: a unit behind what is no number.
    fn unit_of_a_call(&self) -> Option<Diagnostic> {
        let unit = UNITS.contains(&self.found()) && self.found() != "%";
        if !unit || self.before() != ")" || !self.same_line_as_before() {
            return None;
        }
        let close = self.before?.start;
        let open = self.text.get(..close)?.rfind('(')?;
        if self.is_point(open + 1, close) {
            let point = self.text.get(open..=close)?;
            return Some(unit_of_a_point(self.span(), point, self.found()));
        }
        let message = "a unit follows a number";
        Some(
            Diagnostic::new(Code::E0114, self.span(), message)
                .label("this follows a call")
                .help(format!(
                    "each number has its own: `uniform(1 {0}, 2 {0})`",
                    self.found()
                )),
        )
    }

    /// `return x`: the value alone is what is said.
    fn returned(&self) -> Option<Diagnostic> {
        let word = self.before.filter(|word| word.of(self.text) == "return")?;
        let value = matches!(self.found.kind, Kind::Word | Kind::Number | Kind::Name)
            || matches!(self.found(), "(" | "-");
        if !value || !self.same_line_as_before() {
            return None;
        }
        let span = Span::new(self.file, word.start, self.found.start);
        Some(
            Diagnostic::new(Code::E0101, self.span_of(word), "nothing is returned")
                .label("the value itself is what is said")
                .fix("drop `return`", span, "", Applicability::Safe),
        )
    }
}
