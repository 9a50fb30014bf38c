//! Words that are not units, not names, or begin no entry.

use super::Place;
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::Span;
use crate::spelling::RESERVED;
use crate::syntax::expected;
use crate::syntax::follow_ups::CLOSED_ABOVE;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, Token};
use crate::syntax::words::{FOREIGN, ITEMS, NODES, SHAPES};

/// How an entry of a list goes for all members of a kind.
pub(super) const FOR_ALL: &str =
    "an entry of a list goes for all of a kind: `PREDICATE(x in KIND)`";

impl Place<'_> {
    /// The spelling of the token after the one that does not fit.
    pub(super) fn after_found(&self) -> &str {
        self.next().map_or("", |token| token.of(self.text))
    }

    pub(super) fn next(&self) -> Option<Token> {
        let index = self
            .tokens
            .partition_point(|token| token.end <= self.found.end);
        self.tokens.get(index).copied()
    }

    pub(super) fn meant(
        &self,
        diagnostic: Diagnostic,
        word: Token,
        meant: Option<&str>,
    ) -> Diagnostic {
        match meant {
            Some(meant) => diagnostic.label(format!("did you mean `{meant}`?")).fix(
                format!("write `{meant}`"),
                self.span_of(word),
                meant,
                Applicability::Unsafe,
            ),
            None => diagnostic.label("not known here"),
        }
    }

    pub(super) fn reserved(&self) -> Option<Diagnostic> {
        let word = self.found();
        let is_name = self.expects(Rule::name) || self.is_whole_argument();
        if !RESERVED.contains(&word) || !is_name {
            return None;
        }
        if self.failure.at == self.failure.start && self.failure.strict == Rule::strict_item {
            return None;
        }
        let next = self.next().filter(|next| !self.parted(self.found, *next));
        let names_next = next.is_some_and(|next| {
            matches!(next.kind, Kind::Word | Kind::Name) && !RESERVED.contains(&next.of(self.text))
        });
        if self.failure.strict == Rule::strict_robot_entry && matches!(word, "tree" | "behavior") {
            let message = format!("`{word}` is no entry of a robot");
            let diagnostic = Diagnostic::new(Code::E0123, self.span(), message);
            return Some(
                self.meant(diagnostic, self.found, Some("runs"))
                    .note("what another robot does is said by `runs = TREE`"),
            );
        }
        // Only where nothing but a name can stand is the word a name.
        let only_name = self.failure.expected.iter().all(|&rule| {
            matches!(
                rule,
                Rule::name | Rule::learner_name | Rule::family | Rule::param
            )
        });
        // What a learner without a name learns.
        if word == "learn" && self.before() == "claim" {
            let message = format!("expected a name, found `{word}`");
            let diagnostic = Diagnostic::new(Code::E0101, self.span(), message);
            return Some(self.meant(diagnostic, self.found, Some("learned")));
        }
        if names_next
            && !matches!(word, "for" | "if")
            && self.before.is_some_and(is_word)
            && self.same_line_as_before()
        {
            let message = format!("expected a name, found `{word}`");
            return Some(
                Diagnostic::new(Code::E0101, self.span(), message)
                    .label("this is not said here")
                    .fix(
                        format!("drop `{word}`"),
                        self.span()
                            .to(Span::new(self.file, self.found.end, next?.start)),
                        "",
                        Applicability::Unsafe,
                    ),
            );
        }
        let is_set = matches!(self.after_found(), "=" | "+=" | "-=" | "*=" | "/=");
        if !only_name && !is_set && !self.is_whole_argument() || word == "for" {
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

    /// Whether the token stands alone between brackets and commas, as an argument does or the name of a parameter.
    fn is_whole_argument(&self) -> bool {
        let begins = matches!(self.before(), "(" | ",") && self.open_is_paren();
        let begins_item = ITEMS.contains(&self.found()) && !self.expected_here(self.found());
        begins && begins_item && matches!(self.after_found(), ":" | ")" | ",")
    }

    /// `let mut x`, `enum class x`: a word of another language before the name.
    pub(super) fn word_before_name(&self) -> Option<Diagnostic> {
        let (begins, word) = (self.second_before?, self.before?);
        let known = match begins.of(self.text) {
            "let" | "state" => ["mut", "const", "var", "static"].as_slice(),
            "enum" => &["class", "struct"],
            _ => return None,
        };
        let said = known.contains(&word.of(self.text));
        let name = matches!(self.found.kind, Kind::Word | Kind::Name);
        if !said || !name || !self.same_line_as_before() {
            return None;
        }
        let spelling = word.of(self.text);
        let span = Span::new(self.file, word.start, self.found.start);
        let message = format!("expected a name, found `{spelling}`");
        Some(
            Diagnostic::new(Code::E0101, self.span_of(word), message)
                .label("this is not said here")
                .fix(
                    format!("drop `{spelling}`"),
                    span,
                    "",
                    Applicability::Unsafe,
                ),
        )
    }

    /// A word that should begin an item, a clause or an aspect, and does not.
    pub(super) fn first_word(&self) -> Option<Diagnostic> {
        if self.failure.at != self.failure.start || self.found.kind != Kind::Word {
            return None;
        }
        // What stands behind an entry on its line does not begin another one.
        let at_item = self.failure.strict == Rule::strict_item;
        let may_begin = self.before() == "{" || !at_item && matches!(self.before(), "," | ";");
        if self.same_line_as_before() && !may_begin {
            return None;
        }
        let word = self.found();
        let mut candidates = match self.failure.strict {
            Rule::strict_item => ITEMS.to_vec(),
            Rule::strict_reward => vec!["on", "otherwise", "per", "while"],
            _ => expected::words(&self.failure.expected),
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
            Rule::strict_test_entry => (Code::E0123, "a line of a test"),
            _ => return None,
        };
        let after = self.after_found();
        if at_item && let Some(diagnostic) = self.no_item(code) {
            return Some(diagnostic);
        }
        if at_item && ITEMS.contains(&after) {
            let diagnostic = Diagnostic::new(
                code,
                self.span(),
                format!("`{word}` does not begin {begins}"),
            )
            .label(format!("the item begins with `{after}`"));
            let drop = self
                .span()
                .to(Span::new(self.file, self.found.end, self.next()?.start));
            return Some(diagnostic.fix(format!("drop `{word}`"), drop, "", Applicability::Unsafe));
        }
        let foreign = (FOREIGN.iter())
            .filter(|(foreign, _)| *foreign == word)
            .map(|(_, meant)| *meant)
            .find(|meant| candidates.contains(meant));
        if foreign.is_none()
            && let Some((whole, example)) = self.entry_of_another(word)
        {
            let message = format!("`{word}` does not begin {begins}");
            return Some(
                Diagnostic::new(code, self.span(), message)
                    .label(format!("this stands in {whole}"))
                    .help(format!("put it there: `{example}`")),
            );
        }
        let lacks_its_word = self.failure.strict == Rule::strict_aspect && word == "last";
        let foreign = foreign.or(lacks_its_word.then_some("history last"));
        if self.failure.strict == Rule::strict_aspect && word == "after" {
            return Some(end_is_missing(self.span()));
        }
        let near = foreign.or_else(|| suggest::nearest(word, candidates.iter().copied()));
        let in_reward = self.failure.strict == Rule::strict_reward && near.is_none();
        if in_reward && matches!(after, "+=" | "-=" | "*=") {
            let message = format!("`{word}` does not begin {begins}");
            return Some(
                Diagnostic::new(code, self.span(), message)
                    .label("nothing is set here")
                    .help("a line of `reward` says a number, which is added: `on EVENT: -5`"),
            );
        }
        if in_reward && matches!(after, ":" | "=" | "=>" | "->") {
            return Some(
                Diagnostic::new(
                    code,
                    self.span(),
                    format!("`{word}` does not begin {begins}"),
                )
                .label(format!("did you mean `on {word}`?"))
                .fix(
                    "put `on` before it",
                    self.span().before(),
                    "on ",
                    Applicability::Unsafe,
                )
                .note("a line of `reward` begins with `on`, `while`, `per` or `otherwise`"),
            );
        }
        if self.failure.strict == Rule::strict_aspect && word == "for" {
            let message = format!("`for` does not begin {begins}");
            return Some(
                Diagnostic::new(code, self.span(), message)
                    .label("nothing is repeated here")
                    .help(FOR_ALL),
            );
        }
        let near = near.or_else(|| {
            (self.failure.strict == Rule::strict_clause && matches!(after, "=" | ":"))
                .then_some("local")
        });
        if near == Some("local") && matches!(after, "=" | ":") {
            return Some(
                Diagnostic::new(
                    code,
                    self.span(),
                    format!("`{word}` does not begin {begins}"),
                )
                .label(format!("did you mean `local {word}`?"))
                .fix(
                    "declare it",
                    self.span().before(),
                    "local ",
                    Applicability::Unsafe,
                )
                .note("a variable of a behaviour is declared by `local`, and set in `control`"),
            );
        }
        let diagnostic = Diagnostic::new(
            code,
            self.span(),
            format!("`{word}` does not begin {begins}"),
        );
        let listed: Vec<String> = candidates.iter().map(|word| format!("`{word}`")).collect();
        let control = ["drive", "if", "for"];
        if self.failure.strict == Rule::strict_clause && control.contains(&word) {
            return Some(
                diagnostic
                    .label("a statement of `control`")
                    .help(format!("put it there: `control {{ {word} … }}`")),
            );
        }
        if self.failure.strict == Rule::strict_clause && self.after_found() == "(" && near.is_none()
        {
            return Some(diagnostic.label("not known here").help(
                "another behaviour under a name of its own is `behavior NAME = BEHAVIOR(…)`",
            ));
        }
        let diagnostic = match near.map(|near| self.in_full(near)) {
            Some((near, span)) => diagnostic.label(format!("did you mean `{near}`?")).fix(
                format!("write `{near}`"),
                span,
                near,
                Applicability::Unsafe,
            ),
            None if self.failure.strict == Rule::strict_item
                && (matches!(self.after_found(), "=>" | ",") || self.is_child_line()) =>
            {
                diagnostic.label("this stands in a tree").help(CLOSED_ABOVE)
            }
            None if self.failure.strict == Rule::strict_item
                && matches!(self.after_found(), "=" | ":=") =>
            {
                diagnostic
                    .label("not known here")
                    .help(self.item_of_value(word))
            }
            None if self.failure.strict == Rule::strict_item && self.after_found() == ":" => {
                diagnostic.label("not known here").fix(
                    format!("what changes is a state: put `state` before `{word}`"),
                    self.span().before(),
                    "state ",
                    Applicability::Unsafe,
                )
            }
            None => diagnostic.label("not known here"),
        };
        // Who has another word for it may write it otherwise, too.
        let form = foreign.and_then(|meant| {
            let full = self.form_of(self.in_full(meant).0);
            full.or_else(|| self.form_of(meant))
        });
        let diagnostic = match form {
            Some(form) => diagnostic.help(format!("its form is `{form}`")),
            None => diagnostic,
        };
        Some(diagnostic.note(format!("{begins} begins with {}", either(&listed))))
    }
}

impl Place<'_> {
    /// The item that `word = …` seems to be, whose first word is missing: as the value says.
    fn item_of_value(&self, word: &str) -> String {
        let value = self.rest_of_line(self.found.end);
        let value = value.trim_start_matches([' ', ':', '=']);
        let first = value
            .split(|c: char| !c.is_alphanumeric() && c != '_')
            .next();
        let first = first.unwrap_or_default();
        let is_node = first == "memory" || NODES.iter().any(|(node, _)| *node == first);
        let asks = ["not", "any", "all", "visible", "inside", "success"].contains(&first);
        let compares = ["==", "!=", "<", ">", " and ", " or "];
        if is_node && value.contains('{') {
            format!("a tree is `tree {word} = …`")
        } else if SHAPES.contains(&first) {
            format!("a place is `place {word} = …`, a wall `wall {word} = …`, both in a world")
        } else if asks || compares.iter().any(|it| value.contains(it)) {
            format!(
                "what is true or false is `predicate {word} = …`, what happens `event {word} = …`"
            )
        } else {
            format!("what stays is `let {word} = …`, what changes `state {word} = …`")
        }
    }
}

impl Place<'_> {
    /// Whether the line reads as a child of a tree: a call with a comma behind it, or one that an arrow follows.
    fn is_child_line(&self) -> bool {
        let line = self.text.get(self.found.end..).unwrap_or_default();
        let line = line.lines().next().unwrap_or_default();
        let line = line.split("//").next().unwrap_or_default().trim_end();
        (line.starts_with('(') || self.found() == "not")
            && (line.ends_with(',') || line.contains("=>"))
    }

    /// A word that is meant with what has to follow it, and the text in whose place it is written.
    fn in_full(&self, meant: &'static str) -> (&'static str, Span) {
        let next = self.next();
        let index = next.map(|next| self.tokens.partition_point(|token| token.end <= next.end));
        let second = index.and_then(|index| self.tokens.get(index).copied());
        let is_number = |token: &Option<Token>| token.is_some_and(|it| it.kind == Kind::Number);
        let rest = self.text.get(self.found.end..).unwrap_or_default();
        let line = rest.lines().next().unwrap_or_default();
        match meant {
            "let" if self.failure.strict == Rule::strict_item && opens_a_body(rest) => {
                ("behavior", self.span())
            }
            "end" if is_number(&next) => ("end after", self.span()),
            "each" if self.after_found() == "{" => ("each tick", self.span()),
            "end" if matches!(self.after_found(), "=" | ":") && is_number(&second) => {
                let mark = next.map_or(self.span(), |next| self.span_of(next));
                ("end after", self.span().to(mark))
            }
            "tick" if self.failure.strict == Rule::strict_test_entry && !line.contains("=>") => {
                ("tick =>", self.span())
            }
            "use" if self.found() == "from" && self.after_found() == "std" => {
                let end = self.found.end + line.trim_end().len();
                ("use std", Span::new(self.file, self.found.start, end))
            }
            "on" if self.failure.strict == Rule::strict_reward && line.contains(", per ") => {
                ("while", self.span())
            }
            meant => (meant, self.span()),
        }
    }
}

/// Whether what follows on a line opens a block and gives no value before it, or the clauses of a behaviour stand below.
fn opens_a_body(rest: &str) -> bool {
    let mut lines = rest.lines();
    let line = lines.next().unwrap_or_default().trim_end();
    let below = lines.find(|line| !line.trim().is_empty());
    let word = below.and_then(|line| line.split_whitespace().next());
    let has_clauses = word.is_some_and(|word| CLAUSES.contains(&word));
    let mut depth = 0_i32;
    let gives = line.chars().any(|letter| {
        depth += i32::from(letter == '(') - i32::from(letter == ')');
        depth == 0 && letter == '='
    });
    !gives && (line.ends_with('{') || line.ends_with(':') && has_clauses)
}

/// The words that begin a clause of a behaviour.
const CLAUSES: [&str; 5] = ["local", "requires", "succeed", "fail", "control"];

/// How a place or a wall is made one of a kind.
pub(super) fn of_kind(kind: &str) -> String {
    format!("say it where a place or a wall is of this kind: `place NAME: {kind} = …`")
}

/// "a, b or c"
pub(super) fn either(words: &[String]) -> String {
    match words.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, first)) => format!("{} or {last}", first.join(", ")),
        None => String::new(),
    }
}

/// Whether a token is a word.
pub(super) fn is_word(token: Token) -> bool {
    token.kind == Kind::Word
}

/// What is said of `after 10 min`, which lacks `end`.
pub(in crate::syntax) fn end_is_missing(after: Span) -> Diagnostic {
    Diagnostic::new(
        Code::E0123,
        after,
        "`after` does not begin an aspect of a task",
    )
    .label("did you mean `end after`?")
    .fix(
        "put `end` before it",
        after.before(),
        "end ",
        Applicability::Unsafe,
    )
}
