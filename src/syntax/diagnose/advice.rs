//! Advice on tokens that do not fit.

use super::Place;
use super::words::{FOR_ALL, is_word};
use crate::diagnostic::{Applicability, Diagnostic};
use crate::source::Span;
use crate::spelling::RESERVED;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, Token};
use crate::syntax::words::{CHOICE, NODES, RANGING, RATE, SWITCHES};

/// Whether a word comes next.
fn is_word_next(next: Option<Token>) -> bool {
    next.is_some_and(is_word)
}

impl Place<'_> {
    /// Advice on a token that does not fit.
    pub(super) fn advised(&self, diagnostic: Diagnostic) -> Diagnostic {
        let found = self.found();
        let ends_line = self.next().is_none_or(|next| self.parted(self.found, next));
        let wants_value = [
            Rule::list,
            Rule::list_item,
            Rule::quantity,
            Rule::outcome,
            Rule::kw_last,
            Rule::number,
        ];
        let wants_value = wants_value.iter().any(|&rule| self.expects(rule))
            || self
                .wanted()
                .is_some_and(|wanted| wanted.contains("a value"));
        let wants_block = self.wanted().is_some_and(|wanted| wanted.contains("`{`"));
        let follows = |token: Token| matches!(token.kind, Kind::Word | Kind::Number);
        let is_mark = matches!(found, ":" | "=" | ":=") && self.before.is_some_and(follows);
        let answers = self.failure.strict == Rule::strict_test_entry && self.expects(Rule::guards);
        let rest = self.text.get(self.found.end..).unwrap_or_default();
        if is_mark && answers && rest.lines().next().is_some_and(|line| line.contains("=>")) {
            return diagnostic.help(
                "a test says which predicates hold, by their names: `tick low, not full => …`",
            );
        }
        if is_mark && answers && self.line_begins_with("tick") {
            let title = "what the tree does follows `=>`";
            return diagnostic.fix(title, self.span(), " =>", Applicability::Unsafe);
        }
        if is_mark && wants_block && (ends_line || self.after_found() == "{") {
            let help = "a block stands in braces: `{ … }`";
            return match self.after_found() {
                "{" => diagnostic.fix(
                    format!("drop the `{found}`"),
                    self.span(),
                    "",
                    Applicability::Safe,
                ),
                _ => diagnostic.help(help),
            };
        }
        if found == ":" && self.line_begins_with("end") {
            return diagnostic.help(
                "what an end is worth is said among the rewards: `reward { on EVENT: NUMBER }`",
            );
        }
        if found == ":" && self.before() == "on" && self.failure.strict == Rule::strict_reward {
            return diagnostic.help("what is waited for stands between: `on EVENT: NUMBER`");
        }
        if is_mark && wants_value {
            let before = self.before();
            return diagnostic.fix(
                format!("no `{found}` follows `{before}`: drop it"),
                self.span(),
                "",
                Applicability::Unsafe,
            );
        }
        if let Some((title, right)) = self.respelled() {
            return diagnostic.fix(title, self.span(), right, Applicability::Unsafe);
        }
        if self.before() == "with"
            && self.line_begins_with("claim")
            && self.found.kind == Kind::Number
        {
            let title = "say that it is as probable or more";
            let before = self.span().before();
            return diagnostic.fix(title, before, "probability >= ", Applicability::Unsafe);
        }
        let begins_value = matches!(self.found.kind, Kind::Word | Kind::Number | Kind::Name)
            && !RESERVED.contains(&found);
        let begins_value = begins_value || found == "(" && self.before() == ")";
        if let Some(before) = self.before
            && begins_value
            && self.expects(Rule::comma)
            && self.open_is_paren()
        {
            let place = self.span_of(before).after();
            return diagnostic.fix("put a comma", place, ",", Applicability::Unsafe);
        }
        if self.before() == "history"
            && self.expects(Rule::kw_last)
            && self.found.kind == Kind::Number
        {
            let title = "a history keeps the last ends";
            let ends = self.next().map_or("", |token| token.of(self.text));
            return match matches!(ends, "success" | "failure") {
                true => diagnostic.fix(title, self.span().before(), "last ", Applicability::Safe),
                false => {
                    let right = format!("last {found} success");
                    let title = "a history keeps the last ends, of one kind or of both";
                    diagnostic.fix(title, self.span(), right, Applicability::Unsafe)
                }
            };
        }
        if self.before() == "last" && wants_value && is_word(self.found) {
            let title = "say how many";
            let before = self.span().before();
            return diagnostic.fix(title, before, "1 ", Applicability::Unsafe);
        }
        if self.before() == "probability" && self.found.kind == Kind::Number {
            let title = "say that it is as probable or more";
            let before = self.span().before();
            return diagnostic.fix(title, before, ">= ", Applicability::Unsafe);
        }
        // `on hot, per 1 s: -1`
        if self.failure.strict == Rule::strict_reward
            && found == ","
            && self.begins_with("on")
            && self.after_found() == "per"
            && let Some(word) = self.begins()
        {
            let title = "what time costs is said by `while`";
            return diagnostic.fix(title, self.span_of(word), "while", Applicability::Unsafe);
        }
        let help = match (self.failure.strict, found) {
            _ if self.is_node_without_braces() => {
                "the children of a node stand in braces: `selector { …, … }`"
            }
            (Rule::strict_item, "{") if self.before() == "=" && self.expects(Rule::node) => {
                "braces belong to the word of a node: `selector { … }`, `sequence { … }`"
            }
            (_, "{") if self.before() == "*" => {
                "a node that goes on where it was is a `memory sequence { … }`"
            }
            _ if self.is_function_without_name() => {
                "a function has a name: `let NAME(x: TYPE) = VALUE`"
            }
            (_, "{")
                if self
                    .second_before
                    .is_some_and(|word| SWITCHES.contains(&word.of(self.text))) =>
            {
                CHOICE
            }
            (Rule::strict_aspect, _)
                if self.before() == "after" && self.line_begins_with("end") =>
            {
                "a limit of the time is a line of its own: `end after 10 min`"
            }
            (_, "|")
                if self
                    .wanted()
                    .is_some_and(|wanted| wanted.contains("a value")) =>
            {
                "how much something is, whatever its sign: `abs(…)`"
            }
            (
                Rule::strict_item
                | Rule::strict_clause
                | Rule::strict_child
                | Rule::strict_world_entry,
                "/=",
            ) => "two values that differ: `a != b`",
            (Rule::strict_item, "in") if self.expects(Rule::colon) && self.open_is_paren() => {
                return diagnostic.fix(
                    "the kind of a parameter follows a `:`",
                    self.span(),
                    ":",
                    Applicability::Unsafe,
                );
            }
            (Rule::strict_child, "<") if self.expects(Rule::node) => {
                "a tree is not written in XML: `sequence { goto(A), dock(A) }`"
            }
            (Rule::strict_child, "[") if self.expects(Rule::node) => {
                "the children of a node stand in braces: `sequence { …, … }`"
            }
            (Rule::strict_child | Rule::strict_item, "=>" | "->") if self.before() == "}" => {
                "before `=>` stands a condition; one node after the other is `sequence { NODE, NODE }`"
            }
            (_, "retry" | "repeat" | "timeout" | "invert" | "repeated" | "retried")
                if self.expects(Rule::guards) =>
            {
                "a decorator goes around its node: `retry(2) { … }`, `timeout(10 s) { … }`"
            }
            (Rule::strict_child, "else") => {
                "what is done else is the last child of a `selector`, without a guard"
            }
            (Rule::strict_stmt, "|" | "&") if self.after_found() == "=" => {
                "the state stands on both sides: `STATE = STATE or CONDITION`"
            }
            (Rule::strict_item, "{")
                if self.line_begins_with("behavior") && self.before() != "=" =>
            {
                "nodes make a tree: `tree NAME = sequence { … }`"
            }
            (Rule::strict_robot_entry, "{") if self.line_begins_with("sensor") => {
                "what a sensor is follows `=`: `sensor NAME = range_finder(at = 0 deg, range = 2 m)`"
            }
            (Rule::strict_robot_entry, "{") if self.line_begins_with("drive") => {
                "arguments stand in parentheses: `differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)`"
            }
            (Rule::strict_robot_entry, "{") => {
                "the tree has a name: `tree NAME = …`, and then `runs = NAME`"
            }
            (Rule::strict_reward, "on") => {
                "events are joined by `and` alone: `on EVENT and EVENT: …`"
            }
            (Rule::strict_reward, "each") => "what each tick costs is a price: `per 1 s: …`",
            (Rule::strict_reward, "while") => {
                "the condition goes first: `while CONDITION, per TIME: NUMBER`"
            }
            (Rule::strict_test_entry, "returns" | "==" | "is" | "." | "answers")
                if self.line_begins_with("tick") =>
            {
                "what a behaviour answers is `succeeds`, `fails` or `runs`"
            }
            (Rule::strict_test_entry, _) if self.found.kind == Kind::Number => {
                "several ticks are `tick … for 20 ticks => …`"
            }
            (_, "else") if self.after_found() == "=>" => {
                "what is done else is the last child of a `selector`, without a guard"
            }
            (_, "by") => "the robot stands among the arguments: `success(BEHAVIOR, by = ROBOT)`",
            (Rule::strict_world_entry, "runs") => {
                "what a robot runs is one of its entries: `runs = TREE`"
            }
            (_, ",") if self.is_third_coordinate() => {
                let line = self.begun().trim_start();
                let robot = line.strip_prefix("pose(").and_then(|it| it.split_once(')'));
                let heading = match robot {
                    Some((robot, _)) => format!("heading({})", robot.trim()),
                    None => "heading".to_owned(),
                };
                return diagnostic.help(format!(
                    "a point has two coordinates; where a robot looks is said by `{heading} = …`"
                ));
            }
            (_, "<" | "<=" | ">" | ">=" | "==" | "!=") if matches!(self.before(), "and" | "or") => {
                "each comparison says what it compares: `x > 1 and x < 2`"
            }
            (Rule::strict_aspect, "when" | "if") if self.before() == "end" => {
                "an episode ends on an event: `event NAME = CONDITION`, then `end on NAME`"
            }
            (Rule::strict_test_entry, "=" | "==") if self.expects(Rule::answer) => {
                "what a behaviour answers is `succeeds`, `fails` or `runs`"
            }
            (Rule::strict_test_entry, "=" | "==") => {
                "a predicate is said to hold by its name: `given low`, `given not low`"
            }
            (Rule::strict_reward, "-" | "+") if self.before() == "otherwise" => {
                let before = self
                    .before
                    .map_or(self.span(), |before| self.span_of(before));
                return diagnostic.fix("put a `:`", before.after(), ":", Applicability::Unsafe);
            }
            (Rule::strict_reward, _)
                if self.before() == "reward" && self.found.kind == Kind::Number =>
            {
                "a line of `reward` says the number alone: `on EVENT: 5`"
            }
            (Rule::strict_reward, "-=" | "+=" | "*=") => {
                "a line of `reward` says a number, which is added: `on EVENT: -5`"
            }
            (_, "[") if wants_value && self.begins_with("history") => {
                "a history of nothing is `history = none`"
            }
            (_, "[") if wants_value && self.failure.strict != Rule::strict_aspect => {
                "there are no lists: a point is written `(1 m, 2 m)`"
            }
            (_, _) if self.is_binder_without_parentheses() => {
                "what ranges over a kind stands in parentheses: `any(x in KIND: …)`"
            }
            (_, "[")
                if self
                    .wanted()
                    .is_some_and(|wanted| wanted.contains("an argument"))
                    && self.next().is_some_and(|next| next.kind == Kind::Number) =>
            {
                "there are no lists: a point is written `(1 m, 2 m)`, and any other value is an argument of its own"
            }
            (_, "[")
                if self
                    .wanted()
                    .is_some_and(|wanted| wanted.contains("an argument")) =>
            {
                "there are no lists: each value is an argument of its own"
            }
            (_, "[") if self.expects(Rule::children) => "the children of a node stand in braces",
            (_, "[") if self.expects(Rule::open_paren) => "arguments stand in parentheses",
            (Rule::strict_item, "with")
                if self.line_begins_with("claim")
                    && matches!(self.after_found(), "confidence" | "prob" | "p") =>
            {
                "`with probability >= 95%` says how sure it is"
            }
            (Rule::strict_item, "with") if self.line_begins_with("claim") => {
                "how sure it is follows last: `… within TIME with probability >= 95%`"
            }
            (_, found) if found.starts_with('.') && found.len() > 1 => {
                "a value from a range is drawn by `uniform(low, high)`"
            }
            (_, "..") => "a value from a range is drawn by `uniform(low, high)`",
            (Rule::strict_start_line, "for") => {
                "a line goes for all of a kind: `STATE(x in KIND) = VALUE`"
            }
            (Rule::strict_start_line, "if") => {
                "a start has no branches: `battery = if CONDITION { … } else { … }`"
            }
            (Rule::strict_aspect, "for") if wants_value => FOR_ALL,
            (Rule::strict_aspect, "[" | "{") if wants_value => {
                "a list has no brackets: its entries are parted by commas"
            }
            (Rule::strict_world_entry, "facing") if self.begins_with("place") => {
                "the direction follows the shape: `place NAME = SHAPE facing ANGLE`"
            }
            (Rule::strict_world_entry, "facing") => "only a place has a `facing`",
            (Rule::strict_world_entry, "if") => "the condition of a door follows `when`",
            (_, "if") if self.expects(Rule::or_op) || self.expects(Rule::sum_op) => {
                "a value is chosen by `if CONDITION { … } else { … }`"
            }
            (Rule::strict_item, "and" | "or") if self.begins_with("on") => {
                "what else must hold is asked within: `on EVENT(x: KIND) { if CONDITION { … } }`"
            }
            (Rule::strict_item, "when" | "if") if self.begins_with("on") => {
                "what else must hold is joined by `and`: `on EVENT and CONDITION { … }`"
            }
            (Rule::strict_item, ",") if self.begins_with("on") => {
                "one of several events is waited for by `or`: `on EVENT or EVENT { … }`"
            }
            (Rule::strict_item, "and" | "or") if self.line_begins_with("claim") => {
                "a claim says one thing: write another `claim` for the other"
            }
            (Rule::strict_item, "<" | "<=") if self.before() == "probability" => {
                "a claim says how sure it is at least: `with probability >= 95%`"
            }
            (Rule::strict_item, "<") if is_word_next(self.next()) => {
                "XML is not read: a tree is written `tree NAME = selector { … }`; `btc compile --emit btcpp` makes XML of it"
            }
            (Rule::strict_item, "<" | "{" | "(" | "[") if !self.same_line_as_before() => {
                "a program is made of items: `world NAME { … }`, `state NAME = VALUE`, `tree NAME = NODE`"
            }
            (Rule::strict_world_entry, _)
                if self.expects(Rule::colon)
                    && self.has_its_kind_beside_its_name()
                    && (self.begins_with("place") || self.begins_with("wall")) =>
            {
                "the kind follows the name: `place oak: tree = disc((1 m, 2 m), 20 cm)`"
            }
            (Rule::strict_world_entry, "unless") => {
                "a door is shut while its condition holds: `when not CONDITION`"
            }
            (Rule::strict_start_line, "+=" | "-=" | "*=" | "/=") => {
                "a start says the value itself: `STATE = VALUE`"
            }
            (Rule::strict_child, _) if self.begins_with("if") => {
                "a guard is followed by `=>`: `CONDITION => NODE`"
            }
            (_, "per") if self.expects(Rule::or_op) || self.expects(Rule::sum_op) => RATE,
            (_, "xor") => "one of the two, and not both: `a != b`",
            (_, "in") if self.expects(Rule::or_op) && is_word_next(self.next()) => {
                "whether the robot is in a place: `inside(PLACE)`, another robot: `inside(PLACE, by = ROBOT)`"
            }
            (_, "in") if self.expects(Rule::or_op) && self.range_follows() => {
                "each end is a comparison of its own: `x >= a and x <= b`"
            }
            (Rule::strict_test_entry, "not") if self.expects(Rule::comma) => {
                "a comma parts what holds: `low, not full`"
            }
            (_, "not") if self.expects(Rule::or_op) => "conditions are joined: `a and not b`",
            (_, "in") if self.expects(Rule::or_op) => {
                "each comparison says what it compares: `x == a or x == b`"
            }
            _ if matches!(self.before(), "exists" | "forall" | "some" | "every")
                && self.after_found() == "in" =>
            {
                "what ranges over a kind stands in parentheses: `any(x in KIND: …)`, `all(x in KIND: …)`"
            }
            (_, "for") if self.open_paren().is_some() => {
                "what ranges over a kind is bound first: `any(x in KIND: …)`"
            }
            (_, "*") if self.before() == "(" => "all of a kind are meant by `x in KIND`",
            (_, ")") if self.before() == ":" && self.open_is_paren() => {
                return match self.bound_member() {
                    Some((at, right)) => diagnostic.fix(
                        format!("say of which kind it is: `{right}`"),
                        at,
                        right,
                        Applicability::Unsafe,
                    ),
                    None => diagnostic.help("say of which kind it is: `x in KIND`"),
                };
            }
            // `dock(tap) succeeds`
            (_, "succeeds" | "fails" | "succeeded" | "failed" | "runs")
                if self.expects(Rule::or_op) && self.before() == ")" =>
            {
                "a behaviour is asked how it has ended: `success(BEHAVIOR)`, `failure(BEHAVIOR)`"
            }
            _ if SWITCHES.contains(&self.before()) && is_word(self.found) => CHOICE,
            (Rule::strict_child, "then") => "a guard is followed by `=>`: `CONDITION => NODE`",
            _ if self.is_choice_without_braces() => {
                "both values of a choice stand in braces: `if CONDITION { … } else { … }`"
            }
            (_, "equals" | "equal") if self.expects(Rule::or_op) => {
                "two values are compared with `==`"
            }
            (_, "~") if self.expects(Rule::or_op) => "what differs is asked with `!=`",
            (_, "'") if wants_value => {
                "the language has no values of text: name something, without quotation marks"
            }
            (_, "'") if self.expects(Rule::name) => {
                "a name with marks in it stands in backquotes: `` `a-b` ``"
            }
            (_, "^" | "%") if self.after_found() == "=" => {
                "what sets a state is `=`, `+=`, `-=`, `*=` or `/=`"
            }
            (Rule::strict_child | Rule::strict_item, "{")
                if wants_value && self.before() == "not" =>
            {
                "a node that answers the opposite is `invert { … }`"
            }
            (Rule::strict_item, "{") if self.before() == ":" && self.begins_with("state") => {
                "its values have a type with a name: `enum NAME { a, b }`, then `state NAME: ENUM = a`"
            }
            (Rule::strict_item, "{") if self.before() == "=>" && self.line_begins_with("on") => {
                let arrow = self.before.map_or(self.span(), |it| self.span_of(it));
                let gap = arrow.to(self.span().before());
                return diagnostic.fix("drop `=>`", gap, "", Applicability::Unsafe);
            }
            (Rule::strict_item, "{") if self.before() == "=" && self.begins_with("behavior") => {
                "the clauses of a behaviour follow its name, without `=`"
            }
            (Rule::strict_item, "{") if self.before() == "=" && self.begins_with("on") => {
                let sign = self.before.map_or(self.span(), |it| self.span_of(it));
                let gap = sign.to(self.span().before());
                return diagnostic.fix("drop `=`", gap, "", Applicability::Safe);
            }
            (_, "{") if wants_value => "a value stands without braces",
            (Rule::strict_item, "probability") if self.line_begins_with("claim") => {
                "how sure it is follows `with`: `with probability >= 95%`"
            }
            (_, "then") => "what depends on a condition stands in braces",
            (Rule::strict_reward, ":") if self.expects(Rule::comma) => {
                "a price says what time it is for: `while CONDITION, per 1 s: …`"
            }
            (Rule::strict_child, "{") if self.expects(Rule::node) => {
                "braces belong to the word of a node: `sequence { … }`, `selector { … }`"
            }
            (_, "{") if self.before() == "memory" => {
                "`memory` goes before the word of a node: `memory sequence { … }`"
            }
            (_, "(") if self.before() == ")" && self.expects(Rule::term_op) => {
                "a product is written with `*`"
            }
            _ => return self.advised_on_names(diagnostic),
        };
        diagnostic.help(help)
    }

    /// `place tree oak =`, `place oak(tree) =`: whether the token is a second name, behind which the value follows.
    fn has_its_kind_beside_its_name(&self) -> bool {
        let rest = self.text.get(self.found.end..).unwrap_or_default();
        let rest = rest.lines().next().unwrap_or_default();
        let rest = match self.found() {
            "(" => rest.split_once(')').map(|(_, rest)| rest),
            _ => Some(rest).filter(|_| is_word(self.found)),
        };
        rest.is_some_and(|rest| rest.trim_start().starts_with('='))
    }

    /// Whether the token begins a function as other languages write one without a name: `|x: place| …`, `lambda x: …`.
    fn is_function_without_name(&self) -> bool {
        if self.before() == "lambda" {
            return is_word(self.found);
        }
        let rest = self.text.get(self.found.end..).unwrap_or_default();
        let rest = rest.lines().next().unwrap_or_default();
        let wants_value = self
            .wanted()
            .is_some_and(|wanted| wanted.contains("a value"));
        let is_bar = wants_value && self.found() == "|";
        let Some((bound, body)) = rest.split_once('|').filter(|_| is_bar) else {
            return false;
        };
        bound.contains(':') || body.trim_start().starts_with(|c: char| c.is_alphanumeric())
    }

    /// Whether `..` or a second `,` shows that a range is meant by what follows `in`.
    fn range_follows(&self) -> bool {
        let rest = self.text.get(self.found.end..).unwrap_or_default();
        rest.lines().next().is_some_and(|line| line.contains(".."))
    }

    /// Whether a choice goes on without braces: an `else` follows on the line.
    fn is_choice_without_braces(&self) -> bool {
        let wants_block = self.expects(Rule::open_brace);
        let rest = self.text.get(self.found.start..).unwrap_or_default();
        let rest = rest.lines().next().unwrap_or_default();
        wants_block && rest.contains(" else ") && !rest.contains('{')
    }

    /// Whether the token stands in parentheses or brackets that the word of a node opens.
    fn is_node_without_braces(&self) -> bool {
        let of_node = |at: usize| {
            let index = self.tokens.partition_point(|token| token.end <= at);
            let word = index
                .checked_sub(1)
                .and_then(|index| self.tokens.get(index));
            word.is_some_and(|word| NODES.iter().any(|(node, _)| *node == word.of(self.text)))
        };
        match self.found() {
            "=>" => self.open_paren().is_some_and(|open| of_node(open.start)),
            "[" => of_node(self.found.start),
            _ => false,
        }
    }

    /// Whether what stands before is `x in KIND`.
    pub(super) fn follows_a_range(&self) -> bool {
        self.second_before
            .is_some_and(|word| word.of(self.text) == "in")
    }

    pub(super) fn open_is_paren(&self) -> bool {
        self.open().is_some_and(|open| open.of(self.text) == "(")
    }

    /// `grabbed(g:`: the name before the colon, and how it is bound to the members of the kind that its event is
    /// declared for.
    fn bound_member(&self) -> Option<(Span, String)> {
        let open = self.open()?;
        let index = self.tokens.partition_point(|token| token.end <= open.start);
        let word = |at: usize| self.tokens.get(at).map(|token| token.of(self.text));
        let family = word(index.checked_sub(1)?)?;
        let declares = |at: &usize| {
            word(*at) == Some("event")
                && word(*at + 1) == Some(family)
                && word(*at + 2) == Some("(")
                && word(*at + 4) == Some(":")
        };
        let kind = word((0..self.tokens.len()).find(declares)? + 5)?;
        let (name, colon) = (self.second_before?, self.before?);
        let right = format!("{} in {kind}", name.of(self.text));
        let span = self.span_of(name).to(self.span_of(colon));
        Some((span, right))
    }

    /// Whether the token parts a third value from the two of a point.
    pub(super) fn is_third_coordinate(&self) -> bool {
        let is_point = !self.expects(Rule::comma);
        is_point && self.open_paren().is_some()
    }

    /// Whether the token follows `any` or one of its relatives.
    fn is_binder_without_parentheses(&self) -> bool {
        RANGING.contains(&self.before()) && is_word(self.found) && self.same_line_as_before()
    }
}
