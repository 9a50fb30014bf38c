//! Lines of another habit whose right form is plain: what is told has the whole of it to take over.

use super::Place;
use super::units::no_such_unit;
use super::words::is_word;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, Token};
use crate::syntax::words::{CALLED, NODES, RANGING, TYPES, UNITS};

/// The words that declare one name.
const DECLARING: [&str; 5] = ["event", "predicate", "behavior", "task", "tree"];

/// What other languages call the way that a robot stands in a place.
const WAYS: [&str; 6] = [
    "heading",
    "orientation",
    "rotation",
    "yaw",
    "direction",
    "angle",
];

impl Place<'_> {
    /// A line that was written by another habit, with its right form.
    pub(super) fn rewritten(&self) -> Option<Diagnostic> {
        self.spaced_name()
            .or_else(|| self.typed_first())
            .or_else(|| self.filtered_binder())
            .or_else(|| self.typed_binder())
            .or_else(|| self.unset_start())
            .or_else(|| self.turned_place())
            .or_else(|| self.indexed())
            .or_else(|| self.bracketed_for())
            .or_else(|| self.chosen_backwards())
            .or_else(|| self.unparted_price())
            .or_else(|| self.other_length())
            .or_else(|| self.ended_by_time())
            .or_else(|| self.other_probability())
            .or_else(|| self.bare_point())
            .or_else(|| self.typed_item())
            .or_else(|| self.listed_condition())
            .or_else(|| self.reactive())
            .or_else(|| self.spare())
            .or_else(|| self.in_pieces())
    }

    /// `reactive selector`
    fn reactive(&self) -> Option<Diagnostic> {
        let word = self.before?;
        let is_reactive = matches!(word.of(self.text), "reactive" | "Reactive");
        let node = matches!(self.found(), "selector" | "sequence");
        (is_reactive && node).then(|| {
            let gap = self.span_of(word).start..self.span().start;
            let message = "without `memory` a node asks all its children anew in every tick";
            Diagnostic::new(Code::E0101, self.span_of(word), message)
                .label("every node does so")
                .fix(
                    format!("drop `{}`", word.of(self.text)),
                    Span {
                        end: gap.end,
                        ..self.span_of(word)
                    },
                    "",
                    Applicability::Safe,
                )
        })
    }

    /// `with prob >= 90%`
    fn other_probability(&self) -> Option<Diagnostic> {
        let word = self.next()?;
        let claim = self.found() == "with" && self.line_begins_with("claim");
        let said = matches!(word.of(self.text), "prob" | "p" | "P" | "chance");
        (claim && said)
            .then(|| {
                self.told(
                    self.span_of(word),
                    "a claim says a probability",
                    "probability",
                )
            })
            .flatten()
    }

    /// `position = 1 m, 3 m`
    fn bare_point(&self) -> Option<Diagnostic> {
        let start = matches!(
            self.failure.strict,
            Rule::strict_start_line | Rule::strict_stmt | Rule::strict_item
        );
        let index = self
            .tokens
            .partition_point(|token| token.start < self.failure.start);
        let comma = index
            .checked_sub(1)
            .and_then(|index| self.tokens.get(index).copied());
        let follows = comma.is_some_and(|comma| comma.of(self.text) == ",");
        let number = self.before() == "," && self.found.kind == Kind::Number;
        // `2,5 m` is a decimal fraction.
        let fraction = comma.is_some_and(|comma| comma.end == self.found.start);
        if fraction
            || !start
            || !(number || follows && self.failure.strict == Rule::strict_start_line)
        {
            return None;
        }
        let head = self.text.get(..self.failure.start)?;
        let line = head.rfind('\n').map_or(0, |at| at + 1);
        let mark = head.get(line..)?.find('=')? + line + 1;
        let from = head.len() - head.get(mark..)?.trim_start().len();
        let end = self.failure.start + self.rest_of_line(self.failure.start).len();
        let value = self.text.get(from..end)?;
        let span = Span::new(self.file, from, end);
        let mut depth = 0_i32;
        let mut commas = 0;
        for letter in value.chars() {
            match letter {
                '(' => depth += 1,
                ')' => depth -= 1,
                ',' if depth == 0 => commas += 1,
                _ => {}
            }
        }
        let plain = depth == 0 && commas == 1 && !value.contains(['{', '}', '<', '>']);
        // `pose = roof, 90 deg`
        if let Some((place, way)) = value.split_once(',')
            && plain
            && place.starts_with(|letter: char| letter.is_ascii_alphabetic())
            && ["deg", "rad"]
                .iter()
                .any(|unit| way.trim_end().ends_with(unit))
        {
            let mark = from + place.len();
            let comma = Span::new(self.file, mark, mark + 1);
            return Some(
                Diagnostic::new(
                    Code::E0101,
                    comma,
                    "the heading is set by a line of its own",
                )
                .label("nothing follows the place")
                .fix(
                    "write `heading =`",
                    comma,
                    " heading =",
                    Applicability::Unsafe,
                ),
            );
        }
        plain
            .then(|| self.told(span, "a point stands in parentheses", format!("({value})")))
            .flatten()
    }

    /// `predicate low: bool = …`, `event empty: bool = …`
    fn typed_item(&self) -> Option<Diagnostic> {
        let (word, name) = (self.second_before?, self.before?);
        let ty = self.next()?;
        let (what, label) = match word.of(self.text) {
            "predicate" => ("a predicate has no type", "it holds or does not"),
            "event" => ("an event has no type", "it happens or does not"),
            _ => return None,
        };
        let typed = self.found() == ":" && is_word(ty);
        let rest = self.text.get(ty.end..)?.trim_start();
        let whole = rest.starts_with('=') && !rest.starts_with("==");
        (typed && whole).then(|| {
            let span = self.span().to(self.span_of(ty));
            Diagnostic::new(Code::E0101, span, what).label(label).fix(
                format!("drop `{}`", self.text.get(span.range()).unwrap_or_default()),
                self.span_of(name).after().to(span),
                "",
                Applicability::Unsafe,
            )
        })
    }

    /// `succeed when a, b`
    fn listed_condition(&self) -> Option<Diagnostic> {
        let comma = self.before?;
        let clause = ["requires", "succeed", "fail", "event", "predicate"];
        let listed = matches!(self.failure.strict, Rule::strict_clause | Rule::strict_item)
            && self.open().is_none_or(|open| open.of(self.text) == "{")
            && comma.of(self.text) == ","
            && self.found.kind != Kind::Number
            && self.same_line_as_before()
            && clause.iter().any(|word| self.line_begins_with(word));
        listed.then(|| {
            let span = self.span_of(comma);
            if let Some(kind) = DECLARING.iter().find(|word| self.line_begins_with(word))
                && !self.begun().contains('=')
            {
                let place = span.to(self.span().before());
                return Diagnostic::new(
                    Code::E0101,
                    span,
                    "each name has a declaration of its own",
                )
                .label("a second name follows")
                .fix(
                    format!("begin a line with `{kind}`"),
                    place,
                    format!("\n{kind} "),
                    Applicability::Unsafe,
                );
            }
            Diagnostic::new(Code::E0101, span, "conditions are joined by `and` or `or`")
                .label("a comma joins nothing here")
                .fix(
                    "if both must hold, write `and`",
                    span,
                    " and",
                    Applicability::Unsafe,
                )
        })
    }

    /// A line that lacks what stands before its last word or number.
    pub(super) fn cut_form(&self) -> Option<Diagnostic> {
        let (sign, last) = (self.second_before?, self.before?);
        if self.parted(sign, last) {
            return None;
        }
        let number = last.kind == Kind::Number || UNITS.contains(&last.of(self.text));
        if self.failure.strict == Rule::strict_reward
            && number
            && matches!(sign.of(self.text), "-" | "+")
        {
            let span = self.span_of(sign).to(self.span_of(last));
            return Some(
                Diagnostic::new(Code::E0101, span, "a `:` is missing before the number")
                    .label("what is paid")
                    .fix(
                        "put a `:`",
                        self.before_gap(sign),
                        ":",
                        Applicability::Unsafe,
                    ),
            );
        }
        let of_robot = matches!(
            self.failure.strict,
            Rule::strict_robot_entry | Rule::strict_world_entry
        );
        let is_unit = UNITS.contains(&last.of(self.text));
        (of_robot && sign.kind == Kind::Number && is_word(last) && !is_unit)
            .then(|| no_such_unit(self.span_of(last), last.of(self.text), &[]))
    }

    /// The place right behind the token before this one.
    fn before_gap(&self, token: Token) -> Span {
        let text = self.text.get(..token.start).unwrap_or_default();
        let end = text.trim_end().len();
        Span::new(self.file, end, end)
    }

    pub(super) fn told(
        &self,
        span: Span,
        message: impl Into<String>,
        right: impl Into<String>,
    ) -> Option<Diagnostic> {
        let right = right.into();
        Some(Diagnostic::new(Code::E0101, span, message).write(span, right, Applicability::Unsafe))
    }

    /// The rest of the line from byte `at` on, without a comment.
    pub(super) fn rest_of_line(&self, at: usize) -> &str {
        let rest = self.text.get(at..).unwrap_or_default();
        let line = rest.lines().next().unwrap_or_default();
        line.split("//").next().unwrap_or_default().trim_end()
    }

    /// What stands between the bracket that was found and the next one that closes, in the same line; with the span of both.
    fn within(&self, close: char) -> Option<(&str, Span)> {
        let (inner, _) = self.rest_of_line(self.found.end).split_once(close)?;
        let end = self.found.end + inner.len() + close.len_utf8();
        Some((inner, Span::new(self.file, self.found.start, end)))
    }

    /// `predicate near goal = …`: a name of two words.
    fn spaced_name(&self) -> Option<Diagnostic> {
        let (word, name) = (self.second_before?, self.before?);
        let starts = [word.start, self.found.start].contains(&self.failure.start);
        let declares = DECLARING.contains(&word.of(self.text)) && starts;
        let follows = matches!(self.after_found(), "=" | "(" | ":" | "{");
        let words = is_word(name) && is_word(self.found) && self.same_line_as_before();
        let keyword = matches!(self.found(), "for" | "of" | "if" | "when");
        // Of `tree hand selector {` and `behavior fetch goto(A)` the `=` is missing.
        let is_node = NODES.iter().any(|(node, _)| *node == self.found());
        let gives = match (word.of(self.text), self.after_found()) {
            ("tree", "{") if is_node => Some("gives a tree its node"),
            ("behavior", "(") if CALLED.contains(&self.found()) => {
                Some("gives a behaviour what it stands for")
            }
            ("event" | "predicate", "(") if CALLED.contains(&self.found()) => {
                Some("gives a name its condition")
            }
            _ => None,
        };
        if let Some(gives) = gives {
            let gap = self.span_of(name).after();
            return Some(
                Diagnostic::new(Code::E0101, self.span(), format!("`=` {gives}"))
                    .label("a `=` is missing before this")
                    .fix("put a `=`", gap, " =", Applicability::Safe),
            );
        }
        if !(declares && follows && words) || keyword || self.parted(word, name) {
            return None;
        }
        let span = self.span_of(name).to(self.span());
        let is_task = self.glance.declares_by(&["task"], self.found());
        if matches!(word.of(self.text), "tree" | "learn") && is_task {
            let right = format!("{} for {}", name.of(self.text), self.found());
            return self.told(span, "its task follows `for`", right);
        }
        let joined = format!("{}_{}", name.of(self.text), self.found());
        self.told(span, "a name is one word", joined)
    }

    /// `predicate near(place p) = …`: a parameter with its type before it.
    fn typed_first(&self) -> Option<Diagnostic> {
        let (opens, ty) = (self.second_before?, self.before?);
        let begins = matches!(opens.of(self.text), "(" | ",");
        let declares = self.expects(Rule::colon) && is_word(ty) && is_word(self.found);
        let ends = matches!(self.after_found(), ")" | "," | "=");
        if !(begins && declares && ends && self.same_line_as_before()) {
            return None;
        }
        let span = self.span_of(ty).to(self.span());
        let is_type = |word: &str| TYPES.contains(&word) || self.glance.is_kind(word);
        if is_type(self.found()) && !is_type(ty.of(self.text)) {
            let right = format!("{}: {}", ty.of(self.text), self.found());
            return self.told(span, "a `:` parts a parameter from its type", right);
        }
        let right = format!("{}: {}", self.found(), ty.of(self.text));
        self.told(span, "the name of a parameter goes before its type", right)
    }

    /// `any(b in bush if ripe(b))`: a condition behind a binder without its `:`.
    fn filtered_binder(&self) -> Option<Diagnostic> {
        let open = self.open().filter(|_| self.found() == ")")?;
        let at = self.tokens.partition_point(|it| it.end <= open.end);
        let [name, of, kind, word] = self.tokens.get(at..at + 4)? else {
            return None;
        };
        let binds = is_word(*name) && is_word(*kind) && of.of(self.text) == "in";
        if !binds || !matches!(word.of(self.text), "if" | "where" | "when") {
            return None;
        }
        let (gap, word) = (self.span_of(*kind).after(), self.span_of(*word));
        Some(
            Diagnostic::new(Code::E0101, word, "what is asked of each follows a `:`")
                .label("write `:`")
                .fix("put a `:`", gap.to(word), ":", Applicability::Unsafe),
        )
    }

    /// `any(b: bed: ripe(b))`: a binder that is written as a parameter is.
    fn typed_binder(&self) -> Option<Diagnostic> {
        let open = self.open().filter(|_| self.found() == ":")?;
        let at = self.tokens.partition_point(|it| it.end <= open.end);
        let [name, colon, kind] = self.tokens.get(at..at + 3)? else {
            return None;
        };
        let ranges = at
            .checked_sub(2)
            .and_then(|at| self.tokens.get(at))
            .is_some_and(|word| RANGING.contains(&word.of(self.text)));
        let typed = is_word(*name) && colon.of(self.text) == ":" && is_word(*kind);
        if !ranges || !typed || self.before?.start != kind.start {
            return None;
        }
        let gap = self.span_of(*name).after().to(self.span_of(*kind).before());
        let message = "what ranges over a kind binds a name: `x in KIND: …`";
        Some(
            Diagnostic::new(Code::E0127, self.span_of(*colon), message)
                .label("write `in`")
                .fix("write `in`", gap, " in ", Applicability::Safe),
        )
    }

    /// `pose anywhere`: a line of a start without its `=`.
    fn unset_start(&self) -> Option<Diagnostic> {
        let name = self.before?;
        let first = name.start == self.failure.start && is_word(name);
        let value = is_word(self.found) || self.found.kind == Kind::Number;
        let is_line = self.failure.strict == Rule::strict_start_line && self.expects(Rule::is);
        (is_line && first && value && self.same_line_as_before()).then(|| {
            let message = format!("a `=` is missing before `{}`", self.found());
            Diagnostic::new(Code::E0101, self.span(), message)
                .label("what this line sets begins here")
                .fix(
                    "put a `=`",
                    self.span_of(name).after(),
                    " =",
                    Applicability::Safe,
                )
        })
    }

    /// `place A = disc(…) heading -90 deg`
    fn turned_place(&self) -> Option<Diagnostic> {
        let begins = |token: &Token| token.kind == Kind::Number || token.of(self.text) == "-";
        let (close, word) = match self.next().filter(begins) {
            Some(_) if WAYS.contains(&self.found()) => (self.before?, self.found),
            _ => (self.second_before?, self.before?),
        };
        let is_place = self.failure.strict == Rule::strict_world_entry;
        let way = WAYS.contains(&word.of(self.text)) && close.of(self.text) == ")";
        let follows = self.tokens.iter().find(|token| token.start >= word.end);
        let begins = follows.is_some_and(begins);
        if !(is_place && way && begins) || self.parted(close, word) {
            return None;
        }
        let message = "the way that a robot stands in a place is its `facing`";
        self.told(self.span_of(word), message, "facing")
    }

    /// What stands on the line before what was found.
    pub(super) fn begun(&self) -> &str {
        let head = self.text.get(..self.found.start).unwrap_or_default();
        head.rsplit('\n').next().unwrap_or_default()
    }

    /// `waiting[b]`, `position[0]`: arguments and coordinates have no square brackets.
    fn indexed(&self) -> Option<Diagnostic> {
        let name = self.before?;
        let reads = is_word(name) || name.of(self.text) == ")";
        if self.found() != "[" || name.end != self.found.start || !reads {
            return None;
        }
        let (inner, span) = self.within(']')?;
        if inner.contains('[') {
            return None;
        }
        if self
            .second_before
            .is_some_and(|mark| mark.of(self.text) == ":")
        {
            return Some(
                Diagnostic::new(Code::E0101, span, "there are no lists")
                    .label("one value has one type")
                    .help("a value for each member of a kind is a family: `state NAME(x: KIND): TYPE = …`"),
            );
        }
        match inner.trim() {
            "0" => self.told(span, "the first coordinate of a point is `x`", ".x"),
            "1" => self.told(span, "the second coordinate of a point is `y`", ".y"),
            inner => self.told(span, "arguments stand in parentheses", format!("({inner})")),
        }
    }

    /// `for (b in bed) { … }`
    fn bracketed_for(&self) -> Option<Diagnostic> {
        if self.found() != "(" || self.before() != "for" {
            return None;
        }
        let (inner, span) = self.within(')')?;
        let plain = inner.contains(" in ") && !inner.contains(['(', ';', ':']);
        let right = inner.trim().trim_start_matches("var ").to_owned();
        plain
            .then(|| self.told(span, "no parentheses follow `for`", right))
            .flatten()
    }

    /// `a if c else b`
    fn chosen_backwards(&self) -> Option<Diagnostic> {
        let asks = match self.found() {
            "if" if self.same_line_as_before() => self.found,
            // `a = b if c` is a statement with another behind it.
            "else" => self.before_on_line("if")?,
            _ => return None,
        };
        let head = self.text.get(..asks.start)?;
        let mark = self.value_begins_behind(asks)?.end;
        let value = head.get(mark..)?.trim();
        let rest = self.rest_of_line(asks.end);
        let (asked, behind) = rest.split_once(" else ")?;
        let own = own(behind);
        let other = own.trim();
        if value.is_empty() || other.is_empty() || other.contains(['{', ';']) {
            return None;
        }
        let start = head.len() - head.get(mark..)?.trim_start().len();
        let end = asks.end + rest.len() - behind.len() + own.trim_end().len();
        if value.contains(['{', '}']) || asked.contains('{') {
            return None;
        }
        let right = format!("if {} {{ {value} }} else {{ {other} }}", asked.trim());
        let span = Span::new(self.file, start, end);
        self.told(span, "the condition of a choice goes first", right)
    }

    /// The last token of this spelling before the one that was found, on its line and not at its beginning.
    fn before_on_line(&self, word: &str) -> Option<Token> {
        let end = self
            .tokens
            .partition_point(|token| token.start < self.found.start);
        let line = self.tokens.get(..end)?.iter().rev();
        let before = self.text.get(..self.found.start)?;
        let begins = before.rfind('\n').map_or(0, |at| at + 1);
        let mut line = line.take_while(|token| token.start >= begins);
        let token = line.find(|token| token.of(self.text) == word)?;
        let head = self.text.get(..token.start)?;
        let begins = head
            .trim_end_matches([' ', '\t'])
            .ends_with(['\n', '{', '}']);
        (!begins).then_some(*token)
    }

    /// The mark behind which the value before a token begins.
    fn value_begins_behind(&self, end: Token) -> Option<Token> {
        let mut closed = 0_usize;
        let last = self.tokens.partition_point(|token| token.start < end.start);
        for token in self.tokens.get(..last)?.iter().rev() {
            match token.of(self.text) {
                ")" | "]" => closed += 1,
                "(" | "[" if closed > 0 => closed -= 1,
                "(" | "[" | "{" | "," | ":" | "=" | "+=" | "-=" | "*=" | "/=" | ":="
                    if closed == 0 =>
                {
                    return Some(*token);
                }
                _ => {}
            }
        }
        None
    }

    /// `while hot per 1 min: -0.2`
    fn unparted_price(&self) -> Option<Diagnostic> {
        let price = self.failure.strict == Rule::strict_reward && self.line_begins_with("while");
        let comma = self.before.map(|before| self.span_of(before).after())?;
        (price && self.found() == "per" && self.expects(Rule::comma)).then(|| {
            Diagnostic::new(Code::E0112, self.span(), "a comma is missing before `per`")
                .label("the price begins here")
                .fix("put a comma", comma, ",", Applicability::Safe)
        })
    }

    /// `episodes = 800, 10 min`, `episodes = 800 x 10 min`
    fn other_length(&self) -> Option<Diagnostic> {
        let of_learner = self.failure.strict == Rule::strict_learn_entry;
        if !of_learner || !self.line_begins_with("episodes") {
            return None;
        }
        let message = "how long an episode is follows `of`";
        match self.found() {
            "x" | "for" | "*" => self.told(self.span(), message, "of"),
            // `2,000` is one number.
            _ if self.grouped_digits().is_some() => None,
            _ if self.before() == "," && self.found.kind == Kind::Number => {
                let comma = self.before?;
                self.told(self.span_of(comma), message, " of")
            }
            _ => None,
        }
    }

    /// `fail after 5 s`
    fn ended_by_time(&self) -> Option<Diagnostic> {
        let clause = self.failure.strict == Rule::strict_clause;
        let ends = matches!(self.before(), "fail" | "succeed") && self.found() == "after";
        let message = "how long a behaviour has been running is asked of `elapsed`";
        (clause && ends)
            .then(|| self.told(self.span(), message, "when elapsed >"))
            .flatten()
    }
}

/// The part of a text up to the comma or the bracket that belongs to what stands around it.
fn own(text: &str) -> &str {
    let mut open = 0_usize;
    let ends = text.char_indices().find(|(_, letter)| {
        match letter {
            '(' | '{' => open += 1,
            ')' | '}' if open > 0 => open -= 1,
            ')' | '}' => return true,
            ',' => return open == 0,
            _ => {}
        }
        false
    });
    let end = ends.map_or(text.len(), |(at, _)| at);
    text.get(..end).unwrap_or(text)
}
