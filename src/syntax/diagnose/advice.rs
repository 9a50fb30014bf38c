//! Advice on tokens that do not fit.

use super::Place;
use super::words::is_word;
use crate::diagnostic::{Applicability, Diagnostic};
use crate::spelling::RESERVED;
use crate::syntax::grammar::Rule;
use crate::syntax::tokens::{Kind, Token};
use crate::syntax::words::CALLED;

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
        if is_mark && wants_value {
            let before = self.before();
            return diagnostic.fix(
                format!("no `{found}` follows `{before}`: drop it"),
                self.span(),
                "",
                Applicability::Safe,
            );
        }
        let help = match (self.failure.strict, found) {
            (_, "[") if self.expects(Rule::children) => "the children of a node stand in braces",
            (_, "[") if self.expects(Rule::open_paren) => "arguments stand in parentheses",
            (_, "..") => "a value from a range is drawn by `uniform(low, high)`",
            (Rule::strict_start_line, "if") => {
                "a start has no branches: `battery = if CONDITION { … } else { … }`"
            }
            (Rule::strict_aspect, "[" | "{") if wants_value => {
                "a list has no brackets: its entries are parted by commas"
            }
            (Rule::strict_world_entry, "facing") => "only a place has a `facing`",
            (Rule::strict_world_entry, "if") => "the condition of a door follows `when`",
            (_, "if") if self.expects(Rule::or_op) || self.expects(Rule::sum_op) => {
                "a value is chosen by `if CONDITION { … } else { … }`"
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
            (_, "selector" | "sequence") if self.before() == "reactive" => {
                "without `memory` a node asks all its children again in every tick: drop `reactive`"
            }
            _ => return self.advised_on_names(diagnostic),
        };
        diagnostic.help(help)
    }

    /// Advice on names with marks in them, and on calls without parentheses.
    fn advised_on_names(&self, diagnostic: Diagnostic) -> Diagnostic {
        let (Some(before), Some(next)) = (self.before.filter(|token| is_word(*token)), self.next())
        else {
            return diagnostic;
        };
        let found = self.found();
        let touching = before.end == self.found.start && self.found.end == next.start;
        if matches!(found, "-" | "." | "/" | "'") && touching && is_word(next) {
            let (left, right) = (self.before(), next.of(self.text));
            return diagnostic.help(format!(
                "a name is made of letters, digits and `_`: `{left}_{right}`; or it stands in backquotes"
            ));
        }
        let is_argument = matches!(self.found.kind, Kind::Word | Kind::Name)
            && !RESERVED.contains(&found)
            && CALLED.contains(&self.before())
            && self.same_line_as_before();
        match is_argument {
            true => diagnostic.help(format!(
                "if `{found}` is an argument: `{}({found})`",
                self.before()
            )),
            false => diagnostic,
        }
    }
}
