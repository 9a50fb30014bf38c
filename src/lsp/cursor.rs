//! What can stand at a place of a text, read off the tokens before it: the text there is seldom whole.

use crate::syntax::tokens::{Kind, Token};
use crate::syntax::words::{ASPECTS, ITEMS};

/// What can stand at a cursor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    /// Nothing that could be guessed: a name of the writer's own, a comment.
    Nothing,
    /// An item.
    Item,
    /// What a `use` names.
    Use,
    /// An entry of a world.
    World,
    /// An entry of a robot.
    Robot,
    /// A clause of a behaviour.
    Clause,
    /// An aspect of a task.
    Aspect,
    /// A line of `reward`.
    RewardLine,
    /// A line of `start`.
    StartLine,
    /// A setting of a learner.
    Setting,
    /// A method of learning.
    Method,
    /// What a guard goes on with: behind `and` there is no node.
    Guard,
    /// A statement of a control law.
    Statement,
    /// An effect.
    Effect,
    /// A unit.
    Unit,
    /// A type.
    Type,
    /// A kind of places or walls.
    Kind,
    /// A kind, an enum: what names range over.
    Domain,
    /// A shape.
    Shape,
    /// What a sensor is.
    Sensor,
    /// What a field of a robot is.
    Body,
    /// A predicate.
    Predicate,
    /// A behaviour.
    Behavior,
    /// An event.
    Event,
    /// A task.
    Task,
    /// A tree.
    Tree,
    /// A node of a tree.
    Node,
    /// A line of a test.
    TestLine,
    /// What a test expects of a tick.
    Expected,
    /// The end of a behaviour.
    Outcome,
    /// A value of any type.
    Value,
}

/// A bracket that is open at the cursor.
#[derive(Clone, Copy)]
struct Frame<'t> {
    /// The bracket.
    bracket: &'t str,
    /// The first word of the entry that it stands in.
    entry: &'t str,
    /// The word before it.
    before: &'t str,
    /// How many tokens of the entry stand before it.
    depth: usize,
}

/// A call that is open at the cursor.
pub(super) struct Call {
    /// The token of what is called.
    pub(super) callee: Token,
    /// How many arguments stand before the one at the cursor.
    pub(super) index: usize,
    /// The name of the argument at the cursor, if it is given one.
    pub(super) name: Option<String>,
}

/// The tokens of a text up to a cursor, without the word that is being written there.
pub(super) struct Before<'t> {
    text: &'t str,
    tokens: Vec<Token>,
    /// Whether the cursor stands in a comment or in a text.
    inside: bool,
    at: usize,
}

impl<'t> Before<'t> {
    /// What stands before byte `at`.
    pub(super) fn new(text: &'t str, tokens: &[Token], at: usize) -> Self {
        let end = tokens.partition_point(|token| token.start < at);
        let mut before: Vec<Token> = tokens.get(..end).unwrap_or_default().to_vec();
        let last = before.last().copied();
        let inside = last.is_some_and(|last| match last.kind {
            Kind::Comment => !text.get(last.end..at).unwrap_or_default().contains('\n'),
            Kind::Text | Kind::Name => at < last.end || !is_closed(last.of(text)) && at == last.end,
            _ => false,
        });
        if last.is_some_and(|last| last.kind == Kind::Word && at <= last.end) {
            before.pop();
        }
        before.retain(|token| token.kind != Kind::Comment);
        Self {
            text,
            tokens: before,
            inside,
            at,
        }
    }

    fn word(&self, token: &Token) -> &'t str {
        token.of(self.text)
    }

    fn starts_line(&self, index: usize) -> bool {
        let Some(token) = self.tokens.get(index) else {
            return true;
        };
        let before = index.checked_sub(1).and_then(|it| self.tokens.get(it));
        let from = before.map_or(0, |before| before.end);
        let gap = self.text.get(from..token.start).unwrap_or_default();
        before.is_none() || gap.contains('\n')
    }

    /// The call whose arguments the cursor stands among.
    pub(super) fn call(&self) -> Option<Call> {
        let (mut depth, mut index) = (0, 0);
        let mut name = None;
        for (at, token) in self.tokens.iter().enumerate().rev() {
            match self.word(token) {
                ")" => depth += 1,
                "(" if depth > 0 => depth -= 1,
                "(" => {
                    let callee = at.checked_sub(1).and_then(|at| self.tokens.get(at))?;
                    let touches = callee.end == token.start;
                    let named = matches!(callee.kind, Kind::Word | Kind::Name);
                    let callee = *callee;
                    return (touches && named).then_some(Call {
                        callee,
                        index,
                        name,
                    });
                }
                "{" | "}" => return None,
                "," if depth == 0 => index += 1,
                "=" if depth == 0 && index == 0 && name.is_none() => {
                    let before = at.checked_sub(1).and_then(|at| self.tokens.get(at));
                    name = before.map(|before| self.word(before).to_owned());
                }
                _ => {}
            }
        }
        None
    }

    /// What can stand at the cursor.
    pub(super) fn wanted(&self) -> Wanted {
        if self.inside {
            return Wanted::Nothing;
        }
        if let Some(last) = self.tokens.last()
            && last.kind == Kind::Number
            && !self.gap(last).contains('\n')
        {
            return Wanted::Unit;
        }
        let (frames, entry) = self.walk();
        let words: Vec<&str> = entry.iter().map(|token| self.word(token)).collect();
        let block = frames.iter().rfind(|frame| frame.bracket == "{");
        let paren = frames.last().filter(|frame| frame.bracket == "(");
        let last = words.last().copied().unwrap_or_default();
        if let Some(paren) = paren {
            return self.in_parentheses(paren, last);
        }
        if last == "in" {
            return Wanted::Domain;
        }
        match block {
            None => at_item(&words),
            Some(block) => within(kind_of(&frames, block), &words),
        }
    }

    fn gap(&self, last: &Token) -> &str {
        self.text.get(last.end..self.at).unwrap_or_default()
    }

    fn in_parentheses(&self, paren: &Frame, last: &str) -> Wanted {
        let declares = matches!(
            paren.entry,
            "let" | "predicate" | "behavior" | "state" | "event" | "tree"
        );
        match last {
            "in" => Wanted::Domain,
            ":" if declares && paren.depth == 2 => Wanted::Type,
            "(" | "," if declares && paren.depth == 2 => Wanted::Nothing,
            _ if matches!(
                paren.before,
                "success" | "failure" | "running" | "done" | "failed"
            ) =>
            {
                Wanted::Behavior
            }
            _ => Wanted::Value,
        }
    }

    /// The brackets that are open at the cursor, and the tokens of the entry that it stands in.
    fn walk(&self) -> (Vec<Frame<'t>>, Vec<Token>) {
        let mut frames: Vec<Frame<'t>> = Vec::new();
        let mut start = 0;
        for (at, token) in self.tokens.iter().enumerate() {
            let word = self.word(token);
            let first = self.tokens.get(start).map_or("", |token| self.word(token));
            let begins_line = self.starts_line(at);
            let margin = token.start == 0
                || self
                    .text
                    .get(..token.start)
                    .is_some_and(|it| it.ends_with('\n'));
            if margin && ITEMS.contains(&word) {
                frames.clear();
                start = at;
                continue;
            }
            if begins_line && self.ends_entry(at, frames.last()) {
                start = at;
            }
            match word {
                "{" | "(" => {
                    let before = at.checked_sub(1).and_then(|at| self.tokens.get(at));
                    frames.push(Frame {
                        bracket: if word == "{" { "{" } else { "(" },
                        entry: if start == at { "" } else { first },
                        before: before.map_or("", |before| self.word(before)),
                        depth: at - start,
                    });
                    if word == "{" {
                        start = at + 1;
                    }
                }
                "}" => {
                    while frames.pop().is_some_and(|frame| frame.bracket == "(") {}
                    start = at + 1;
                }
                ")" => {
                    frames.pop_if(|frame| frame.bracket == "(");
                }
                _ => {}
            }
        }
        let line = self
            .tokens
            .last()
            .is_none_or(|last| self.gap(last).contains('\n'));
        if line && self.ends_entry(self.tokens.len(), frames.last()) {
            start = self.tokens.len();
        }
        let entry = self.tokens.get(start..).unwrap_or_default();
        (frames, entry.to_vec())
    }

    /// Whether an entry can end before the token at an index, which begins a line.
    fn ends_entry(&self, index: usize, frame: Option<&Frame>) -> bool {
        let before = index.checked_sub(1).and_then(|it| self.tokens.get(it));
        let before = before.map_or("", |before| self.word(before));
        let open = matches!(
            before,
            "," | "="
                | "+"
                | "-"
                | "*"
                | "/"
                | "and"
                | "or"
                | "not"
                | "=>"
                | "<"
                | ">"
                | "<="
                | ">="
                | ":"
        );
        !open && frame.is_none_or(|frame| frame.bracket == "{")
    }
}

/// Whether a text or a name has its second quote.
fn is_closed(written: &str) -> bool {
    let quote = written.chars().next().unwrap_or('"');
    written.len() > 1 && written.ends_with(quote)
}

/// What a block is of: the word that it follows, or that of a block around it.
fn kind_of<'t>(frames: &[Frame<'t>], block: &Frame<'t>) -> &'t str {
    match block.entry {
        "if" | "else" | "for" | "" => {
            let mut outer = frames.iter().rev().filter(|frame| frame.bracket == "{");
            let outer = outer.find(|frame| !matches!(frame.entry, "if" | "else" | "for" | ""));
            outer.map_or("", |outer| outer.entry)
        }
        // What stands in a tree is of the tree.
        entry => match frames.first() {
            Some(first) if first.entry == "tree" => "tree",
            _ => entry,
        },
    }
}

/// What can stand after these words of an item.
fn at_item(words: &[&str]) -> Wanted {
    let has_value = words.contains(&"=");
    let last = words.last().copied().unwrap_or_default();
    match words.first().copied().unwrap_or_default() {
        "" => Wanted::Item,
        "use" if words.len() == 1 => Wanted::Use,
        "tree" if has_value => of_tree(last),
        "tree" | "learn" if last == "for" => Wanted::Task,
        "learn" if words.len() == 1 => Wanted::Task,
        "claim" if words.len() == 1 || last == "equals" => Wanted::Tree,
        "claim" if matches!(last, "never" | "reaches") => Wanted::Event,
        "claim" => Wanted::Nothing,
        "test" if last == "of" => Wanted::Tree,
        "on" if words.len() == 1 => Wanted::Event,
        "on" => Wanted::Event,
        "behavior" if has_value => Wanted::Behavior,
        "state" | "let" if last == ":" => Wanted::Type,
        "state" | "let" | "predicate" | "event" if has_value => Wanted::Value,
        _ => Wanted::Nothing,
    }
}

/// What can stand after these words of an entry in a block of this kind.
fn within(kind: &str, words: &[&str]) -> Wanted {
    let first = words.first().copied().unwrap_or_default();
    let last = words.last().copied().unwrap_or_default();
    let has_value = words
        .iter()
        .any(|word| matches!(*word, "=" | "+=" | "-=" | "*=" | "/="));
    match (kind, first) {
        ("world", "") => Wanted::World,
        ("world", "place" | "wall") if last == ":" => Wanted::Kind,
        ("world", "place" | "wall" | "arena") if last == "=" => Wanted::Shape,
        ("world", _) if has_value => Wanted::Value,
        ("robot", "") => Wanted::Robot,
        ("robot", "sensor") if last == "=" => Wanted::Sensor,
        ("robot", "runs") if has_value => Wanted::Tree,
        ("robot", _) if last == "=" => Wanted::Body,
        ("behavior", "") => Wanted::Clause,
        ("behavior", "local") if last == ":" => Wanted::Type,
        ("behavior", "local") if !has_value => Wanted::Nothing,
        ("behavior", "succeed" | "fail") if words.len() == 1 => Wanted::Nothing,
        ("behavior", _) => Wanted::Value,
        ("task", "") => Wanted::Aspect,
        ("task", _) => of_task(words),
        ("reward", "") => Wanted::RewardLine,
        ("reward", "on") if !words.contains(&":") => Wanted::Event,
        ("reward", _) => Wanted::Value,
        ("start", "") => Wanted::StartLine,
        ("start", "history") if has_value => Wanted::Outcome,
        ("start" | "let", _) => Wanted::Value,
        ("learn", "") => Wanted::Setting,
        ("learn", "method") if last == "=" => Wanted::Method,
        ("learn", "unseen") => Wanted::Behavior,
        ("learn", _) => Wanted::Value,
        ("control", "") => Wanted::Statement,
        ("each" | "on", "") => Wanted::Effect,
        ("control" | "each" | "on", "let") if last == ":" => Wanted::Type,
        ("control" | "each" | "on", "let" | "for") if !has_value => Wanted::Nothing,
        ("control" | "each" | "on", _) => Wanted::Value,
        ("tree", _) => of_tree(last),
        ("test", "") => Wanted::TestLine,
        ("test", _) if words.contains(&"=>") => Wanted::Expected,
        ("test", _) => Wanted::Predicate,
        ("enum", _) => Wanted::Nothing,
        _ => Wanted::Value,
    }
}

/// What can stand behind a word of a tree.
fn of_tree(last: &str) -> Wanted {
    match last {
        "and" | "or" | "not" => Wanted::Guard,
        _ => Wanted::Node,
    }
}

/// What can stand in an aspect of a task: its lists go over lines, so the last word of an aspect counts.
fn of_task(words: &[&str]) -> Wanted {
    let aspect = words.iter().rev().find(|word| ASPECTS.contains(word));
    let last = words.last().copied().unwrap_or_default();
    let open = matches!(last, "," | "on") || aspect.is_some_and(|aspect| *aspect == last);
    match aspect.copied().unwrap_or_default() {
        "observe" if open => Wanted::Predicate,
        "choose" if open => Wanted::Behavior,
        "end" if words.contains(&"on") => Wanted::Event,
        "history" => Wanted::Outcome,
        _ => Wanted::Value,
    }
}

#[cfg(test)]
mod tests {
    use super::{Before, Wanted};
    use crate::syntax::tokens::tokens;

    fn wanted(text: &str) -> Wanted {
        Before::new(text, &tokens(text), text.len()).wanted()
    }

    #[test]
    fn the_place_says_what_is_wanted() {
        for (text, expected) in [
            ("", Wanted::Item),
            ("use std\n\npre", Wanted::Item),
            ("use ", Wanted::Use),
            ("task t {\n    choose ", Wanted::Behavior),
            (
                "task t {\n    choose goto(A),\n           go",
                Wanted::Behavior,
            ),
            (
                "task t {\n    observe a, b\n    choose a\n    ",
                Wanted::Aspect,
            ),
            ("task t {\n    observe ", Wanted::Predicate),
            ("task t {\n    end on ", Wanted::Event),
            ("task t {\n    reward {\n        on ", Wanted::Event),
            ("task t {\n    reward {\n        ", Wanted::RewardLine),
            ("task t {\n    history last 1 ", Wanted::Unit),
            ("world w {\n    ", Wanted::World),
            ("world w {\n    place A = ", Wanted::Shape),
            ("world w {\n    place A = disc(", Wanted::Value),
            ("world w {\n    place A: ", Wanted::Kind),
            ("world w {\n    robot r {\n        ", Wanted::Robot),
            (
                "world w {\n    robot r {\n        sensor front = sc",
                Wanted::Sensor,
            ),
            ("world w {\n    tick = 50 ", Wanted::Unit),
            ("world w {\n    tick = 50 m", Wanted::Unit),
            ("tree t = ", Wanted::Node),
            ("tree t = selector {\n    low => ", Wanted::Node),
            ("tree t = selector {\n    low and ", Wanted::Guard),
            ("tree t = selector {\n    low or not ne", Wanted::Guard),
            ("tree t = not ", Wanted::Guard),
            ("tree t for ", Wanted::Task),
            ("behavior b(x: ", Wanted::Type),
            ("behavior b(", Wanted::Nothing),
            ("behavior b {\n    ", Wanted::Clause),
            ("behavior b {\n    control {\n        ", Wanted::Statement),
            (
                "behavior b {\n    control {\n        if x {\n            ",
                Wanted::Statement,
            ),
            ("predicate low = ", Wanted::Value),
            ("predicate low = any(g in ", Wanted::Domain),
            ("event e = success(", Wanted::Behavior),
            ("each tick {\n    ", Wanted::Effect),
            ("learn t {\n    ", Wanted::Setting),
            ("learn t {\n    method = ", Wanted::Method),
            ("learn t {\n    method = mo", Wanted::Method),
            ("test \"a\" of ", Wanted::Tree),
            ("test \"a\" of t {\n    ", Wanted::TestLine),
            ("test \"a\" of t {\n    given low, ", Wanted::Predicate),
            ("test \"a\" of t {\n    tick low => ", Wanted::Expected),
            (
                "test \"a\" of t {\n    tick low => a fails, ",
                Wanted::Expected,
            ),
            ("// ", Wanted::Nothing),
            ("use \"a", Wanted::Nothing),
        ] {
            assert_eq!(wanted(text), expected, "{text:?}");
        }
    }

    #[test]
    fn the_call_at_a_cursor_is_found() {
        let text = "let a = clamp(min(1, 2), ";
        let call = Before::new(text, &tokens(text), text.len()).call().unwrap();
        assert_eq!((call.callee.of(text), call.index), ("clamp", 1));
        let text = "choose goto(A, margin = ";
        let call = Before::new(text, &tokens(text), text.len()).call().unwrap();
        assert_eq!(call.name.as_deref(), Some("margin"));
    }
}
