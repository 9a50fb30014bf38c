//! Marks and words that stand where nothing belongs: a colon before a block, an `if` before a guard, a full stop, a `?`.

use super::Place;
use super::words::is_word;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, Token};

impl Place<'_> {
    /// A mark or a word too many, or another one than belongs there.
    pub(super) fn misplaced_mark(&self) -> Option<Diagnostic> {
        self.marked_block()
            .or_else(|| self.asked_guard())
            .or_else(|| self.full_stop())
            .or_else(|| self.question())
            .or_else(|| self.otherwise_by_mark())
            .or_else(|| self.compared_tick())
            .or_else(|| self.arrow_to_coordinate())
            .or_else(|| self.remainder())
            .or_else(|| self.declared_again())
    }

    /// `if touching: {`, `on EVENT: {`: a colon before the `{` of a block.
    fn marked_block(&self) -> Option<Diagnostic> {
        let colon = self.before.filter(|mark| mark.of(self.text) == ":")?;
        let block = self.found() == "{" && self.wanted().is_none() && self.same_line_as_before();
        block.then(|| self.too_much(colon, "no `:` stands before a block"))
    }

    /// `if low => goto(charger)` among the children of a node.
    fn asked_guard(&self) -> Option<Diagnostic> {
        if self.failure.strict != Rule::strict_child || !self.begins_with("if") {
            return None;
        }
        let first = self.begins()?;
        let rest = self.text.get(first.end..)?.lines().next()?;
        let guards = rest.contains("=>") && !rest.contains('{');
        guards.then(|| self.too_much(first, "a guard begins with its condition"))
    }

    /// `goto(exit).` at the end of the children of a node.
    fn full_stop(&self) -> Option<Diagnostic> {
        if self.failure.strict != Rule::strict_child {
            return None;
        }
        let stop = [self.before, Some(self.found)].into_iter().flatten();
        let mut stop = stop.filter(|mark| mark.of(self.text) == ".");
        let stop = stop.next()?;
        let rest = self
            .text
            .get(stop.end..)?
            .lines()
            .next()
            .unwrap_or_default();
        let ends = rest
            .split("//")
            .next()
            .is_some_and(|rest| rest.trim().is_empty());
        ends.then(|| self.too_much(stop, "nothing ends with a `.`"))
    }

    /// `held == bolt?`: a question mark that begins no choice.
    fn question(&self) -> Option<Diagnostic> {
        let mark = self.before.filter(|mark| mark.of(self.text) == "?")?;
        self.parted(mark, self.found)
            .then(|| self.too_much(mark, "a condition is asked without `?`"))
    }

    /// `charge ? patrol` among the children of a node.
    fn otherwise_by_mark(&self) -> Option<Diagnostic> {
        if self.failure.strict != Rule::strict_child || !self.expects(Rule::colon) {
            return None;
        }
        let within = |token: &&Token| (self.failure.start..self.found.start).contains(&token.start);
        let mut tokens = self.tokens.iter().filter(within);
        let mark = *tokens.find(|token| token.of(self.text) == "?")?;
        Some(
            Diagnostic::new(Code::E0101, self.span_of(mark), "`?` joins no nodes")
                .label("not said here")
                .help("one if the other fails: `selector { …, … }`"),
        )
    }

    /// `tick == charge` in a test.
    fn compared_tick(&self) -> Option<Diagnostic> {
        if self.failure.strict != Rule::strict_test_entry || !self.begins_with("tick") {
            return None;
        }
        let within = |token: &&Token| (self.failure.start..self.found.start).contains(&token.start);
        let mut tokens = self.tokens.iter().filter(within);
        let sign = *tokens.find(|token| token.of(self.text) == "==")?;
        self.told(self.span_of(sign), "what is expected follows `=>`", "=>")
    }

    /// `ball->x`
    fn arrow_to_coordinate(&self) -> Option<Diagnostic> {
        let next = self.next()?;
        let coordinate = self.found() == "->"
            && self.before.is_some_and(|name| name.end == self.found.start)
            && matches!(next.of(self.text), "x" | "y");
        coordinate
            .then(|| self.told(self.span(), "a coordinate follows a `.`", "."))
            .flatten()
    }

    /// `a mod b`
    fn remainder(&self) -> Option<Diagnostic> {
        let named = |token: &Token| matches!(token.of(self.text), "mod" | "rem" | "div");
        let word = self
            .before
            .filter(named)
            .or(Some(self.found).filter(named))?;
        let value = match word.start == self.found.start {
            true => self.same_line_as_before(),
            false => matches!(self.found.kind, Kind::Number | Kind::Word),
        };
        let span = self.span_of(word);
        let message = format!("`{}` is no operator here", word.of(self.text));
        value.then(|| {
            Diagnostic::new(Code::E0110, span, message)
                .label("the language has no remainder")
                .help("an angle is brought back to ±180° by `wrap(…)`")
        })
    }

    /// `state load += 1` in an effect: what is declared already is set by its name.
    fn declared_again(&self) -> Option<Diagnostic> {
        let (word, name) = match self.found() {
            "state" | "local" | "var" => (self.found, self.next()?),
            _ => (self.second_before?, self.before?),
        };
        let at = self.tokens.partition_point(|token| token.end <= name.end);
        let sign = self.tokens.get(at)?;
        let sets = matches!(sign.of(self.text), "+=" | "-=" | "*=" | "/=");
        let declares = matches!(word.of(self.text), "state" | "local" | "var");
        let statement =
            self.failure.strict == Rule::strict_stmt && word.start == self.failure.start;
        (sets && declares && statement && is_word(name))
            .then(|| self.too_much(word, "what is set is called by its name alone"))
    }

    /// A value that is missing at the end of a line, so that the word of the next entry was read as that value.
    pub(super) fn cut_before_entry(&self) -> Option<(Token, Diagnostic)> {
        let (last, word) = (self.second_before?, self.before?);
        let open = matches!(
            last.of(self.text),
            "=" | "," | "not" | "and" | "or" | "+" | "-" | "*"
        );
        let entry = match self.failure.strict {
            Rule::strict_clause => matches!(
                word.of(self.text),
                "local" | "requires" | "succeed" | "fail" | "control"
            ),
            Rule::strict_test_entry => word.of(self.text) == "tick",
            _ => false,
        };
        if !open || !entry || !self.parted(last, word) {
            return None;
        }
        let comma = last.of(self.text) == ",";
        let diagnostic = match comma {
            true => self.too_much(last, "nothing follows this `,`"),
            false => self.after(last, "a value", "line"),
        };
        Some((last, diagnostic))
    }

    /// A token that is to be dropped, with the blanks behind it.
    fn too_much(&self, token: Token, message: &str) -> Diagnostic {
        let rest = self.text.get(token.end..).unwrap_or_default();
        let blanks = rest.len() - rest.trim_start_matches([' ', '\t']).len();
        let is_word = token.kind == Kind::Word;
        let end = if is_word {
            token.end + blanks
        } else {
            token.end
        };
        let word = token.of(self.text);
        Diagnostic::new(Code::E0101, self.span_of(token), message)
            .label(format!("drop `{word}`"))
            .fix(
                format!("drop the `{word}`"),
                Span::new(self.file, token.start, end),
                "",
                Applicability::Unsafe,
            )
    }
}
