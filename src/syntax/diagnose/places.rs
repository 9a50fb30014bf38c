//! What stands in the wrong place: items within a block, entries of another block, a colon where `=` should be.

use super::Place;
use super::words::{either, is_word, of_kind};
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::syntax::expected;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, Token};
use crate::syntax::words::{ITEMS, KINDS, NODES, home};

impl Place<'_> {
    /// An item that stands within a block.
    pub(super) fn item_within(&self) -> Option<Diagnostic> {
        let word = self.found();
        let (begins, whole) = self.entry()?;
        if self.failure.at != self.failure.start || !ITEMS.contains(&word) {
            return None;
        }
        // A variable of a behaviour is one of its own.
        let is_local =
            self.failure.strict == Rule::strict_clause && matches!(word, "state" | "let");
        let next = self.next().filter(|next| !self.parted(self.found, *next))?;
        let opens = is_word(next) || next.kind == Kind::Name || next.of(self.text) == "{";
        if is_local || !opens || self.expected_here(word) {
            return None;
        }
        let message = format!("`{word}` does not begin {begins}");
        let diagnostic = Diagnostic::new(Code::E0123, self.span(), message);
        let line = self.text.get(self.found.end..)?.lines().next()?;
        if self.failure.strict == Rule::strict_aspect && word == "on" && !line.contains('{') {
            return Some(
                diagnostic
                    .label("a line of `reward`")
                    .help("put it there: `reward { on EVENT: NUMBER }`"),
            );
        }
        Some(diagnostic.label("an item of its own").help(format!(
            "put it outside, before {whole} or behind its last `}}`"
        )))
    }

    /// An entry of another block, whose first word is `word`.
    pub(super) fn entry_of_another(&self, word: &str) -> Option<(&'static str, &'static str)> {
        let (_, own) = self.entry()?;
        // `drive(…)` is a statement, `drive = …` an entry.
        if self.after_found() == "(" {
            return None;
        }
        home(word).filter(|(whole, _)| !whole.contains(own.trim_start_matches("the ")))
    }

    /// What an entry of the block at hand is called, and the block.
    pub(super) fn entry(&self) -> Option<(&'static str, &'static str)> {
        Some(match self.failure.strict {
            Rule::strict_world_entry => ("an entry of a world", "the world"),
            Rule::strict_robot_entry => ("an entry of a robot", "the world"),
            Rule::strict_clause => ("a clause of a behaviour", "the behaviour"),
            Rule::strict_aspect => ("an aspect of a task", "the task"),
            Rule::strict_start_line => ("a line of `start`", "the task"),
            Rule::strict_reward => ("a line of `reward`", "the task"),
            Rule::strict_learn_entry => ("a setting of a learner", "the learner"),
            Rule::strict_test_entry => ("a line of a test", "the test"),
            Rule::strict_stmt => ("a statement", "the whole item"),
            _ => return None,
        })
    }

    /// Whether a word of the language can stand here, as itself.
    pub(super) fn expected_here(&self, word: &str) -> bool {
        let words = expected::words(&self.failure.expected);
        words.contains(&word)
    }

    /// `event dead: battery <= 0%`, `place shed: disc(…)`, `state loaded: false`: a value behind a colon.
    pub(super) fn given_by_colon(&self) -> Option<Diagnostic> {
        let declares = ["state", "event", "predicate", "let", "place", "wall"];
        if !declares.iter().any(|word| self.begins_with(word)) {
            return None;
        }
        let colon = |token: &&Token| token.of(self.text) == ":";
        let of_value = matches!(self.found.kind, Kind::Number | Kind::Text)
            || matches!(self.found(), "true" | "false");
        let ends_line = self.next().is_none_or(|next| self.parted(self.found, next));
        let colon = match self.found() {
            ":" if self.expects(Rule::is) && !ends_line => self.found,
            "(" if self.expects(Rule::is) => self.second_before.filter(|it| colon(&it))?,
            _ if of_value => self.before.filter(|it| colon(&it))?,
            _ => return None,
        };
        let message = "a value is given with `=`, not with `:`";
        let span = self.span_of(colon);
        Some(
            Diagnostic::new(Code::E0127, span, message)
                .label("write `=`")
                .fix("write `=`", span, " =", Applicability::Unsafe),
        )
    }

    /// A word that should begin an entry of a world or of a robot, before the name that it declares.
    pub(super) fn entry_word(&self) -> Option<Diagnostic> {
        let word = self.before?;
        let first = word.start == self.failure.start && word.kind == Kind::Word;
        let declares = matches!(self.found.kind, Kind::Word | Kind::Name);
        let (what, known): (_, &[&str]) = match self.failure.strict {
            Rule::strict_world_entry => ("an entry of a world", &["place", "wall", "robot"]),
            Rule::strict_robot_entry => ("an entry of a robot", &["sensor"]),
            Rule::strict_learn_entry => ("a setting of a learner", &[]),
            _ => return None,
        };
        let name = word.of(self.text);
        let settings: &[&str] = match self.failure.strict {
            Rule::strict_world_entry => &["tick", "arena"],
            Rule::strict_robot_entry => &["body", "drive", "contact", "runs"],
            _ => &[],
        };
        if first && settings.contains(&name) && self.same_line_as_before() && self.found() != ":" {
            let message = format!("expected `=` after `{name}`, found `{}`", self.found());
            return Some(
                Diagnostic::new(Code::E0101, self.span(), message)
                    .label("its value begins here")
                    .fix(
                        "put a `=`",
                        self.span().before(),
                        "= ",
                        Applicability::Unsafe,
                    ),
            );
        }
        let opens = declares || self.found() == "{";
        let of_robot = self.failure.strict == Rule::strict_robot_entry;
        if first && opens && of_robot && NODES.iter().any(|(node, _)| *node == name) {
            let message = "a robot runs a tree by its name";
            return Some(
                Diagnostic::new(Code::E0123, self.span_of(word), message)
                    .label("this node has none")
                    .help(format!(
                        "give it one, `tree NAME = {name} {{ … }}`, and run that: `runs = NAME`"
                    )),
            );
        }
        if let Some((whole, example)) = self.entry_of_another(name)
            && name != "sensor"
            && first
            && opens
        {
            let message = format!("`{name}` does not begin {what}");
            return Some(
                Diagnostic::new(Code::E0123, self.span_of(word), message)
                    .label(format!("this stands in {whole}"))
                    .help(format!("put it there: `{example}`")),
            );
        }
        if known.is_empty() {
            return None;
        }
        if !first || !declares || known.contains(&name) || !self.same_line_as_before() {
            return None;
        }
        if KINDS.contains(&name) {
            let kind = self.found();
            let message = format!("`{name}` does not begin {what}");
            return Some(
                Diagnostic::new(Code::E0123, self.span_of(word), message)
                    .label("a kind needs no declaration")
                    .help(of_kind(kind)),
            );
        }
        if name == "sensor" {
            let message = format!("`{name}` does not begin {what}");
            return Some(
                Diagnostic::new(Code::E0123, self.span_of(word), message)
                    .label("this stands in a robot")
                    .help("put it there: `robot NAME { sensor … }`"),
            );
        }
        let meant = match name {
            "obstacle" | "block" | "box" | "barrier" | "fence" | "door" | "gate" => Some("wall"),
            "location" | "zone" | "region" | "area" | "goal" | "spot" | "target" | "waypoint"
            | "point" | "station" | "site" | "object" | "landmark" => Some("place"),
            "agent" | "enemy" | "npc" | "player" | "vehicle" | "bot" | "actor" | "drone" => {
                Some("robot")
            }
            "lidar" | "laser" | "camera" | "sonar" | "scanner" | "range_finder" | "beacon" => {
                Some("sensor")
            }
            _ => None,
        };
        let meant = meant.filter(|meant| known.contains(meant));
        if meant.is_none() && matches!(self.after_found(), "" | "(") {
            return None;
        }
        let diagnostic = Diagnostic::new(
            Code::E0123,
            self.span_of(word),
            format!("`{name}` does not begin {what}"),
        );
        let diagnostic = self.meant(
            diagnostic,
            word,
            meant.or_else(|| suggest::nearest(name, known.iter().copied())),
        );
        let diagnostic = match name {
            "door" | "gate" => {
                diagnostic.help("a door is a wall with a condition: `wall NAME = … when CONDITION`")
            }
            _ => diagnostic,
        };
        let listed: Vec<String> = known.iter().map(|word| format!("`{word}`")).collect();
        Some(diagnostic.note(format!(
            "what has a name of its own begins with {}",
            either(&listed)
        )))
    }
}
