//! What is missing between two entries and looks like a comma: quotes, brackets, an arrow, a word that joins.

use super::Builder;
use super::number::rates;
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::Span;
use crate::spelling::RESERVED;
use crate::syntax::diagnose::{no_such_unit, one_unit, unit_of_a_point};
use crate::syntax::tokens::is_blank;
use crate::syntax::words::{CALLED, DRIVING, NODES, UNITS};

/// What declares the leaves of trees.
const LEAVES: [&str; 2] = ["behavior", "tree"];

/// What other notations put before the nodes of a tree.
const BEFORE_NODES: [&str; 28] = [
    "is",
    "reactive",
    "async",
    "subtree",
    "SubTree",
    "Subtree",
    "SubTreePlus",
    "when",
    "while",
    "case",
    "action",
    "condition",
    "do",
    "run",
    "then",
    "execute",
    "check",
    "call",
    "node",
    "return",
    "await",
    "yield",
    "perform",
    "go",
    "try",
    "always",
    "exec",
    "start",
];

impl<'i> Builder<'i> {
    /// Reports a name with a blank in it that lacks its backquotes.
    pub(super) fn missing_quotes(&mut self, before: Option<Span>, next: Span) -> bool {
        let Some(before) = before.filter(|before| self.on_one_line(*before, next)) else {
            return false;
        };
        let word = self.slice(before).rsplit(' ').next().unwrap_or_default();
        let name = [word, self.slice(next)].join(" ");
        if !self.glance().quotes(&name) {
            return false;
        }
        let start = before.range().end - word.len();
        let place = Span::new(self.file, start, next.range().end);
        let message = format!("the name `{name}` lacks its backquotes");
        let diagnostic = Diagnostic::new(Code::E0101, place, message).write(
            place,
            format!("`{name}`"),
            Applicability::Safe,
        );
        self.report(diagnostic);
        true
    }

    /// Reports a `(` that is missing behind a name: of `sees door)`.
    pub(super) fn missing_paren(&mut self, before: Option<Span>, next: Span) -> bool {
        let Some(before) = before.filter(|before| self.on_one_line(*before, next)) else {
            return false;
        };
        let closes = self.token_at(next.range().end);
        if closes.is_none_or(|token| token.of(self.text) != ")") {
            return false;
        }
        let message = format!("`(` is missing before `{}`", self.slice(next));
        let gap = before.after().to(next.before());
        let diagnostic = Diagnostic::new(Code::E0101, next, message)
            .label("the arguments of a name stand in parentheses")
            .fix("put a `(`", gap, "(", Applicability::Unsafe);
        self.report(diagnostic);
        true
    }

    /// Reports a `=>` that is missing on one line between a condition and what it guards, which begins with `next`.
    pub(super) fn missing_arrow(&mut self, before: Option<Span>, next: Span) -> bool {
        let Some(before) = before.filter(|before| self.on_one_line(*before, next)) else {
            return false;
        };
        let (asked, runs) = (self.slice(before), self.slice(next));
        let head = asked.split('(').next().unwrap_or_default();
        let is_joined = (asked.split(' ')).any(|word| matches!(word, "and" | "or" | "not"));
        let is_condition = is_joined || self.glance().declares_by(&["predicate"], head);
        let is_node = runs == "memory" || NODES.iter().any(|(node, _)| *node == runs);
        let is_child = is_node || self.names_leaf(runs);
        if asked.contains(['=', '{']) || !is_condition || !is_child {
            return false;
        }
        let message = format!("`=>` is missing before `{runs}`");
        let diagnostic = Diagnostic::new(Code::E0116, next, message)
            .label(format!("what `{asked}` guards"))
            .fix("put `=>`", before.after(), " =>", Applicability::Unsafe)
            .help("two children of their own are parted by a comma");
        self.report(diagnostic);
        true
    }

    /// Reports an `and` or an `or` that is missing on one line between two conditions. Parted by a comma they would be two children,
    /// and where the first holds nothing would be done.
    pub(super) fn missing_joint(&mut self, before: Option<Span>, next: Span) -> bool {
        let Some(before) = before.filter(|before| self.on_one_line(*before, next)) else {
            return false;
        };
        let (asked, also) = (self.slice(before), self.slice(next));
        let last = asked.rsplit(' ').next().unwrap_or_default();
        let head = last.split('(').next().unwrap_or_default();
        let is_predicate = |name| self.glance().declares_by(&["predicate"], name);
        let negated = also == "not" && !asked.contains(['=', '{']);
        if !is_predicate(head) || !negated && !is_predicate(also) {
            return false;
        }
        let message = format!("expected `and` or `or` before `{also}`");
        let diagnostic = Diagnostic::new(Code::E0101, next, message)
            .label(format!("another condition, behind `{last}`"))
            .help("two children of their own are parted by a comma");
        self.report(diagnostic);
        true
    }

    /// Whether a name is that of a behaviour or a subtree, as far as the text shows.
    pub(super) fn names_leaf(&self, name: &str) -> bool {
        DRIVING.contains(&name) || self.glance().declares_by(&LEAVES, name)
    }

    /// Reports the name of an argument behind its value: `goto(gate, 5 cm margin)`.
    pub(super) fn named_behind(&mut self, before: Option<Span>, next: Span) -> bool {
        let Some(before) = before.filter(|before| self.on_one_line(*before, next)) else {
            return false;
        };
        let (value, name) = (self.slice(before), self.slice(next));
        let rest = self.text.get(next.range().end..).unwrap_or_default();
        let ends = rest.trim_start_matches(is_blank).starts_with([',', ')']);
        let is_value = value.starts_with(|c: char| c.is_ascii_digit());
        let is_name = name.chars().all(|c| c.is_ascii_alphabetic() || c == '_');
        if !ends || !is_value || !is_name || RESERVED.contains(&name) {
            return false;
        }
        let span = before.to(next);
        let message = format!("the name `{name}` stands behind its value");
        let diagnostic = Diagnostic::new(Code::E0101, next, message)
            .label("an argument that is named begins with its name")
            .fix(
                "put it first",
                span,
                format!("{name} = {value}"),
                Applicability::Unsafe,
            );
        self.report(diagnostic);
        true
    }

    /// What is said of a word behind the number that an argument ends with: it is no unit, or one too many.
    pub(super) fn unit_behind_number(&self, before: Span, next: Span) -> Option<Diagnostic> {
        let word = self.slice(next);
        let is_word = word.chars().all(|c| c.is_ascii_alphabetic());
        let rest = self.text.get(next.range().end..).unwrap_or_default();
        let rest = rest.trim_start_matches(is_blank);
        let named = rest.starts_with(['=', '(', ':', '.']);
        if !is_word || named || RESERVED.contains(&word) || !self.on_one_line(before, next) {
            return None;
        }
        let amount = self.slice(before);
        if amount.starts_with('(') && amount.ends_with(')') && UNITS.contains(&word) {
            return Some(unit_of_a_point(next, amount, word));
        }
        let (number, unit) = amount.rsplit_once(' ').unwrap_or(("", amount));
        if unit.ends_with(|c: char| c.is_ascii_digit()) {
            return Some(no_such_unit(next, word, &[]));
        }
        let counts = number.ends_with(|c: char| c.is_ascii_digit());
        let known = UNITS.contains(&unit) && UNITS.contains(&word);
        let end = before.range().end;
        let first = Span::new(self.file, end - unit.len(), end);
        (counts && known).then(|| one_unit(self.text, first, next))
    }

    /// Reports a word between two parts of a child that is nearly one of the language: `memroy sequence`, `low adn full`.
    pub(super) fn misspelt_joint(&mut self, before: Option<Span>, next: Span) -> bool {
        let Some(before) = before else {
            return false;
        };
        if !self.on_one_line(before, next) {
            return false;
        }
        let word = self.slice(before).rsplit([' ', '(']).next();
        let word = word.unwrap_or_default();
        let end = before.range().end;
        let last = Span::new(self.file, end - word.len(), end);
        let is_node = NODES.iter().any(|(node, _)| *node == self.slice(next));
        let before_it = match is_node {
            true => ["memory"].as_slice(),
            false => &["not"],
        };
        let tried = [(last, before_it), (next, ["and", "or"].as_slice())];
        let found = tried.into_iter().find_map(|(at, words)| {
            let written = self.slice(at);
            let known = self
                .glance()
                .declares_by(&["predicate", "behavior", "tree"], written);
            let mut words = words.iter().filter(|_| !known);
            let meant = words.find(|word| suggest::is_near(written, word))?;
            Some((at, *meant))
        });
        let Some((at, meant)) = found else {
            return false;
        };
        let message = format!("expected `{meant}`, found `{}`", self.slice(at));
        let diagnostic = Diagnostic::new(Code::E0101, at, message)
            .label(format!("did you mean `{meant}`?"))
            .fix(format!("write `{meant}`"), at, meant, Applicability::Unsafe);
        self.report(diagnostic);
        true
    }

    /// Reports an argument without parentheses or a child without braces, at `next`, after the word `name`.
    pub(super) fn missing_brackets(
        &mut self,
        name: &str,
        before: Span,
        next: Span,
        what: &str,
    ) -> bool {
        if !self.on_one_line(before, next) {
            return false;
        }
        let word = name.split('(').next().unwrap_or(name);
        let found = self.slice(next);
        let is_word = found.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        let diagnostic = if NODES.iter().any(|(node, _)| *node == word) {
            let message = format!("expected `{{` after `{word}`, found `{found}`");
            let form = match word {
                "timeout" => "timeout(10 s) { … }".to_owned(),
                "retry" | "repeat" | "parallel" => format!("{word}(2) {{ … }}"),
                _ => format!("{word} {{ … }}"),
            };
            Diagnostic::new(Code::E0101, next, message)
                .label("expected `{`")
                .help(format!("its form is `{form}`"))
        } else if name == "unless" && what == "the children of a node" {
            let rest = self.text.get(next.range().end..).unwrap_or_default();
            let guards = rest.trim_start_matches(' ').starts_with("=>");
            let diagnostic =
                Diagnostic::new(Code::E0101, before, "a node does not begin with `unless`")
                    .label("this is not said here");
            match guards {
                true => diagnostic.fix("write `not`", before, "not", Applicability::Unsafe),
                false => {
                    diagnostic.help("what is done unless something holds: `not CONDITION => NODE`")
                }
            }
        } else if (BEFORE_NODES.contains(&name) || suggest::is_near(name, "while"))
            && what == "the children of a node"
        {
            Diagnostic::new(
                Code::E0101,
                before,
                format!("a node does not begin with `{name}`"),
            )
            .label("this is not said here")
            .fix(
                format!("drop `{name}`"),
                before.to(next.before()),
                "",
                Applicability::Unsafe,
            )
        } else if name == "by" {
            Diagnostic::new(Code::E0127, next, "the argument `by` is given with `=`")
                .label("write `by = …`")
                .fix("write `=`", before.after(), " =", Applicability::Safe)
        } else if is_word && self.glance().has(&format!("{name}_{found}")) {
            let right = format!("{name}_{found}");
            Diagnostic::new(Code::E0101, before.to(next), "a name is one word").write(
                before.to(next),
                right,
                Applicability::Unsafe,
            )
        } else if is_word
            && !RESERVED.contains(&found)
            && (CALLED.contains(&name)
                || self.glance().declares_called(&LEAVES, name)
                    && !self.glance().declares_by(&LEAVES, found))
        {
            Diagnostic::new(
                Code::E0101,
                next,
                format!("the arguments of `{name}` stand in parentheses"),
            )
            .label(format!("write `{name}({found})`"))
            .fix(
                format!("write `{name}({found})`"),
                before.to(next),
                format!("{name}({found})"),
                Applicability::Unsafe,
            )
        } else {
            return false;
        };
        self.report(diagnostic);
        true
    }

    /// Reports words that other languages join nodes and conditions by, and arguments that stand outside of parentheses; what
    /// begins at `place` follows what stands at `before`. Of both commas that seem to miss there, none is told.
    pub(super) fn linked(&mut self, place: Span, before: Option<Span>) -> bool {
        let Some(before) = before else {
            return false;
        };
        let next = self.slice(place);
        // Of `full => wait 2 s` the last word lacks its arguments.
        let name = self.slice(before).rsplit(' ').next().unwrap_or_default();
        if !self.on_one_line(before, place) {
            return false;
        }
        let begins_a_node = name == "then" && self.slice(before).ends_with("=> then");
        if matches!(name, "then" | "xor") && !begins_a_node {
            return true;
        }
        let head = name.split('(').next().unwrap_or_default();
        let runs = CALLED.contains(&head) || self.names_leaf(head);
        let diagnostic = match next {
            "then" if runs => Diagnostic::new(Code::E0101, place, "`then` joins no nodes")
                .label("not said here")
                .help(format!(
                    "one after the other: `memory sequence {{ {name}, … }}`"
                )),
            "of" if name == "one" => {
                let message = "a list says its entries alone";
                Diagnostic::new(Code::E0101, before.to(place), message)
                    .label("not said here")
                    .fix("drop `one of`", before.to(place), "", Applicability::Unsafe)
            }
            "then" => {
                let message = "what a condition guards follows `=>`";
                Diagnostic::new(Code::E0116, place, message).write(place, "=>", Applicability::Safe)
            }
            "xor" => Diagnostic::new(Code::E0110, place, "there is no `xor`")
                .label("conditions are joined by `and`, `or` and `not`")
                .help("one of the two, and not both: `a and not b or b and not a`"),
            "1" if UNITS.contains(&name) && self.divides(place) => {
                let rest = self.text.get(place.range().start..).unwrap_or_default();
                let slash = rest.find('/').unwrap_or_default() + 1;
                let start = before.range().end;
                let one = Span::new(self.file, start, place.range().start + slash);
                self.failed_at = Some(place.range().start + slash);
                Diagnostic::new(
                    Code::E0101,
                    place,
                    "a unit is divided by another one as it is",
                )
                .label("leave this `1` out")
                .fix("write `/` alone", one, "/", Applicability::Safe)
            }
            "1" if name.parse::<f64>().is_ok() && self.divides(place) => {
                let rest = self.text.get(place.range().start..).unwrap_or_default();
                let unit = rest.find('/').unwrap_or_default() + 1;
                let letters = rest.get(unit..).unwrap_or_default();
                let letters = letters.find(|c: char| !c.is_ascii_alphabetic() && c != ' ');
                let end = unit + letters.unwrap_or(rest.len() - unit);
                let written = rest.get(..end).unwrap_or_default().trim_end();
                let span = Span::new(self.file, place.range().start, place.range().start + end);
                self.failed_at = Some(place.range().start + end);
                Diagnostic::new(
                    Code::E0114,
                    span,
                    format!("`{written}` is not a unit of its own"),
                )
                .label("per what?")
                .help(rates(name))
            }
            _ => {
                let is_word = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
                    && !name.starts_with(|c: char| c.is_ascii_digit());
                let rest = self.text.get(place.range().start..).unwrap_or_default();
                let rest = rest.split(['\n', ',', '}']).next().unwrap_or_default();
                // In `success(wait 5 s)` the call around it ends.
                let within = rest.split(')').next().filter(|rest| !rest.contains('('));
                let is_argument = next.starts_with(|c: char| c.is_ascii_digit());
                let rest = match within.filter(|_| is_argument && !UNITS.contains(&name)) {
                    Some(within) => within,
                    None => rest,
                };
                let rest = rest.split("//").next().unwrap_or_default().trim_end();
                let mut letters =
                    rest.trim_start_matches(|c: char| c.is_ascii_alphanumeric() || c == '_');
                letters = letters.trim_start();
                let named = letters.starts_with('=')
                    && !letters.starts_with("=>")
                    && !letters.starts_with("==");
                let number = next.starts_with(|c: char| c.is_ascii_digit());
                // Behind a unit a comma is missing.
                if named && UNITS.contains(&name) {
                    return false;
                }
                if !is_word || !(named || number) || rest.contains(['(', ')', '{', '>']) {
                    return false;
                }
                let start = place.range().start;
                let right = format!("({rest})");
                let span = Span::new(self.file, before.range().end, start + rest.len());
                self.failed_at = Some(start + rest.len());
                Diagnostic::new(
                    Code::E0101,
                    place,
                    format!("the arguments of `{name}` stand in parentheses"),
                )
                .label(format!("write `{name}{right}`"))
                .fix(
                    format!("write `{name}{right}`"),
                    span,
                    right,
                    Applicability::Unsafe,
                )
            }
        };
        self.report(diagnostic);
        true
    }

    /// Whether a number divides by a unit: `1/s`.
    fn divides(&self, number: Span) -> bool {
        let rest = self.text.get(number.range().end..).unwrap_or_default();
        let unit = rest.trim_start_matches(' ').strip_prefix('/');
        let unit = unit.unwrap_or_default().trim_start_matches(' ');
        let letters = unit.find(|c: char| !c.is_ascii_alphabetic());
        let unit = unit.get(..letters.unwrap_or(unit.len()));
        unit.is_some_and(|unit| UNITS.contains(&unit))
    }
}
