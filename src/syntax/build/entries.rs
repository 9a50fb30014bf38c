//! The entries of a block, up to its closing bracket, and the mistakes among them.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::brackets;
use crate::syntax::diagnose::{self, Failure};
use crate::syntax::grammar::{self, Node, Parts, Rule};
use crate::syntax::tokens::{Kind, is_blank};
use std::ops::Range;

/// The units of times.
const UNITS: [&str; 4] = ["ms", "s", "min", "h"];

/// How many tokens of a text that fails are enough in most cases.
const TOKENS_SEEN: usize = 192;

/// How many tokens behind a failure the parser may have looked at.
const TOKENS_AHEAD: usize = 16;

impl<'i> Builder<'i> {
    /// Hands each entry among `parts` to `push`, with its place; a bad one, which is reported here, without its
    /// production. `strict` is the rule of the entries alone.
    pub(super) fn entries(
        &mut self,
        parts: Parts<'i>,
        strict: Rule,
        push: impl FnMut(&mut Self, Option<Node<'i>>, Span),
    ) {
        self.entries_after(None, parts, strict, push);
    }

    /// The same of entries that follow one at `previous`.
    pub(super) fn entries_after(
        &mut self,
        mut previous: Option<Span>,
        parts: impl IntoIterator<Item = Node<'i>>,
        strict: Rule,
        mut push: impl FnMut(&mut Self, Option<Node<'i>>, Span),
    ) {
        let mut open = None;
        for part in parts {
            let span = self.span(&part);
            match part.as_rule() {
                Rule::open_brace => open = Some(span),
                Rule::missing_open => self.missing_open(span, part.as_str()),
                Rule::close_brace | Rule::comma | Rule::children_end | Rule::EOI => {}
                Rule::missing_close => self.missing_close(self.starts(&part), open),
                // What is written in place of an `if` has the comma.
                Rule::missing_child_comma
                    if previous.is_some_and(|span| self.slice(span).starts_with("if")) => {}
                Rule::missing_child_comma => {
                    self.missing_comma(&part, previous, "the children of a node");
                }
                Rule::stray_mark => self.stray_mark(span),
                Rule::stray_close => self.stray_close(span),
                Rule::bad_item | Rule::bad_entry | Rule::bad_reward | Rule::bad_child => {
                    self.bad(span.range().start, strict, previous);
                    self.lose(span);
                    if let Some(previous) = previous
                        && self.goes_on(span.range().start)
                    {
                        self.suspect(previous);
                        self.join_names(previous, span);
                    }
                    previous = Some(span);
                    push(self, None, span);
                }
                _ => {
                    previous = Some(span);
                    push(self, Some(part), span);
                }
            }
        }
    }

    /// Whether what is wrong at byte `at` follows from a mistake that has been reported.
    pub(super) fn is_reported(&self, at: usize) -> bool {
        self.failed_at.is_some_and(|failed| at <= failed)
    }

    /// Reports the text at byte `start`, which does not parse as `strict` entries.
    fn bad(&mut self, start: usize, strict: Rule, previous: Option<Span>) {
        if self.is_reported(start) {
            return;
        }
        let mut failure = self.failure(strict, start, start);
        if let Some(previous) = previous {
            failure = self.continuation(&failure, previous).unwrap_or(failure);
            let apart = self.juxtaposition(&failure, Some(previous));
            failure = apart.unwrap_or(failure);
        }
        let (at, diagnostic) =
            diagnose::failure(self.file, self.text, (self.tokens, self.glance()), &failure);
        self.failed_at = Some(at);
        self.lose_meant(&diagnostic);
        self.report(diagnostic);
    }

    /// What a misspelt word was to say is not missing as well.
    fn lose_meant(&mut self, diagnostic: &Diagnostic) {
        let meant = match (diagnostic.code, diagnostic.fixes.as_slice()) {
            (Code::E0105 | Code::E0123, [fix]) => fix.edits.first(),
            _ => None,
        };
        let meant = meant.and_then(|(_, right)| right.split(' ').next());
        self.lost.names.extend(match meant {
            // What a learner learns is called so where it says no other name.
            Some("learn") => Some("learned".to_owned()),
            Some("observe" | "choose" | "history" | "end" | "reward" | "episodes") => {
                meant.map(str::to_owned)
            }
            _ => None,
        });
    }

    /// How the text at byte `start` fails to parse as `strict` entries, read from byte `from` on.
    pub(super) fn failure(&self, strict: Rule, from: usize, start: usize) -> Failure {
        self.failure_among(TOKENS_SEEN, strict, from, start)
    }

    /// The same, with so many tokens of the text in sight at first: pest's time for a failure grows with the text behind
    /// it, so that it is shown more of it only where it gets to the end of what it sees.
    fn failure_among(&self, seen: usize, strict: Rule, from: usize, start: usize) -> Failure {
        let first = self.tokens.partition_point(|token| token.start < from);
        let begin = |at: usize| self.tokens.get(first + at).map(|token| token.start);
        let near = std::iter::successors(Some(seen), |seen| Some(seen * 2))
            .map_while(|seen| Some((begin(seen)?, begin(seen - TOKENS_AHEAD)?)))
            .find_map(|(end, known)| {
                let near = self.failure_within(strict, from..end, start)?;
                (near.at < known).then_some(near)
            });
        let whole = || self.failure_within(strict, from..self.text.len(), start);
        near.or_else(whole).unwrap_or(Failure {
            start,
            at: start,
            expected: Vec::new(),
            strict,
        })
    }

    /// The same, read as if the text ended with a range; none if all of the range is right.
    fn failure_within(&self, strict: Rule, range: Range<usize>, start: usize) -> Option<Failure> {
        let from = range.start;
        let stop = grammar::parse(strict, self.text.get(range)?).err()?;
        let at = (from + stop.at).max(start);
        let rest = self.text.get(at..).unwrap_or_default();
        Some(Failure {
            start,
            at: self.text.len() - rest.trim_start_matches(is_blank).len(),
            expected: stop.expected,
            strict,
        })
    }

    /// A text that fails at once may go on with the previous entry: read together, they fail further on, or they
    /// stand on one line.
    fn continuation(&self, alone: &Failure, previous: Span) -> Option<Failure> {
        let start = alone.start;
        if alone.at != start {
            return None;
        }
        let together = self.failure(alone.strict, previous.range().start, start);
        (together.at > start || self.goes_on(start)).then_some(together)
    }

    /// A text on the line of the previous entry that fails at its second token, which does not look like the second
    /// one of an entry: it is the first token that does not belong there.
    fn juxtaposition(&self, failure: &Failure, previous: Option<Span>) -> Option<Failure> {
        let start = failure.start;
        let index = self.tokens.partition_point(|token| token.end <= start);
        let code = |index: usize| {
            let token = self.tokens.get(index);
            token.filter(|token| token.kind != Kind::Comment)
        };
        let (before, first, second) =
            (code(index.checked_sub(1)?)?, code(index)?, code(index + 1)?);
        let is_operator = matches!(first.of(self.text), "and" | "or" | "not" | "in" | "is");
        let is_entry = before.of(self.text) == "{"
            || first.kind != Kind::Word
            || second.kind == Kind::Mark
            || is_operator;
        let apart = self.goes_on(start) && !is_entry && second.start == failure.at;
        apart.then(|| {
            let together = previous
                .map(|previous| self.failure(failure.strict, previous.range().start, start));
            let expected = together.filter(|together| together.at == start);
            Failure {
                start,
                at: start,
                expected: expected.map_or(Vec::new(), |together| together.expected),
                strict: failure.strict,
            }
        })
    }

    /// Whether something stands before byte `start` on its line.
    pub(super) fn goes_on(&self, start: usize) -> bool {
        let before = self.text.get(..start).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default();
        !line.chars().all(is_blank)
    }

    /// Reports a `;` or a `,` between entries.
    pub(super) fn stray_mark(&mut self, span: Span) {
        let mark = self.slice(span);
        let message = format!("nothing needs a `{mark}` here");
        let diagnostic = Diagnostic::new(Code::E0118, span, message)
            .label("drop it")
            .note("an entry ends where the next one begins")
            .fix(format!("drop the `{mark}`"), span, "", Applicability::Safe);
        self.report(diagnostic);
    }

    fn stray_close(&mut self, span: Span) {
        if self.is_reported(span.range().start) {
            return;
        }
        let mark = self.slice(span);
        let open = if mark == ")" { "(" } else { "{" };
        let message = format!("this `{mark}` closes nothing");
        let drop = format!("drop the `{mark}`");
        let diagnostic = Diagnostic::new(Code::E0103, span, message)
            .label(format!("no `{open}` is open here"))
            .fix(drop, span, "", Applicability::Unsafe);
        self.report(diagnostic);
    }

    /// Reports a block whose `{` is missing at `span`, where `written` may be a colon.
    pub(super) fn missing_open(&mut self, span: Span, written: &str) {
        let start = span.range().start;
        self.unopened.push(start);
        let index = self.tokens.partition_point(|token| token.end <= start);
        let before = self.tokens.get(..index).unwrap_or_default().iter();
        let before = before.rev().find(|token| token.kind != Kind::Comment);
        let diagnostic = match before {
            Some(before) if written.is_empty() => {
                let place = Span::new(self.file, before.start, before.end);
                let word = before.of(self.text);
                let message = format!("expected `{{` after `{word}`");
                let diagnostic =
                    Diagnostic::new(Code::E0101, place, message).label("expected `{` after this");
                if let Some(form) = self.opened(word, start) {
                    self.report(diagnostic.help(format!("its form is `{form}`")));
                    return;
                }
                diagnostic
            }
            _ => Diagnostic::new(
                Code::E0101,
                span,
                format!("expected `{{`, found `{written}`"),
            )
            .label("expected `{`"),
        };
        self.report(diagnostic.help("a block stands in braces: `{ … }`"));
    }

    /// How what begins with `word` is written, where what follows at byte `at` on its line shows that it was meant
    /// otherwise.
    fn opened(&self, word: &str, at: usize) -> Option<String> {
        let next = self.token_at(at)?;
        let line = self.text.get(..at)?.rsplit('\n').next()?;
        let same_line = self
            .text
            .get(at..next.start)
            .is_some_and(|gap| !gap.contains('\n'));
        let counted = matches!(word, "retry" | "repeat" | "timeout" | "parallel");
        if counted && same_line && next.kind == Kind::Number {
            let rest = self.text.get(next.start..)?.lines().next()?;
            let rest = rest.split(['{', '}', ',', ')', '(']).next()?;
            let mut words = rest.split_whitespace();
            let (number, unit) = (words.next()?, words.next());
            // A unit may stand apart from its number; what else follows is the child.
            let unit = unit.filter(|unit| word == "timeout" && UNITS.contains(unit));
            let amount = unit.map_or(number.to_owned(), |unit| format!("{number} {unit}"));
            return Some(format!("{word}({amount}) {{ … }}"));
        }
        if counted && same_line && next.kind == Kind::Word {
            return Some(format!("{word}(2) {{ … }}"));
        }
        let waits = line.trim_start().starts_with("on ") && next.of(self.text) == "if";
        let family = line.contains(':');
        (waits && same_line).then(|| match family {
            true => format!("{} {{ if CONDITION {{ … }} }}", line.trim()),
            false => "on EVENT and CONDITION { … }".to_owned(),
        })
    }

    /// Reports that nothing closes the bracket `open` at byte `at`.
    fn missing_close(&mut self, at: usize, open: Option<Span>) {
        if self.is_reported(at) {
            return;
        }
        self.failed_at = Some(at);
        // Where a `{` is missing within, the `}` of that block closed this one.
        let from = open.map_or(0, |open| open.range().start);
        if let Some(found) = self.unopened.iter().position(|start| *start >= from) {
            self.unopened.remove(found);
            return;
        }
        if let Some(open) = open {
            self.lose_lets(open.range().end, at);
            let diagnostic = brackets::unclosed(self.file, self.text, self.tokens, open, at);
            self.report(diagnostic);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::FileId;
    use crate::syntax::comments::comments;
    use crate::syntax::tokens::tokens;

    const TEXTS: [&str; 3] = [
        include_str!("../../../examples/delivery_small.bt"),
        include_str!("../../../examples/delivery_large.bt"),
        include_str!("../../../examples/grasp.bt"),
    ];

    /// What of a text is enough to fail on an item or an entry fails as the whole of it, wherever a line begins and
    /// whichever token is left out.
    #[test]
    fn a_text_fails_among_its_neighbours_as_it_does_as_a_whole() {
        let rules = [
            Rule::strict_item,
            Rule::strict_world_entry,
            Rule::strict_clause,
            Rule::strict_aspect,
            Rule::strict_reward,
            Rule::strict_child,
            Rule::strict_stmt,
        ];
        let (mut failures, mut near) = (0, 0);
        for whole in TEXTS {
            for dropped in tokens(whole).iter().step_by(11) {
                let text = [&whole[..dropped.start], &whole[dropped.end..]].concat();
                let tokens = tokens(&text);
                let comments = comments(FileId(0), &text, &tokens);
                let builder = Builder::new(FileId(0), &text, &tokens, &comments);
                let begins_line = |at: &usize| {
                    let before = text[..*at].trim_end_matches(' ');
                    before.is_empty() || before.ends_with('\n')
                };
                let begins = tokens.iter().map(|token| token.start).filter(begins_line);
                for (at, rule) in begins.step_by(3).zip(rules.into_iter().cycle()) {
                    let seen = builder.failure_among(24, rule, at, at);
                    let all = at..text.len();
                    let Some(whole) = builder.failure_within(rule, all, at) else {
                        continue;
                    };
                    assert_eq!(
                        (seen.at, seen.expected),
                        (whole.at, whole.expected),
                        "{text}"
                    );
                    failures += 1;
                    let first = tokens.partition_point(|token| token.start < at);
                    near += usize::from(
                        tokens
                            .get(first + 24)
                            .is_some_and(|end| whole.at < end.start),
                    );
                }
            }
        }
        assert!(
            failures > 1000 && near > 500,
            "{failures} failures, {near} near"
        );
    }
}
