//! What a text that was not understood would have declared.

use super::Builder;
use crate::source::Span;
use crate::spelling::RESERVED;
use crate::syntax::tokens::{Kind, Token, joined_by};

/// The words that declare the name after them.
const DECLARING: [&str; 16] = [
    "world",
    "enum",
    "input",
    "state",
    "event",
    "let",
    "predicate",
    "behavior",
    "task",
    "learn",
    "tree",
    "place",
    "wall",
    "robot",
    "sensor",
    "local",
];

/// The words that show that a text is of a world.
const IN_WORLDS: [&str; 4] = ["world", "place", "wall", "robot"];

/// The words that bring the names of another file, here and elsewhere.
const BRINGING: [&str; 7] = [
    "use", "import", "include", "#include", "from", "require", "using",
];

/// The words that begin an item, besides those that declare a name.
const ITEMS: [&str; 4] = ["each", "on", "claim", "test"];

/// How many of its first words a text may declare, whose own word may be the one that is wrong.
const FIRST: usize = 3;

impl Builder<'_> {
    /// Notes that what begins at `span` may not be what was meant: a text on its line was not understood.
    pub(super) fn suspect(&mut self, span: Span) {
        let start = self
            .tokens
            .partition_point(|token| token.start < span.range().start);
        let first = self.tokens.iter().skip(start).take(FIRST);
        let names = first.filter(|token| self.is_name(token));
        let mut lost: Vec<String> = names.map(|token| self.bare(token)).collect();
        // Of a word with a letter that no name has, the name is what stands before that.
        let start = |name: &String| name.find(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        let cut = |name: &String| Some(name.get(..start(name)?)?.to_owned());
        let starts: Vec<String> = lost.iter().filter_map(cut).collect();
        lost.extend(starts);
        self.lost.names.extend(lost);
    }

    /// Notes the shared expressions that a block without its close has taken for values of its own.
    pub(super) fn lose_lets(&mut self, from: usize, to: usize) {
        let first = self.tokens.partition_point(|token| token.start < from);
        let tokens = self.tokens.get(first..).unwrap_or_default();
        let at_margin = |token: &Token| {
            let before = self.text.get(..token.start).unwrap_or_default();
            token.of(self.text) == "let" && before.ends_with('\n')
        };
        let pairs = tokens.windows(2).take_while(|pair| {
            let start = pair.first().map(|token| token.start);
            start.is_some_and(|start| start < to)
        });
        let names = pairs.filter_map(|pair| match pair {
            [word, name] if at_margin(word) => Some(self.bare(name)),
            _ => None,
        });
        let names: Vec<String> = names.collect();
        self.lost.names.extend(names);
    }

    /// Notes that `angry-folk` was to be one name: the entry at `previous` ends in the middle of it.
    pub(super) fn join_names(&mut self, previous: Span, rest: Span) {
        let start = rest.range().start;
        let index = self.tokens.partition_point(|token| token.start < start);
        let at = |index: usize| self.tokens.get(index).copied();
        let (Some(left), Some(mark), Some(right)) =
            (index.checked_sub(1).and_then(at), at(index), at(index + 1))
        else {
            return;
        };
        // `near goal`
        if left.end == previous.range().end && self.is_name(&left) && self.is_name(&mark) {
            self.lost
                .names
                .push([self.bare(&left), self.bare(&mark)].join("_"));
        }
        let touching = left.end == mark.start && mark.end == right.start;
        if !touching || left.end != previous.range().end || right.kind != Kind::Word {
            return;
        }
        for mark in ["_", "-", ""] {
            let joined = [self.bare(&left), self.bare(&right)].join(mark);
            self.lost.names.push(joined);
        }
        let mut joined = [self.bare(&left), self.bare(&right)].join("_");
        let behind = self.tokens.get(index + 2..).unwrap_or_default();
        let names = joined_by(self.text, mark.of(self.text), right.end, behind).map(|word| {
            joined = format!("{joined}_{}", self.bare(word));
            joined.clone()
        });
        let names: Vec<String> = names.collect();
        self.lost.names.extend(names);
    }

    fn line_end(&self, at: usize) -> usize {
        let rest = self.text.get(at..).unwrap_or_default();
        at + rest.find('\n').unwrap_or(rest.len())
    }

    fn is_name(&self, token: &Token) -> bool {
        matches!(token.kind, Kind::Word | Kind::Name) && !RESERVED.contains(&token.of(self.text))
    }

    fn bare(&self, token: &Token) -> String {
        token.of(self.text).trim_matches(['`', '"']).to_owned()
    }

    /// Notes what the text at `span` seems to declare.
    pub(super) fn lose(&mut self, span: Span) {
        let range = span.range();
        let from = self
            .tokens
            .partition_point(|token| token.start < range.start);
        let to = self.tokens.partition_point(|token| token.start < range.end);
        let tokens = self.tokens.get(from..to).unwrap_or_default();
        let is_code = |token: &&Token| token.kind != Kind::Comment;
        let code: Vec<&Token> = tokens.iter().filter(is_code).collect();
        let word = |token: &Token| token.of(self.text);
        let first = code.first().map(|token| word(token));
        let is_name = |token: &&&Token| self.is_name(token);
        let mut names: Vec<&Token> = code.iter().take(FIRST).filter(is_name).copied().collect();
        // What a word of another language declares may stand anywhere behind it: `type mood = calm | angry`.
        let of_this = |word: &str| {
            [&DECLARING[..], &ITEMS, &BRINGING]
                .iter()
                .any(|words| words.contains(&word))
        };
        let at_margin = self
            .text
            .get(..range.start)
            .is_some_and(|text| text.is_empty() || text.ends_with('\n'));
        if first.is_some_and(|word| word == "enum" || at_margin && !of_this(word)) {
            let line_end = match first {
                Some("enum") => range.end,
                _ => self.line_end(range.start),
            };
            let line = code.iter().filter(|token| token.end <= line_end);
            names.extend(line.clone().filter(is_name));
            names.extend(line.filter(|token| token.kind == Kind::Text));
        }
        // A name of two words is likely used as one.
        if let [declares, left, right, ..] = code.as_slice()
            && DECLARING.contains(&word(declares))
            && self.is_name(left)
            && self.is_name(right)
        {
            self.lost
                .names
                .push([self.bare(left), self.bare(right)].join("_"));
        }
        // So is one with a mark in it, or with a word of the language.
        if let [declares, left, rest @ ..] = code.as_slice()
            && DECLARING.contains(&word(declares))
            && self.is_name(left)
        {
            let right = match rest {
                [mark, right, ..] if word(mark) == "-" => Some(right),
                [right, ..] => Some(right),
                [] => None,
            };
            let right = right.filter(|right| right.kind == Kind::Word);
            let joined = right.map(|right| [self.bare(left), self.bare(right)].join("_"));
            self.lost.names.extend(joined);
        }
        // However it is said, what brings the library brings names.
        let mut unnamed = first.is_some_and(|word| BRINGING.contains(&word))
            || code
                .iter()
                .any(|token| word(token).trim_matches('"') == "std");
        // `p: place`, `r in robot` name a type.
        let is_type = |at: usize| {
            let before = at.checked_sub(1).and_then(|before| code.get(before));
            before.is_some_and(|before| matches!(word(before), ":" | "in"))
        };
        for (at, pair) in code.windows(2).enumerate() {
            if let [declares, name] = pair
                && DECLARING.contains(&word(declares))
                && !is_type(at)
            {
                names.push(name);
                unnamed |= !self.is_name(name);
            }
        }
        let world = code.windows(2).any(|pair| match pair {
            [begins, name] => {
                IN_WORLDS.contains(&word(begins)) && (self.is_name(name) || word(name) == "{")
            }
            _ => false,
        });
        // The kinds of places and walls stand behind their names.
        for pair in code.windows(2).filter(|_| world) {
            if let [colon, kind] = pair
                && word(colon) == ":"
                && self.is_name(kind)
            {
                names.push(kind);
            }
        }
        let names: Vec<String> = names.into_iter().map(|token| self.bare(token)).collect();
        self.lost.names.extend(names);
        self.lost.unnamed |= unnamed;
        self.lost.world |= world;
        self.lost.places.push(span);
    }
}
