//! Characters and quotation marks that the language does not know, or does not allow here.

use super::Place;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::{FileId, Span};
use crate::spelling::RESERVED;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, Token, is_blank};

/// Characters that look like those of the language, and the ones that they look like.
const LOOK_ALIKES: [(char, &str); 34] = [
    ('–', "-"),
    ('—', "-"),
    ('−', "-"),
    ('“', "\""),
    ('”', "\""),
    ('„', "\""),
    ('‘', "`"),
    ('’', "`"),
    ('´', "`"),
    ('→', "->"),
    ('⇒', "=>"),
    ('≤', "<="),
    ('≥', ">="),
    ('≠', "!="),
    ('×', "*"),
    ('÷', "/"),
    ('，', ","),
    ('；', ";"),
    ('：', ":"),
    ('（', "("),
    ('）', ")"),
    ('｛', "{"),
    ('｝', "}"),
    ('＝', "="),
    ('…', ".."),
    ('·', "*"),
    ('⋅', "*"),
    ('∗', "*"),
    ('\u{A0}', " "),
    ('\u{202F}', " "),
    ('∧', "and"),
    ('∨', "or"),
    ('¬', "not"),
    ('∈', "in"),
];

impl Place<'_> {
    pub(super) fn look_alike(&self) -> Option<Diagnostic> {
        if let Some(diagnostic) = self.single_quotes() {
            return Some(diagnostic);
        }
        let letter = self.found().chars().next()?;
        let (_, right) = LOOK_ALIKES.iter().find(|(look, _)| *look == letter)?;
        let span = Span::new(
            self.file,
            self.found.start,
            self.found.start + letter.len_utf8(),
        );
        let (shown, meant) = match *right {
            " " => ("a non-breaking blank".to_owned(), "a blank".to_owned()),
            right => (format!("`{letter}`"), format!("`{right}`")),
        };
        let is_word = right.starts_with(char::is_alphabetic);
        let message = format!("{shown} stands where {meant} should");
        let diagnostic =
            Diagnostic::new(Code::E0121, span, message).label(format!("write {meant}"));
        let (diagnostic, written) = match is_word {
            false => (
                diagnostic.note("editors for prose put such characters in"),
                (*right).to_owned(),
            ),
            true => (
                diagnostic.note("operators are written with the characters of a keyboard"),
                self.set_apart(span, right),
            ),
        };
        let title = format!("write {meant}");
        Some(diagnostic.fix(title, span, written, Applicability::Safe))
    }

    /// A word in place of a mark, with blanks where it touches what stands around it.
    fn set_apart(&self, mark: Span, word: &str) -> String {
        let before = self.text.get(..mark.range().start).unwrap_or_default();
        let after = self.text.get(mark.range().end..).unwrap_or_default();
        let touches = |letter: Option<char>| {
            letter
                .is_some_and(|letter| letter.is_alphanumeric() || matches!(letter, '_' | '%' | '`'))
        };
        let left = if touches(before.chars().next_back()) {
            " "
        } else {
            ""
        };
        let right = if touches(after.chars().next()) {
            " "
        } else {
            ""
        };
        format!("{left}{word}{right}")
    }

    /// `'low'`: a text in the quotation marks of other languages.
    fn single_quotes(&self) -> Option<Diagnostic> {
        let wanted = self.expects(Rule::string) || self.expects(Rule::title);
        let rest = self.text.get(self.found.start..)?.strip_prefix('\'')?;
        let inner = rest.lines().next()?.split_once('\'')?.0;
        let span = Span::new(
            self.file,
            self.found.start,
            self.found.start + inner.len() + 2,
        );
        let right = format!("\"{inner}\"");
        let message = "`'` stands where `\"` should".to_owned();
        wanted.then(|| {
            Diagnostic::new(Code::E0121, span, message).write(span, right, Applicability::Safe)
        })
    }

    pub(super) fn unclosed(&self) -> Option<Diagnostic> {
        let quote = self.found().chars().next()?;
        let closed = self.found().len() > 1 && self.found().ends_with(quote);
        if closed || !matches!(quote, '`' | '"') {
            return None;
        }
        let start = self.found.start;
        Some(unclosed_quote(self.file, start, quote))
    }

    pub(super) fn text(&self) -> Option<Diagnostic> {
        if self.found.kind != Kind::Text || self.expects(Rule::string) {
            return None;
        }
        let inner = self.found().trim_matches('"');
        let mut diagnostic = Diagnostic::new(Code::E0107, self.span(), "no text can stand here")
            .label("quotation marks are for paths");
        if self.expects(Rule::name) && !inner.is_empty() && !inner.contains('`') {
            let name = format!("`{inner}`");
            diagnostic = diagnostic.fix(
                "write a name in backquotes",
                self.span(),
                name,
                Applicability::Safe,
            );
        }
        Some(diagnostic)
    }

    /// `a mod b`, as some languages write a remainder.
    fn modulo_word(&self) -> Option<Diagnostic> {
        let is_word = |token: &Token| matches!(token.of(self.text), "mod" | "rem" | "modulo");
        let value = |token: Token| {
            matches!(token.kind, Kind::Word | Kind::Number | Kind::Name)
                || token.of(self.text) == "("
        };
        let (word, left, right) = match is_word(&self.found) {
            true => (self.found, self.before?, self.next()?),
            false => (
                self.before.filter(is_word)?,
                self.second_before?,
                self.found,
            ),
        };
        let line = self.text.get(left.end..right.start)?;
        let ends_value = value(left) || left.of(self.text) == ")";
        (ends_value && value(right) && !line.contains('\n'))
            .then(|| no_remainder(self.span_of(word), word.of(self.text)))
    }

    pub(super) fn modulo(&self) -> Option<Diagnostic> {
        if let Some(told) = self.modulo_word() {
            return Some(told);
        }
        let percent = if self.found() == "%" {
            self.found
        } else {
            self.before.filter(|before| before.of(self.text) == "%")?
        };
        let starts_value = matches!(self.found.kind, Kind::Word | Kind::Number | Kind::Name)
            && !RESERVED.contains(&self.found());
        if percent.start != self.found.start && !(starts_value && self.same_line_as_before()) {
            return None;
        }
        let left = self.text.get(..percent.start).unwrap_or_default();
        if percent.start != self.found.start && !left.ends_with(is_blank) {
            return None;
        }
        let span = Span::new(self.file, percent.start, percent.end);
        Some(
            Diagnostic::new(Code::E0125, span, "`%` is a unit, never a remainder")
                .label("it belongs after a number: `25%`")
                .help("the language has no remainder"),
        )
    }
}

/// The message for `word`, which stands for a remainder elsewhere.
pub(in crate::syntax) fn no_remainder(word: Span, name: &str) -> Diagnostic {
    Diagnostic::new(Code::E0125, word, format!("`{name}` is no operator"))
        .label("the language has no remainder")
        .help("what comes round: `if x >= N { x - N } else { x }`, or `x - N * floor(x / N)`")
}

/// The message for the quote at byte `start`, which is not closed on its line.
pub(in crate::syntax) fn unclosed_quote(file: FileId, start: usize, quote: char) -> Diagnostic {
    let place = Span::new(file, start, start + quote.len_utf8());
    let name = if quote == '`' {
        "backquote"
    } else {
        "quotation mark"
    };
    let message = format!("this {name} is not closed on its line");
    Diagnostic::new(Code::E0106, place, message)
        .label("no second one follows")
        .note("names and texts do not go over the end of a line")
}
