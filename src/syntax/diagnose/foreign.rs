//! Habits of other languages: their comments, letters that only backquotes allow, outcomes that no history keeps, items
//! that need none.

use super::Place;
use super::words::of_kind;
use crate::diagnostic::{Applicability, Code, Diagnostic, Fix};
use crate::source::Span;
use crate::spelling::quoted;
use crate::syntax::follow_ups::CLOSED_ABOVE;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, is_blank};
use crate::syntax::words::{KINDS, home};

/// What begins a comment elsewhere.
const COMMENTS: [&str; 4] = ["#", "/*", "--", "<!--"];

/// What is said of a comment as other languages begin it.
pub(in crate::syntax) fn other_comment(span: Span, begins: &str) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::E0129,
        span,
        format!("a comment begins with `//`, not with `{begins}`"),
    )
    .label("write `//`")
    .note("it goes on to the end of its line");
    let over_lines = matches!(begins, "/*" | "<!--");
    match over_lines {
        true => diagnostic,
        false => diagnostic.fix("write `//`", span, "//", Applicability::Safe),
    }
}

/// Where comments begin with two dashes, as in other languages: on a line of their own, or before two words that no operator
/// joins.
pub(in crate::syntax) fn dashed(text: &str) -> Vec<usize> {
    let mut found = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let at = line.find("--").filter(|at| begins_comment(line, *at));
        found.extend(at.map(|at| start + at));
        start += line.len();
    }
    found
}

fn begins_comment(line: &str, at: usize) -> bool {
    let (before, after) = line.split_at(at);
    let after = after.trim_start_matches('-');
    let words = after.trim_start_matches(is_blank);
    if before.trim_matches(is_blank).is_empty() {
        return words.is_empty()
            || words.len() < after.len() && words.starts_with(char::is_alphabetic);
    }
    let word = |text: &str| -> usize {
        text.find(|c: char| !c.is_alphanumeric())
            .unwrap_or(text.len())
    };
    let (_, rest) = words.split_at(word(words));
    let rest = rest.strip_prefix(' ').unwrap_or_default();
    let (second, _) = rest.split_at(word(rest));
    let joins = ["and", "or", "not", "is", "else", "per", "of", "in", "for"].contains(&second);
    let in_code = before.ends_with(is_blank) && !before.contains("//");
    let in_code = in_code && !before.contains(['"', '`']);
    in_code
        && after.starts_with(' ')
        && words.starts_with(char::is_alphabetic)
        && rest.starts_with(char::is_alphabetic)
        && !joins
}

impl Place<'_> {
    /// A comment as other languages begin it.
    pub(super) fn comment(&self) -> Option<Diagnostic> {
        // Two signs before a value are read as signs.
        let signs = [self.second_before, self.before].into_iter().flatten();
        let mut starts = signs.chain([self.found]).map(|token| token.start);
        let (at, begins) = starts.find_map(|at| {
            let rest = self.text.get(at..).unwrap_or_default();
            let begins = COMMENTS.into_iter().find(|mark| rest.starts_with(mark))?;
            Some((at, begins))
        })?;
        let rest = self.text.get(at..).unwrap_or_default();
        if let Some(word) = ["#include", "#import"]
            .iter()
            .find(|word| rest.starts_with(**word))
        {
            let span = Span::new(self.file, at, at + word.len());
            let message = format!("`{word}` does not begin an item");
            return Some(
                Diagnostic::new(Code::E0105, span, message)
                    .label("did you mean `use`?")
                    .fix("write `use`", span, "use", Applicability::Unsafe)
                    .note("a program uses `std`, its library, and files: `use \"other.bt\"`"),
            );
        }
        if let Some(defined) = rest.strip_prefix("#define ") {
            let span = Span::new(self.file, at, at + "#define".len());
            let defined = defined.lines().next().unwrap_or_default().trim();
            let help = match defined.split_once(' ') {
                Some((name, value)) => {
                    format!("a value under a name: `let {name} = {}`", value.trim())
                }
                None => "a value under a name: `let NAME = VALUE`".to_owned(),
            };
            let message = "`#define` does not begin an item";
            return Some(
                Diagnostic::new(Code::E0105, span, message)
                    .label("not known here")
                    .help(help),
            );
        }
        let span = Span::new(self.file, at, at + begins.len());
        let mut diagnostic = other_comment(span, begins);
        let lines = self.as_lines(at, begins).map(|edits| Fix {
            title: "write `//` on each of its lines".to_owned(),
            edits,
            applicability: Applicability::Safe,
        });
        diagnostic.fixes.extend(lines);
        Some(diagnostic)
    }

    /// What makes comments of the language of one that begins here and ends at a mark of its own, with nothing behind it on its line.
    fn as_lines(&self, at: usize, begins: &str) -> Option<Vec<(Span, String)>> {
        let ends = match begins {
            "/*" => "*/",
            "<!--" => "-->",
            _ => return None,
        };
        let start = at + begins.len();
        let rest = self.text.get(start..)?;
        let said = rest.get(..rest.find(ends)?)?;
        let behind = rest.get(said.len() + ends.len()..)?;
        let behind = behind.lines().next().unwrap_or_default();
        if !behind.trim().is_empty() {
            return None;
        }
        let edit =
            |from: usize, to: usize, text: &str| (Span::new(self.file, from, to), text.to_owned());
        let mut edits = vec![edit(at, start, "//")];
        let mut line = start;
        for (number, own) in said.split('\n').enumerate() {
            let trimmed = own.trim_start();
            let text = line + own.len() - trimmed.len();
            let stars = trimmed.len() - trimmed.trim_start_matches('*').len();
            if number > 0 && !trimmed.is_empty() {
                // The stars stand below the first one.
                let below = stars > 0 && own.starts_with(' ');
                let blank = if stars > 0 { "" } else { " " };
                edits.push(edit(
                    text - usize::from(below),
                    text + stars,
                    &format!("//{blank}"),
                ));
            }
            line += own.len() + 1;
        }
        // A mark on a line of its own leaves nothing of it.
        let kept = said.trim_end_matches([' ', '\t']);
        edits.push(edit(
            start + kept.len(),
            start + said.len() + ends.len(),
            "",
        ));
        Some(edits)
    }

    /// A name with letters that a name has in backquotes only.
    pub(super) fn letters(&self) -> Option<Diagnostic> {
        let word = self.found();
        if self.found.kind != Kind::Word || word.is_ascii() {
            return None;
        }
        let letter = word.chars().find(|letter| !letter.is_ascii())?;
        let name = quoted(word);
        Some(
            Diagnostic::new(
                Code::E0131,
                self.span(),
                format!("`{letter}` is no letter of a name"),
            )
            .label("names are made of a to z, A to Z, digits and `_`")
            .fix(
                "put it in backquotes",
                self.span(),
                name,
                Applicability::Unsafe,
            ),
        )
    }

    /// A word that should say what a history keeps.
    pub(super) fn outcome(&self) -> Option<Diagnostic> {
        if self.found.kind != Kind::Word || !self.expects(Rule::outcome) {
            return None;
        }
        let message = format!(
            "a history keeps `success`, `failure` or both, found `{}`",
            self.found()
        );
        let meant = match self.found().to_ascii_lowercase().as_str() {
            "and" | "or" => {
                let before = self.before.map_or(self.span(), |token| self.span_of(token));
                let joined = Span {
                    start: before.end,
                    ..self.span()
                };
                return Some(
                    Diagnostic::new(Code::E0101, self.span(), message)
                        .label("they are parted by commas")
                        .fix("put a comma", joined, ",", Applicability::Unsafe),
                );
            }
            "done" | "succeeded" | "successes" | "succeeds" | "success" => Some("success"),
            "failed" | "failures" | "fails" | "fail" | "failure" => Some("failure"),
            _ => None,
        };
        let diagnostic = Diagnostic::new(Code::E0101, self.span(), message)
            .label("expected `success` or `failure`");
        Some(match meant {
            Some(meant) => diagnostic.fix(
                format!("write `{meant}`"),
                self.span(),
                meant,
                Applicability::Unsafe,
            ),
            None => diagnostic,
        })
    }

    /// `on EVENT => carrying = true`, `each tick: battery -= 1%`: effects without their braces.
    pub(super) fn effect(&self) -> Option<Diagnostic> {
        let is_item = self.failure.strict == Rule::strict_item;
        if !is_item || !(self.begins_with("on") || self.begins_with("each")) {
            return None;
        }
        let sets = |token: &str| matches!(token, "=" | ":=" | "+=" | "-=" | "*=" | "/=");
        let mark = |token: &str| matches!(token, "=>" | "->" | ":");
        let found = self.found();
        let at = match mark(found) {
            true => self.found,
            false if sets(found) => {
                let first = self
                    .tokens
                    .partition_point(|token| token.end <= self.failure.start);
                let tokens = self.tokens.get(first..)?.iter();
                let mut before = tokens.take_while(|token| token.start < self.found.start);
                *before.find(|token| mark(token.of(self.text)))?
            }
            false => return None,
        };
        let rest = self.text.get(at.end..)?.lines().next()?;
        let effect = rest.split("//").next()?.trim();
        let set = ["+=", "-=", "*=", "/=", "="]
            .iter()
            .any(|sign| effect.contains(sign));
        let message = "effects stand in braces".to_owned();
        let diagnostic = Diagnostic::new(Code::E0101, self.span_of(at), message);
        if !set || effect.contains(['{', '}']) {
            return Some(diagnostic.label("write `{ … }`"));
        }
        let right = format!("{{ {effect} }}");
        let until = at.end + rest.find(effect)? + effect.len();
        Some(diagnostic.write(
            Span::new(self.file, at.start, until),
            right,
            Applicability::Unsafe,
        ))
    }

    /// A word that begins no item because what it says needs none, or stands within one.
    pub(super) fn no_item(&self, code: Code) -> Option<Diagnostic> {
        let word = self.found();
        let message = format!("`{word}` does not begin an item");
        let diagnostic = Diagnostic::new(code, self.span(), message);
        let next = self.next().filter(|next| !self.parted(self.found, *next));
        if let Some(next) = next.filter(|_| KINDS.contains(&word))
            && matches!(next.kind, Kind::Word | Kind::Name)
        {
            let kind = next.of(self.text);
            return Some(
                diagnostic
                    .label("a kind needs no declaration")
                    .help(of_kind(kind)),
            );
        }
        let (whole, example) = home(word)?;
        let closed = whole == "a tree" && self.before() == ",";
        if closed {
            return Some(diagnostic.label("this stands in a tree").help(CLOSED_ABOVE));
        }
        Some(
            diagnostic
                .label(format!("this stands in {whole}"))
                .help(format!("put it there: `{example}`")),
        )
    }
}
