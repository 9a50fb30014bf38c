//! Reporting: a mistake is reported where it is found, in one statement.

use super::Checker;
use super::types::Typed;
use crate::diagnostic::{Applicability, Code, Diagnostic, Fix, suggest};
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::ast::{Expr, ExprKind, Ident};
use crate::syntax::print;
use std::fmt::Display;

/// A diagnostic under construction; it is reported when it is dropped.
pub struct Draft<'d> {
    diagnostic: Option<Diagnostic>,
    reported: &'d mut Vec<Diagnostic>,
}

impl Drop for Draft<'_> {
    fn drop(&mut self) {
        self.reported.extend(self.diagnostic.take());
    }
}

impl<'d> Draft<'d> {
    /// A diagnostic that goes to `reported`.
    pub fn new(
        reported: &'d mut Vec<Diagnostic>,
        code: Code,
        span: Span,
        message: impl Into<String>,
    ) -> Self {
        Self {
            diagnostic: Some(Diagnostic::new(code, span, message)),
            reported,
        }
    }

    /// Nothing: whatever is added to it is dropped.
    pub fn silent(reported: &'d mut Vec<Diagnostic>) -> Self {
        Self {
            diagnostic: None,
            reported,
        }
    }

    fn with(mut self, add: impl FnOnce(Diagnostic) -> Diagnostic) -> Self {
        self.diagnostic = self.diagnostic.take().map(add);
        self
    }

    /// Says something at the primary place.
    pub fn label(self, message: impl Into<String>) -> Self {
        self.with(|diagnostic| diagnostic.label(message))
    }

    /// Says what is to be written at the primary place, and offers to write it over a span.
    pub fn write(self, span: Span, right: impl Into<String>, applicability: Applicability) -> Self {
        self.with(|diagnostic| diagnostic.write(span, right, applicability))
    }

    /// Labels the primary place with what is there.
    pub fn this_is(self, what: impl Display) -> Self {
        self.label(format!("this is {what}"))
    }

    /// Says something at a further place.
    pub fn also(self, span: Span, message: impl Into<String>) -> Self {
        self.with(|diagnostic| diagnostic.also(span, message))
    }

    /// Shows further places of one mistake.
    pub fn and_at(self, places: &[Span], message: &str) -> Self {
        self.with(|diagnostic| diagnostic.and_at(places, message))
    }

    /// Adds a note.
    pub fn note(self, note: impl Into<String>) -> Self {
        self.with(|diagnostic| diagnostic.note(note))
    }

    /// Adds a note where there is any.
    pub fn note_if(self, note: Option<String>) -> Self {
        match note {
            Some(note) => self.note(note),
            None => self,
        }
    }

    /// Adds advice.
    pub fn help(self, help: impl Into<String>) -> Self {
        self.with(|diagnostic| diagnostic.help(help))
    }

    /// Adds advice where there is any.
    pub fn help_if(self, help: Option<String>) -> Self {
        match help {
            Some(help) => self.help(help),
            None => self,
        }
    }

    /// Adds advice where there is any, and none yet.
    pub fn or_help(self, help: Option<String>) -> Self {
        let advised = self
            .diagnostic
            .as_ref()
            .is_some_and(|it| !it.help.is_empty());
        self.help_if(help.filter(|_| !advised))
    }

    /// Points at another place, too, if there is one.
    pub fn also_if(self, place: Option<Span>, message: &str) -> Self {
        match place {
            Some(place) => self.also(place, message),
            None => self,
        }
    }

    /// Offers to replace the text of a span, if there is anything to offer: the title, the span and the new text.
    pub fn fix_if(self, fix: Option<(String, Span, String)>) -> Self {
        match fix {
            Some((title, span, right)) => self.fix(title, span, right, Applicability::Unsafe),
            None => self,
        }
    }

    /// Offers to replace the text of one span.
    pub fn fix(
        self,
        title: impl Into<String>,
        span: Span,
        replacement: impl Into<String>,
        applicability: Applicability,
    ) -> Self {
        self.with(|diagnostic| diagnostic.fix(title, span, replacement, applicability))
    }

    /// Offers the name that was likely meant, if there is one.
    pub fn likely(self, name: &Ident, likely: Option<&str>) -> Self {
        match likely {
            None => self,
            Some(likely) => {
                let question = format!("did you mean `{likely}`?");
                self.label(question.clone()).fix(
                    question,
                    name.span,
                    spelled(likely),
                    Applicability::Unsafe,
                )
            }
        }
    }

    /// Reports it.
    pub fn emit(self) {}

    /// Reports it, with nothing to return.
    pub fn none<T>(self) -> Option<T> {
        None
    }

    /// Reports it; the expression that it is about has no meaning.
    pub fn typed(self) -> Typed {
        Typed::error(
            self.diagnostic
                .as_ref()
                .map_or_else(Span::default, Diagnostic::span),
        )
    }
}

impl<'a> Checker<'a> {
    /// Reports an error at `span`, with what is added to it in the same statement.
    pub fn error(&mut self, code: Code, span: Span, message: impl Into<String>) -> Draft<'_> {
        Draft::new(&mut self.diagnostics, code, span, message)
    }

    /// Reports a warning at `span`: what differs from an error is its code.
    pub fn warning(&mut self, code: Code, span: Span, message: impl Into<String>) -> Draft<'_> {
        self.error(code, span, message)
    }

    /// Reports a name that `owner` does not have among its `known` ones.
    pub fn unknown_to(
        &mut self,
        owner: &str,
        code: Code,
        name: &Ident,
        what: &str,
        known: &[&str],
    ) -> Draft<'_> {
        let label = match known {
            [] => "it has none".to_owned(),
            known => format!("it has {}", listed(known, "and")),
        };
        let message = format!("{owner} has no {what} `{}`", name.name);
        let only = match known {
            [only] => Some(*only),
            _ => None,
        };
        let likely = suggest::nearest(&name.name, known.iter().copied()).or(only);
        // That one is not missing as well.
        if let Some(likely) = likely {
            self.names.lose(likely);
        }
        self.error(code, name.span, message)
            .label(label)
            .likely(name, likely)
    }

    /// Reports something that is given a second time.
    pub fn said_twice(&mut self, what: &str, here: Span, first: Span) {
        self.error(Code::E0503, here, format!("`{what}` is given twice"))
            .label("given again here")
            .also(first, "first given here");
    }

    /// Reports a part that `owner` lacks, unless it may stand in what was not understood.
    pub fn missing(&mut self, code: Code, span: Span, owner: &str, missing: &str, example: &str) {
        let word = missing.split(' ').next().unwrap_or(missing);
        if self.names.is_lost(word) {
            return;
        }
        self.error(code, span, format!("{owner} has no `{missing}`"))
            .label(format!("`{missing}` is missing"))
            .help(format!("for example: `{example}`"));
    }

    /// Reports a value that is none of the `choices`.
    pub fn choice_of(&mut self, value: &Expr, what: &str, choices: &[&str]) {
        let name = match &value.kind {
            ExprKind::Error => return,
            ExprKind::Ref(reference) => Some(&reference.name),
            _ => None,
        };
        let span = name.map_or(value.span, |name| name.span);
        let draft = self
            .error(
                Code::E0403,
                span,
                format!("{what} is {}", listed(choices, "or")),
            )
            .label("this is not");
        if let ([only], ExprKind::Number(_)) = (choices, &value.kind)
            && let Some((shape, _)) = only.split_once('(')
        {
            let right = format!("{shape}({})", print::expr(value));
            let title = format!("write `{right}`");
            draft.fix(title, span, right, Applicability::Unsafe);
            return;
        }
        if let Some(name) = name {
            let words = choices.iter().filter_map(|choice| choice.split('(').next());
            draft.likely(name, suggest::nearest(&name.name, words));
        }
    }

    /// Reports a number outside its range.
    pub fn out_of_range(&mut self, span: Span, why: impl Into<String>, label: &str) -> Draft<'_> {
        let slip = self.likely_slip(span);
        let draft = self.error(Code::E0309, span, why).label(label);
        slip.into_iter().fold(draft, |draft, fix| {
            draft.with(|mut diagnostic| {
                diagnostic.fixes.push(fix);
                diagnostic
            })
        })
    }

    /// What mends a number within `span` of which was just warned that it is likely a slip. Where the number is wrong as
    /// well, one message is enough.
    fn likely_slip(&mut self, span: Span) -> Option<Fix> {
        let warned = self.diagnostics.pop_if(|last| {
            let at = last.span();
            let within = at.file == span.file && span.start <= at.start && at.end <= span.end;
            within && matches!(last.code, Code::W0301 | Code::W0402)
        })?;
        warned.fixes.into_iter().next()
    }

    /// Reports that `what` needs a world in a program without one.
    pub fn no_world(&mut self, span: Span, what: &str, label: &str) -> Draft<'_> {
        let message = format!("{what} needs a world, and there is none");
        self.error(Code::E0407, span, message).label(label)
    }
}

/// How many names are listed at most where none of a name is known: a long list says little.
pub const LISTED: usize = 6;

/// Names in a sentence: `a`, `b` and `c`.
pub fn listed(names: &[&str], word: &str) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} {word} {last}", most.join(", ")),
    }
}

/// A number to three places: a length to the millimetre.
pub fn short(number: f64) -> f64 {
    let digits = match number.abs() {
        small if small > 0.0 && small < 0.01 => 1e6,
        _ => 1e3,
    };
    (number * digits).round() / digits
}
