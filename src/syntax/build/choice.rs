//! Choices, and the values in braces that they choose from.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::ast::{Choice, Otherwise, Yield};
use crate::syntax::diagnose;
use crate::syntax::grammar::{Node, Parts, Rule};

impl<'i> Builder<'i> {
    pub(super) fn choice(&mut self, node: Node<'i>) -> Choice {
        self.choice_parts(Parts::of(node))
    }

    fn choice_parts(&mut self, mut parts: Parts<'i>) -> Choice {
        let place = parts.maybe(Rule::kw_if).map(|node| self.span(&node));
        let cond = self.take_expr(&mut parts);
        let then = self.take_yield(&mut parts);
        let otherwise = match parts.maybe(Rule::choice_else) {
            Some(node) => self.choice_else(node, place.unwrap_or(cond.span), then.span),
            None => Otherwise::Yield(self.no_yield(then.span.after())),
        };
        Choice {
            cond,
            then,
            otherwise,
        }
    }

    fn choice_else(&mut self, node: Node<'i>, place: Span, then: Span) -> Otherwise {
        let mut parts = Parts::of(node);
        if let Some(word) = parts.maybe(Rule::wrong_else_if) {
            self.else_if(&word);
            let span = self.span(&word);
            let choice = self.choice_parts(parts);
            let end = otherwise_end(&choice.otherwise);
            return Otherwise::If(Box::new(choice), span.to(end));
        }
        if parts.has(Rule::missing_else) {
            self.missing_else(place, then);
            return Otherwise::Yield(self.no_yield(then.after()));
        }
        parts.has(Rule::kw_else);
        match parts.maybe(Rule::choice) {
            Some(node) => {
                let span = self.span(&node);
                Otherwise::If(Box::new(self.choice(node)), span)
            }
            None => Otherwise::Yield(self.take_yield(&mut parts)),
        }
    }

    /// Reports what follows the value `then` of the `if` at `place` and is no `else` with a value.
    fn missing_else(&mut self, place: Span, then: Span) {
        let start = place.range().start;
        if self.is_reported(start) {
            return;
        }
        let next = self.token_at(then.range().end);
        let next = next.map(|next| Span::new(self.file, next.start, next.end));
        let next = next.filter(|next| self.on_one_line(then, *next));
        let word = next.map_or("", |next| self.slice(next));
        if word == "else" && next.is_some_and(|next| self.is_choice_behind(next)) {
            // What is wrong stands behind the `else`.
            let failure = self.failure(Rule::strict_choice, start, start);
            let (at, diagnostic) =
                diagnose::failure(self.file, self.text, (self.tokens, self.glance()), &failure);
            self.failed_at = Some(at);
            self.report(diagnostic);
            self.lose_layout(start);
            return;
        }
        let diagnostic = match next {
            Some(next) if word == "else" => Diagnostic::new(
                Code::E0126,
                place,
                "both values of a choice stand in braces",
            )
            .label("write `if CONDITION { … } else { … }`")
            .also(next, "what follows has none"),
            Some(next) if matches!(word, "if" | "{") => {
                self.lose_layout(start);
                Diagnostic::new(Code::E0126, next, "an `else` is missing before this")
                    .label("the other value of the choice")
                    .also(place, "it begins here")
                    .fix("put `else`", next.before(), "else ", Applicability::Unsafe)
            }
            Some(next) if suggest::is_near(word, "else") => {
                self.lose_layout(start);
                let message = "a value by `if` needs an `else`";
                Diagnostic::new(Code::E0126, next, message)
                    .label("did you mean `else`?")
                    .fix("write `else`", next, "else", Applicability::Unsafe)
            }
            _ => Diagnostic::new(Code::E0126, place, "a value by `if` needs an `else`")
                .label("what is the value if this does not hold?")
                .also(then, "the value if it holds"),
        };
        self.report(diagnostic);
    }

    /// Whether the other value of a choice, or the choice of it, seems to follow its `else`.
    fn is_choice_behind(&self, word: Span) -> bool {
        let rest = self.text.get(word.range().end..).unwrap_or_default();
        let line = rest.lines().next().unwrap_or_default();
        let line = line.split("//").next().unwrap_or_default().trim();
        line.is_empty() || line.starts_with("if ") || line.contains('{')
    }

    fn take_yield(&mut self, parts: &mut Parts<'i>) -> Yield {
        match parts.maybe(Rule::r#yield) {
            Some(node) => self.yields(node),
            None => self.no_yield(Span::new(self.file, 0, 0)),
        }
    }

    fn no_yield(&self, span: Span) -> Yield {
        Yield {
            bindings: Vec::new(),
            value: Box::new(self.error_expr(span)),
            span,
        }
    }

    pub(super) fn yields(&mut self, node: Node<'i>) -> Yield {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        parts.has(Rule::open_brace);
        let mut bindings = Vec::new();
        while let Some(node) = parts.maybe(Rule::binding) {
            bindings.push(self.binding(node));
            if let Some(mark) = parts.maybe(Rule::stray_mark) {
                self.stray_mark(self.span(&mark));
            }
        }
        let value = Box::new(self.take_expr(&mut parts));
        if let Some(mark) = parts.maybe(Rule::stray_mark) {
            self.stray_mark(self.span(&mark));
        }
        Yield {
            bindings,
            value,
            span,
        }
    }
}

/// The place at which what follows an `else` ends.
fn otherwise_end(otherwise: &Otherwise) -> Span {
    match otherwise {
        Otherwise::If(_, span) => *span,
        Otherwise::Yield(end) => end.span,
    }
}
