//! Why a text does not parse.

use super::brackets::{innermost_open, unclosed};
use super::build::units_note;
use super::expected;
use super::grammar::Rule;
use super::tokens::{Kind, Token, is_blank};
use super::words::{ITEMS, UNITS};
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::{FileId, Span};
use crate::spelling::RESERVED;

/// A text that does not parse.
pub(super) struct Failure {
    /// Where the text begins.
    pub(super) start: usize,
    /// Where nothing fitted.
    pub(super) at: usize,
    /// What could have stood there.
    pub(super) expected: Vec<Rule>,
    /// What the text was to be.
    pub(super) strict: Rule,
}

/// Characters that look like those of the language, and the ones that they look like.
const LOOK_ALIKES: [(char, &str); 20] = [
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
    ('\u{A0}', " "),
];

/// The message for a text that does not parse, and the byte up to which it speaks for what is wrong.
pub(super) fn failure(
    file: FileId,
    text: &str,
    tokens: &[Token],
    failure: &Failure,
) -> (usize, Diagnostic) {
    let index = tokens.partition_point(|token| token.end <= failure.at);
    let mut after = tokens.get(index..).unwrap_or_default().iter().copied();
    let mut before = tokens
        .get(..index)
        .unwrap_or_default()
        .iter()
        .rev()
        .copied();
    let is_code = |token: &Token| token.kind != Kind::Comment;
    let found = after.find(is_code);
    let before = [before.find(is_code), before.find(is_code)];
    let Some(found) = found else {
        return (
            failure.at,
            at_the_end(file, text, tokens, failure, before[0]),
        );
    };
    let place = Place {
        file,
        text,
        failure,
        found,
        before: before[0],
        second_before: before[1],
    };
    if let Some((token, diagnostic)) = place.dangling(tokens) {
        return (token.end, diagnostic);
    }
    let diagnostic = place
        .look_alike()
        .or_else(|| place.unclosed())
        .or_else(|| place.text())
        .or_else(|| place.unit())
        .or_else(|| place.modulo())
        .or_else(|| place.reserved())
        .or_else(|| place.first_word())
        .unwrap_or_else(|| place.unexpected(tokens));
    (failure.at, diagnostic)
}

fn at_the_end(
    file: FileId,
    text: &str,
    tokens: &[Token],
    failure: &Failure,
    before: Option<Token>,
) -> Diagnostic {
    let open = innermost_open(text, tokens, failure.start, text.len());
    if let Some(open) = open {
        return unclosed(
            file,
            text,
            tokens,
            Span::new(file, open.start, open.end),
            text.len(),
        );
    }
    let end = before.map_or(text.len(), |token| token.end);
    let place = Span::new(file, end, end);
    match expected::listed(&failure.expected) {
        Some(wanted) => Diagnostic::new(
            Code::E0101,
            place,
            format!("expected {wanted}, found the end of the file"),
        )
        .label(format!("expected {wanted}")),
        None => Diagnostic::new(Code::E0101, place, "the file ends too early"),
    }
}

/// A token that does not fit, with what stands around it.
struct Place<'a> {
    file: FileId,
    text: &'a str,
    failure: &'a Failure,
    found: Token,
    before: Option<Token>,
    second_before: Option<Token>,
}

impl Place<'_> {
    fn span(&self) -> Span {
        Span::new(self.file, self.found.start, self.found.end)
    }

    fn found(&self) -> &str {
        self.found.of(self.text)
    }

    fn before(&self) -> &str {
        self.before.map_or("", |token| token.of(self.text))
    }

    fn expects(&self, rule: Rule) -> bool {
        self.failure.expected.contains(&rule)
    }

    fn same_line_as_before(&self) -> bool {
        self.before
            .and_then(|before| self.text.get(before.end..self.found.start))
            .is_some_and(|gap| !gap.contains('\n'))
    }

    fn parted(&self, left: Token, right: Token) -> bool {
        let gap = self.text.get(left.end..right.start).unwrap_or_default();
        gap.contains('\n')
    }

    /// A line that ends too early: the message belongs to its end, not to what happens to stand on the next one.
    fn dangling(&self, tokens: &[Token]) -> Option<(Token, Diagnostic)> {
        let before = self.before?;
        if before.end > self.failure.start && self.parted(before, self.found) {
            let open = innermost_open(self.text, tokens, self.failure.start, self.found.start);
            if let Some(open) =
                open.filter(|open| open.of(self.text) == "(" && self.expects(Rule::close_paren))
            {
                let place = Span::new(self.file, open.start, open.end);
                return Some((
                    before,
                    unclosed(self.file, self.text, tokens, place, self.found.start),
                ));
            }
            let wanted = expected::listed(&self.failure.expected)?;
            return Some((before, self.after(before, &wanted)));
        }
        let last = self.second_before?;
        let ends_open = matches!(
            last.of(self.text),
            "=" | "+"
                | "-"
                | "*"
                | "/"
                | "^"
                | "->"
                | "=>"
                | "=="
                | "!="
                | "<"
                | ">"
                | "<="
                | ">="
                | "and"
                | "or"
                | "not"
        );
        let begins_entry = matches!(self.found(), "=" | ":") && before.kind == Kind::Word;
        (ends_open && begins_entry && self.parted(last, before))
            .then(|| (last, self.after(last, "a value")))
    }

    fn after(&self, token: Token, wanted: &str) -> Diagnostic {
        let span = Span::new(self.file, token.start, token.end);
        let message = format!(
            "expected {wanted} after `{}`, found the end of the line",
            token.of(self.text)
        );
        Diagnostic::new(Code::E0101, span, message).label(format!("expected {wanted} after this"))
    }

    fn look_alike(&self) -> Option<Diagnostic> {
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
        Some(
            Diagnostic::new(
                Code::E0121,
                span,
                format!("{shown} stands where {meant} should"),
            )
            .label(format!("write {meant}"))
            .note("editors for prose put such characters in")
            .fix(format!("write {meant}"), span, *right, Applicability::Safe),
        )
    }

    fn unclosed(&self) -> Option<Diagnostic> {
        let quote = self
            .found()
            .chars()
            .next()
            .filter(|quote| matches!(quote, '`' | '"'))?;
        let closed = self.found().len() > 1 && self.found().ends_with(quote);
        if closed {
            return None;
        }
        let span = Span::new(self.file, self.found.start, self.found.start + 1);
        Some(
            Diagnostic::new(
                Code::E0106,
                span,
                format!("this {} is not closed on its line", quote_name(quote)),
            )
            .label("no second one follows")
            .note("names and texts do not go over the end of a line"),
        )
    }

    fn text(&self) -> Option<Diagnostic> {
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

    fn unit(&self) -> Option<Diagnostic> {
        let after_number = self.before.is_some_and(|token| token.kind == Kind::Number);
        let after_unit = UNITS.contains(&self.before());
        let word = self.found();
        if !(after_number || after_unit)
            || self.found.kind != Kind::Word
            || !self.same_line_as_before()
            || RESERVED.contains(&word)
            || expected::words(&self.failure.expected).contains(&word)
        {
            return None;
        }
        let links: &[&str] = if self.failure.strict == Rule::strict_learn_entry {
            &["of", "per"]
        } else {
            &[]
        };
        Some(no_such_unit(self.span(), word, links))
    }

    fn modulo(&self) -> Option<Diagnostic> {
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

    fn reserved(&self) -> Option<Diagnostic> {
        let word = self.found();
        if !RESERVED.contains(&word) || !self.expects(Rule::name) {
            return None;
        }
        if self.failure.at == self.failure.start && self.failure.strict == Rule::strict_item {
            return None;
        }
        Some(
            Diagnostic::new(
                Code::E0122,
                self.span(),
                format!("`{word}` is a word of the language, not a name"),
            )
            .label("a name was expected")
            .help("choose another name, or put it in backquotes")
            .fix(
                "put it in backquotes",
                self.span(),
                format!("`{word}`"),
                Applicability::Unsafe,
            ),
        )
    }

    /// A word that should begin an item, a clause or an aspect, and does not.
    fn first_word(&self) -> Option<Diagnostic> {
        if self.failure.at != self.failure.start || self.found.kind != Kind::Word {
            return None;
        }
        let word = self.found();
        let at_item = self.failure.strict == Rule::strict_item;
        let mut candidates = if at_item {
            ITEMS.to_vec()
        } else {
            expected::words(&self.failure.expected)
        };
        candidates.sort_unstable();
        candidates.dedup();
        if candidates.is_empty() || candidates.contains(&word) {
            return None;
        }
        let (code, begins) = match self.failure.strict {
            Rule::strict_item => (Code::E0105, "an item"),
            Rule::strict_clause => (Code::E0123, "a clause of a behaviour"),
            Rule::strict_aspect => (Code::E0123, "an aspect of a task"),
            Rule::strict_reward => (Code::E0123, "a line of `reward`"),
            _ => return None,
        };
        let foreign = match word {
            "function" | "fn" | "def" | "const" | "var" => Some("let"),
            "condition" | "observation" => Some("predicate"),
            "action" | "skill" => Some("behavior"),
            "import" | "include" => Some("use"),
            "include_std" => Some("use"),
            "actions" => Some("choose"),
            "rewards" => Some("reward"),
            "terminate" | "done" => Some("end"),
            "success" => Some("succeed"),
            "failure" => Some("fail"),
            "precondition" | "require" => Some("requires"),
            "default" | "else" => Some("otherwise"),
            _ => None,
        };
        let near = foreign
            .filter(|meant| candidates.contains(meant))
            .or_else(|| suggest::nearest(word, candidates.iter().copied()));
        let diagnostic = Diagnostic::new(
            code,
            self.span(),
            format!("`{word}` does not begin {begins}"),
        );
        let listed: Vec<String> = candidates.iter().map(|word| format!("`{word}`")).collect();
        let diagnostic = match near {
            Some(near) => diagnostic.label(format!("did you mean `{near}`?")).fix(
                format!("write `{near}`"),
                self.span(),
                near,
                Applicability::Unsafe,
            ),
            None => diagnostic.label("not known here"),
        };
        Some(diagnostic.note(format!("{begins} begins with {}", either(&listed))))
    }

    fn unexpected(&self, tokens: &[Token]) -> Diagnostic {
        let found = self.found();
        let open = innermost_open(self.text, tokens, self.failure.start, self.found.start);
        let is_close = matches!(found, ")" | "}");
        if let Some(open) = open
            && is_close
            && (open.of(self.text) == "(") != (found == ")")
        {
            let span = Span::new(self.file, open.start, open.end);
            if found == "}" {
                return unclosed(self.file, self.text, tokens, span, self.found.start);
            }
        } else if open.is_none() && is_close {
            return Diagnostic::new(
                Code::E0103,
                self.span(),
                format!("this `{found}` closes nothing"),
            )
            .label("no bracket is open here")
            .fix(
                format!("drop the `{found}`"),
                self.span(),
                "",
                Applicability::Unsafe,
            );
        }
        let diagnostic = match expected::listed(&self.failure.expected) {
            Some(wanted) => Diagnostic::new(
                Code::E0101,
                self.span(),
                format!("expected {wanted}, found `{found}`"),
            )
            .label(format!("expected {wanted}")),
            None => Diagnostic::new(
                Code::E0101,
                self.span(),
                format!("`{found}` cannot stand here"),
            ),
        };
        match open.filter(|open| open.of(self.text) == "(" && self.expects(Rule::close_paren)) {
            Some(open) => diagnostic.also(
                Span::new(self.file, open.start, open.end),
                "to close this one",
            ),
            None => diagnostic,
        }
    }
}

/// "a, b or c"
fn either(words: &[String]) -> String {
    match words.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, first)) => format!("{} or {last}", first.join(", ")),
        None => String::new(),
    }
}

/// The message for a word that follows a number and is no unit; `others` may follow a number too.
pub(super) fn no_such_unit(span: Span, word: &str, others: &[&str]) -> Diagnostic {
    let diagnostic = Diagnostic::new(Code::E0114, span, format!("`{word}` is no unit"));
    let units = UNITS.into_iter().filter(|unit| unit.len() > 1);
    let near = suggest::nearest(word, units.chain(others.iter().copied())).or_else(|| {
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
        None => diagnostic.label("this follows a number"),
    };
    diagnostic.note(units_note())
}

/// What a quote is called.
pub(super) fn quote_name(quote: char) -> &'static str {
    if quote == '`' {
        "backquote"
    } else {
        "quotation mark"
    }
}
