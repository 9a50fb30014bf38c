//! Commas that are missing, and what looks like it: other words and brackets that are missing between two entries.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::diagnose::end_is_missing;
use crate::syntax::grammar::Node;
use crate::syntax::tokens::is_blank;
use crate::syntax::words::{CALLED, UNITS};

/// What the commas of a history part.
pub(super) const HISTORY: &str = "the ends of a history";

/// What to write for a word behind a node that other languages have there.
fn behind_a_node(word: &str) -> Option<&'static str> {
    let near = ["until", "unless", "while", "when"].into_iter();
    let near = near.filter(|_| word.len() >= 4);
    let near = near.rev().find(|known| suggest::is_near(word, known));
    Some(match near.unwrap_or(word) {
        "with" | "after" | "within" => {
            "what a node is done with goes around it: `timeout(10 s) { … }`, `retry(2) { … }`"
        }
        "until" | "unless" => "a condition goes before its node: `not CONDITION => NODE`",
        "while" | "when" | "provided" | "if" => {
            "a condition goes before its node: `CONDITION => NODE`"
        }
        _ => return None,
    })
}

impl<'i> Builder<'i> {
    /// Reports a comma that is missing just before `node`, after what stands at `before`.
    pub(super) fn missing_comma(&mut self, node: &Node<'i>, before: Option<Span>, what: &str) {
        let at = self.starts(node);
        let next = self.token_at(at);
        let place = next.map_or(Span::new(self.file, at, at), |token| {
            Span::new(self.file, token.start, token.end)
        });
        let comma = before.map_or(place.before(), Span::after);
        let message = format!("a comma is missing before `{}`", self.slice(place));
        let name = before.map(|before| self.slice(before));
        if self.linked(place, before) {
            return;
        }
        // What a quote that is not closed has taken is reported there.
        if name.is_some_and(|name| name.starts_with('`') && !name.ends_with('`')) {
            return;
        }
        // Of `full => goto` the last word is the one that lacks its arguments.
        let last = before.map(|before| {
            let word = self.slice(before).rsplit(' ').next().unwrap_or_default();
            let range = before.range();
            (
                word,
                Span::new(self.file, range.end - word.len(), range.end),
            )
        });
        if let Some((name, before)) = last
            && what != HISTORY
            && self.missing_brackets(name, before, place, what)
        {
            return;
        }
        let of_kind = [
            "place",
            "wall",
            "robot",
            "sensor",
            "state",
            "event",
            "predicate",
        ];
        if let (Some(kind), Some(before)) = (name, before)
            && of_kind.contains(&kind)
        {
            let name = self.slice(place);
            let diagnostic = Diagnostic::new(
                Code::E0101,
                before,
                format!("`{kind}` is not said of `{name}` here"),
            )
            .label("a name stands alone")
            .fix(
                format!("drop `{kind}`"),
                before.to(place.before()),
                "",
                Applicability::Unsafe,
            );
            self.report(diagnostic);
            return;
        }
        // Of `memory sequence [ … ]` the bracket is told.
        let rest = self.text.get(place.range().end..).unwrap_or_default();
        let in_brackets = rest.trim_start_matches(is_blank).starts_with('[');
        if last.is_some_and(|(word, _)| word == "memory")
            && matches!(self.slice(place), "selector" | "sequence")
            && in_brackets
        {
            return;
        }
        if let Some((word, before)) = last.filter(|(word, _)| *word == "memory") {
            let diagnostic = Diagnostic::new(
                Code::E0604,
                before,
                format!("only a `selector` or a `sequence` has a `{word}`"),
            )
            .label("a node goes before which this stands")
            .help("a node that goes on where it was: `memory sequence { …, … }`");
            self.report(diagnostic);
            return;
        }
        // `goto(any bed)`
        if let Some((name @ ("any" | "all" | "every" | "each"), before)) = last
            && what == "arguments"
            && self.on_one_line(before, place)
        {
            let kind = self.slice(place);
            let diagnostic = Diagnostic::new(
                Code::E0127,
                before,
                format!("all of a kind are meant by `in`, not by `{name}`"),
            )
            .label(format!("write `x in {kind}`"))
            .fix("write `x in`", before, "x in", Applicability::Unsafe);
            self.report(diagnostic);
            return;
        }
        // `after 10 min` below an end.
        if self.slice(place) == "after" && what == "the entries of a list" {
            self.report(end_is_missing(place));
            return;
        }
        // `given(w of ward)`
        if let Some((name, _)) = last
            && what == "arguments"
            && matches!(self.slice(place), "of" | "from" | "at")
        {
            let word = self.slice(place);
            let diagnostic = Diagnostic::new(
                Code::E0127,
                place,
                format!("all of a kind are meant by `in`, not by `{word}`"),
            )
            .label(format!("write `{name} in …`"))
            .fix("write `in`", place, "in", Applicability::Unsafe);
            self.report(diagnostic);
            return;
        }
        if what == "the children of a node" && self.misspelt_joint(before, place) {
            return;
        }
        if what == "the children of a node"
            && let Some(help) = behind_a_node(self.slice(place))
            && before.is_some_and(|before| self.on_one_line(before, place))
        {
            let message = format!("`{}` does not go on with a node", self.slice(place));
            let diagnostic = Diagnostic::new(Code::E0101, place, message)
                .label("this is not said here")
                .help(help);
            self.report(diagnostic);
            return;
        }
        if what == "the children of a node"
            && (self.missing_arrow(before, place) || self.missing_joint(before, place))
        {
            return;
        }
        if what == "arguments"
            && let Some(diagnostic) =
                before.and_then(|before| self.unit_behind_number(before, place))
        {
            self.report(diagnostic);
            return;
        }
        if what == "arguments" && self.named_behind(before, place) {
            return;
        }
        if what == "the children of a node"
            && (self.missing_quotes(before, place) || self.missing_paren(before, place))
        {
            return;
        }
        // Between two arguments an operator may be missing as well.
        let product = before.filter(|before| {
            let value = self.slice(*before);
            what == "arguments" && !value.contains('=') && self.on_one_line(*before, place)
        });
        // What stands on one line may lack more than a comma, unless both are nodes, or the second one is an argument with its
        // name.
        let rest = self.text.get(place.range().end..).unwrap_or_default();
        let rest = rest.trim_start_matches(is_blank);
        let is_named = rest.starts_with('=') && !rest.starts_with("==") && !rest.starts_with("=>");
        let is_named = is_named && !UNITS.contains(&self.slice(place));
        let is_known = |word: &str| {
            let head = word.split(['(', '{']).next().unwrap_or_default();
            word.ends_with([')', '}'])
                || self.names_leaf(head)
                || self.glance().declares_by(&["predicate"], head)
        };
        let sure = match what {
            "the children of a node" => {
                self.names_leaf(self.slice(place)) && last.is_none_or(|(word, _)| is_known(word))
            }
            "arguments" | "parameters" => is_named,
            "variants" => false,
            _ => true,
        };
        let unsure = !sure && before.is_some_and(|before| self.on_one_line(before, place));
        let applicability = match product.is_some() || unsure {
            true => Applicability::Unsafe,
            false => Applicability::Safe,
        };
        let mut diagnostic = Diagnostic::new(Code::E0112, place, message)
            .label("this begins another one")
            .note(format!("commas part {what}"))
            .fix("put a comma", comma, ",", applicability);
        if self.slice(place) == "not" {
            diagnostic = diagnostic.help("conditions are joined: `a and not b`");
        }
        let is_word = |word: &str| {
            let letters = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
            !word.is_empty() && word.chars().all(letters)
        };
        if let Some(name) = name.filter(|name| is_word(name) && is_word(self.slice(place)))
            && before.is_some_and(|before| self.on_one_line(before, place))
            && self.slice(place) != "not"
            && what != HISTORY
            && what != "variants"
        {
            let argument = self.slice(place);
            let family = |name| {
                let declaring = ["predicate", "state", "event", "behavior", "let", "tree"];
                CALLED.contains(&name) || self.glance().declares_called(&declaring, name)
            };
            let help = match product {
                Some(_) => Some(format!(
                    "a product is written with `*`: `{name} * {argument}`"
                )),
                None => family(name)
                    .then(|| format!("if `{argument}` is an argument: `{name}({argument})`")),
            };
            if let Some(help) = help {
                diagnostic = diagnostic.help(help);
            }
        }
        self.report(diagnostic);
    }
}
