//! How an item or an entry is written, for who has begun it and gone on otherwise.

use super::Place;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Token, is_blank};

/// The words that begin an item, with the form of that item.
const ITEMS: [(&str, &str); 16] = [
    ("use", "use std` or `use \"other.bt\""),
    ("world", "world NAME { … }"),
    ("enum", "enum NAME { a, b, c }"),
    ("input", "input NAME: TYPE` or `input NAME: {a, b}"),
    ("state", "state NAME: TYPE = VALUE"),
    ("event", "event NAME = CONDITION"),
    ("each", "each tick { … }"),
    ("on", "on EVENT { … }"),
    ("let", "let NAME(PARAMETER: TYPE): TYPE = VALUE"),
    ("predicate", "predicate NAME = CONDITION"),
    ("behavior", "behavior NAME(PARAMETER: TYPE) { … }"),
    ("task", "task NAME { … }"),
    ("learn", "learn TASK { … }` or `learn NAME for TASK { … }"),
    ("tree", "tree NAME for TASK = NODE"),
    (
        "claim",
        "claim TREE equals TREE`, `claim TREE never EVENT` or `claim TREE reaches EVENT within TIME",
    ),
    ("test", "test \"TITLE\" of TREE { tick => BEHAVIOR }"),
];

/// The words that begin an entry of a block, with the form of that entry.
const ENTRIES: [(Rule, &str, &str); 23] = [
    (
        Rule::strict_world_entry,
        "place",
        "place NAME = disc((1 m, 2 m), 20 cm)",
    ),
    (
        Rule::strict_world_entry,
        "wall",
        "wall NAME = line((1 m, 1 m), (1 m, 2 m))",
    ),
    (Rule::strict_world_entry, "robot", "robot NAME { … }"),
    (
        Rule::strict_robot_entry,
        "sensor",
        "sensor NAME = range_finder(at = 0 deg, range = 2 m)",
    ),
    (Rule::strict_clause, "local", "local NAME: TYPE = VALUE"),
    (Rule::strict_clause, "requires", "requires CONDITION"),
    (Rule::strict_clause, "succeed", "succeed when CONDITION"),
    (Rule::strict_clause, "fail", "fail when CONDITION"),
    (Rule::strict_clause, "control", "control { … }"),
    (
        Rule::strict_aspect,
        "observe",
        "observe PREDICATE, PREDICATE",
    ),
    (Rule::strict_aspect, "choose", "choose BEHAVIOR, BEHAVIOR"),
    (
        Rule::strict_aspect,
        "history",
        "history last 1 success, failure",
    ),
    (Rule::strict_aspect, "patience", "patience TIME"),
    (Rule::strict_aspect, "start", "start { … }"),
    (
        Rule::strict_aspect,
        "end",
        "end on EVENT` or `end after TIME",
    ),
    (Rule::strict_aspect, "reward", "reward { on EVENT: NUMBER }"),
    (Rule::strict_reward, "on", "on EVENT: NUMBER"),
    (Rule::strict_reward, "per", "per TIME: NUMBER"),
    (
        Rule::strict_reward,
        "while",
        "while CONDITION, per TIME: NUMBER",
    ),
    (Rule::strict_reward, "otherwise", "otherwise: NUMBER"),
    (
        Rule::strict_test_entry,
        "given",
        "given PREDICATE, not PREDICATE",
    ),
    (
        Rule::strict_test_entry,
        "tick",
        "tick PREDICATE => BEHAVIOR",
    ),
    (Rule::strict_stmt, "for", "for MEMBER in KIND { … }"),
];

impl Place<'_> {
    /// The form of the item or the entry that the text begins, as advice. Within a value it would say nothing.
    pub(super) fn form(&self, wanted: &str) -> Option<String> {
        let within = [
            "a value",
            "an operator",
            "a node",
            "a statement",
            "a number",
        ];
        let known = |word: &&str| self.form_of(word).is_some();
        let start = self.failure.start;
        let before = self.text.get(..start).unwrap_or_default();
        let line = before.rfind('\n').map_or(0, |at| at + 1);
        // What stands behind a whole item may have been meant as a part of it.
        let mut words = [self.word_at(start), self.word_at(line)].into_iter();
        if self.failure.strict == Rule::strict_stmt && !self.begins_with("for") {
            return None;
        }
        let word = words.find(known)?;
        if within.contains(&wanted) || self.open().is_some() && word != "enum" {
            return None;
        }
        self.form_of(word)
            .map(|form| format!("its form is `{form}`"))
    }

    /// The token with which the text that does not parse begins.
    pub(super) fn begins(&self) -> Option<Token> {
        let before = |token: &Token| token.start < self.failure.start;
        let first = self.tokens.partition_point(before);
        self.tokens.get(first).copied()
    }

    /// Whether the text that does not parse begins with a word.
    pub(super) fn begins_with(&self, word: &str) -> bool {
        self.word_at(self.failure.start) == word
    }

    /// Whether the text that does not parse, or the line that it goes on with, begins with a word.
    pub(super) fn line_begins_with(&self, word: &str) -> bool {
        let before = self.text.get(..self.failure.start).unwrap_or_default();
        let line = before.rfind('\n').map_or(0, |at| at + 1);
        self.begins_with(word) || self.word_at(line) == word
    }

    /// The word that begins at byte `at`, or behind the blanks there.
    fn word_at(&self, at: usize) -> &str {
        let rest = self.text.get(at..).unwrap_or_default();
        let rest = rest.trim_start_matches(is_blank);
        let end = rest.find(|c: char| !c.is_ascii_alphabetic());
        rest.get(..end.unwrap_or(rest.len())).unwrap_or_default()
    }

    pub(super) fn form_of(&self, word: &str) -> Option<&'static str> {
        match self.failure.strict {
            Rule::strict_item => {
                let item = ITEMS.iter().find(|(begins, _)| *begins == word);
                item.map(|(_, form)| *form)
            }
            strict => {
                let is = |(of, begins, _): &&(Rule, &str, &str)| *of == strict && *begins == word;
                ENTRIES.iter().find(is).map(|(.., form)| *form)
            }
        }
    }
}
