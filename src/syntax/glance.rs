//! What a text declares, as its tokens show it, whether or not it can be parsed: messages about mistakes ask it.

use super::tokens::{Kind, Token};
use rustc_hash::FxHashSet;

/// Words and names, gathered once for a text, so that thousands of mistakes do not read it thousands of times.
#[derive(Default)]
pub(super) struct Glance<'t> {
    /// Every word.
    words: FxHashSet<&'t str>,
    /// Every word with the one before it.
    pairs: FxHashSet<[&'t str; 2]>,
    /// Those of them that a parenthesis follows.
    called: FxHashSet<[&'t str; 2]>,
    /// What stands where a name is declared: after `let`, before `:`, `=` or `in`, or in a list of variants.
    declared: FxHashSet<&'t str>,
    /// What stands in a list in braces, as the variants of an enum do.
    listed: FxHashSet<&'t str>,
    /// Every name in backquotes, without them.
    quoted: FxHashSet<&'t str>,
    /// What stands where a place or a wall says its kind.
    kinds: FxHashSet<&'t str>,
}

impl<'t> Glance<'t> {
    /// What these tokens show.
    pub(super) fn of(text: &'t str, tokens: &[Token]) -> Self {
        let mut glance = Self::default();
        let spelling = |token: Option<&Token>| token.map_or("", |token| token.of(text));
        for (index, token) in tokens.iter().enumerate() {
            let at = |behind: usize| {
                index
                    .checked_sub(behind)
                    .and_then(|index| tokens.get(index))
            };
            let (name, before, next) = (token.of(text), at(1), spelling(tokens.get(index + 1)));
            let word = spelling(before);
            glance.pairs.insert([word, name]);
            if next == "(" {
                glance.called.insert([word, name]);
            }
            let ends = matches!(next, "}" | ",");
            if matches!(word, "{" | ",") && ends {
                glance.listed.insert(name);
            }
            if word == ":" && matches!(spelling(at(3)), "place" | "wall") {
                glance.kinds.insert(name);
            }
            if token.kind == Kind::Name {
                glance.quoted.insert(name.trim_matches('`'));
            }
            if token.kind != Kind::Word {
                continue;
            }
            glance.words.insert(name);
            let is_unit = before.is_some_and(|before| before.kind == Kind::Number);
            let marked = matches!(next, ":" | "=" | "in") && !is_unit && word != "on";
            let introduced = matches!(word, "let" | "state" | "place" | "predicate" | "enum");
            if marked || introduced || matches!(word, "{" | ",") && ends {
                glance.declared.insert(name);
            }
        }
        glance
    }

    /// Whether the text has this word.
    pub(super) fn has(&self, word: &str) -> bool {
        self.words.contains(word)
    }

    /// Whether one of these words declares `name`.
    pub(super) fn declares_by(&self, words: &[&str], name: &str) -> bool {
        words.iter().any(|word| self.pairs.contains(&[word, name]))
    }

    /// Whether one of these words declares `name` with parameters.
    pub(super) fn declares_called(&self, words: &[&str], name: &str) -> bool {
        words.iter().any(|word| self.called.contains(&[word, name]))
    }

    /// Whether the text seems to declare `name` anywhere.
    pub(super) fn declares(&self, name: &str) -> bool {
        self.declared.contains(name)
    }

    /// Whether the text has this name in backquotes.
    pub(super) fn quotes(&self, name: &str) -> bool {
        self.quoted.contains(name)
    }

    /// Whether `name` seems to be a variant of an enum.
    pub(super) fn lists(&self, name: &str) -> bool {
        self.listed.contains(name)
    }

    /// Whether places or walls are of a kind that is called so.
    pub(super) fn is_kind(&self, name: &str) -> bool {
        self.kinds.contains(name)
    }
}
