//! Words that are not units, not names, or begin no entry.

use super::Place;
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::Span;
use crate::spelling::RESERVED;
use crate::syntax::expected;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::Kind;
use crate::syntax::words::{ITEMS, UNITS};

impl Place<'_> {
    pub(super) fn unit(&self) -> Option<Diagnostic> {
        let after_number = self.before.is_some_and(|token| token.kind == Kind::Number);
        let after_unit = UNITS.contains(&self.before());
        let word = self.found();
        if !(after_number || after_unit)
            || self.found.kind != Kind::Word
            || !self.same_line_as_before()
            || RESERVED.contains(&word)
            || expected::words(&self.failure.expected).contains(&word)
        {
            return None;
        }
        let links: &[&str] = if self.failure.strict == Rule::strict_learn_entry {
            &["of", "per"]
        } else {
            &[]
        };
        Some(no_such_unit(self.span(), word, links))
    }

    pub(super) fn reserved(&self) -> Option<Diagnostic> {
        let word = self.found();
        if !RESERVED.contains(&word) || !self.expects(Rule::name) {
            return None;
        }
        if self.failure.at == self.failure.start && self.failure.strict == Rule::strict_item {
            return None;
        }
        Some(
            Diagnostic::new(
                Code::E0122,
                self.span(),
                format!("`{word}` is a word of the language, not a name"),
            )
            .label("a name was expected")
            .help("choose another name, or put it in backquotes")
            .fix(
                "put it in backquotes",
                self.span(),
                format!("`{word}`"),
                Applicability::Unsafe,
            ),
        )
    }

    /// A word that should begin an item, a clause or an aspect, and does not.
    pub(super) fn first_word(&self) -> Option<Diagnostic> {
        if self.failure.at != self.failure.start || self.found.kind != Kind::Word {
            return None;
        }
        let word = self.found();
        let at_item = self.failure.strict == Rule::strict_item;
        let mut candidates = if at_item {
            ITEMS.to_vec()
        } else {
            expected::words(&self.failure.expected)
        };
        candidates.sort_unstable();
        candidates.dedup();
        if candidates.is_empty() || candidates.contains(&word) {
            return None;
        }
        let (code, begins) = match self.failure.strict {
            Rule::strict_item => (Code::E0105, "an item"),
            Rule::strict_clause => (Code::E0123, "a clause of a behaviour"),
            Rule::strict_aspect => (Code::E0123, "an aspect of a task"),
            Rule::strict_reward => (Code::E0123, "a line of `reward`"),
            _ => return None,
        };
        let foreign = match word {
            "function" | "fn" | "def" | "const" | "var" => Some("let"),
            "condition" | "observation" => Some("predicate"),
            "action" | "skill" => Some("behavior"),
            "import" | "include" => Some("use"),
            "include_std" => Some("use"),
            "actions" => Some("choose"),
            "rewards" => Some("reward"),
            "terminate" | "done" => Some("end"),
            "success" => Some("succeed"),
            "failure" => Some("fail"),
            "precondition" | "require" => Some("requires"),
            "default" | "else" => Some("otherwise"),
            _ => None,
        };
        let near = foreign
            .filter(|meant| candidates.contains(meant))
            .or_else(|| suggest::nearest(word, candidates.iter().copied()));
        let diagnostic = Diagnostic::new(
            code,
            self.span(),
            format!("`{word}` does not begin {begins}"),
        );
        let listed: Vec<String> = candidates.iter().map(|word| format!("`{word}`")).collect();
        let diagnostic = match near {
            Some(near) => diagnostic.label(format!("did you mean `{near}`?")).fix(
                format!("write `{near}`"),
                self.span(),
                near,
                Applicability::Unsafe,
            ),
            None => diagnostic.label("not known here"),
        };
        Some(diagnostic.note(format!("{begins} begins with {}", either(&listed))))
    }
}

/// "a, b or c"
fn either(words: &[String]) -> String {
    match words.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, first)) => format!("{} or {last}", first.join(", ")),
        None => String::new(),
    }
}

/// The units, as advice.
pub(in crate::syntax) fn units_note() -> String {
    format!(
        "the units are {}",
        UNITS.map(|unit| format!("`{unit}`")).join(", ")
    )
}

/// The message for a word that follows a number and is not a unit; `others` may follow a number too.
pub(in crate::syntax) fn no_such_unit(span: Span, word: &str, others: &[&str]) -> Diagnostic {
    let diagnostic = Diagnostic::new(Code::E0114, span, format!("`{word}` is not a unit"));
    let units = UNITS.into_iter().filter(|unit| unit.len() > 1);
    let near = suggest::nearest(word, units.chain(others.iter().copied())).or_else(|| {
        UNITS
            .into_iter()
            .find(|unit| unit.eq_ignore_ascii_case(word))
    });
    let diagnostic = match near {
        Some(near) => diagnostic.label(format!("did you mean `{near}`?")).fix(
            format!("write `{near}`"),
            span,
            near,
            Applicability::Unsafe,
        ),
        None => diagnostic.label("this follows a number"),
    };
    diagnostic.note(units_note())
}
