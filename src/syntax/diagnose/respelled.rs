//! Words and marks in whose place another one is written.

use super::Place;
use crate::syntax::grammar::Rule;

impl Place<'_> {
    /// What is written in place of the token.
    pub(super) fn respelled(&self) -> Option<(&'static str, &'static str)> {
        match (self.failure.strict, self.found()) {
            (Rule::strict_child | Rule::strict_item, ":") if self.expects(Rule::guards) => {
                Some(("a guard is followed by `=>`", "=>"))
            }
            (Rule::strict_item, "==" | "=") if self.line_begins_with("claim") => {
                Some(("a claim says it in words", "equals"))
            }
            (Rule::strict_item, "eventually" | "achieves" | "finally" | "gets")
                if self.line_begins_with("claim") =>
            {
                Some(("a claim says it in words", "reaches"))
            }
            (Rule::strict_item, "is" | "same" | "equal" | "eq")
                if self.line_begins_with("claim") =>
            {
                Some(("a claim says it in words", "equals"))
            }
            (Rule::strict_item, "of") if self.line_begins_with("learn") => {
                Some(("a learner is for a task", "for"))
            }
            (Rule::strict_item, "of") if self.line_begins_with("tree") => {
                Some(("a tree is for a task", "for"))
            }
            (Rule::strict_item, ":")
                if self.line_begins_with("tree") && self.expects(Rule::kw_for) =>
            {
                // `tree NAME: TASK = NODE`
                let at = self
                    .tokens
                    .partition_point(|token| token.end <= self.found.end);
                let names_task = self.tokens.get(at + 1);
                match names_task.is_some_and(|then| then.of(self.text) == "=") {
                    true => Some(("a tree is for a task", " for")),
                    false => Some(("what a tree is follows `=`", " =")),
                }
            }
            (Rule::strict_item, "for")
                if self.line_begins_with("test") && self.expects(Rule::kw_of) =>
            {
                Some(("a test is of a tree", "of"))
            }
            (Rule::strict_aspect, "in" | "at" | "within") if self.before() == "end" => Some((
                "how long an episode lasts at most is said by `after`",
                "after",
            )),
            (Rule::strict_clause, "if" | "once") if matches!(self.before(), "fail" | "succeed") => {
                Some(("a clause asks by `when`", "when"))
            }
            (Rule::strict_test_entry, "SUCCESS" | "Success" | "Succeeded" | "ok") => {
                Some(("what a behaviour answers is said by a verb", "succeeds"))
            }
            (Rule::strict_test_entry, "FAILURE" | "Failure") => {
                Some(("what a behaviour answers is said by a verb", "fails"))
            }
            (Rule::strict_test_entry, "RUNNING" | "Running") => {
                Some(("what a behaviour answers is said by a verb", "runs"))
            }
            (Rule::strict_item, "avoids" | "not") if self.line_begins_with("claim") => {
                Some(("a claim says it in words", "never"))
            }
            (Rule::strict_item, "before" | "in" | "by" | "under" | "after")
                if self.line_begins_with("claim")
                    && (self.expects(Rule::kw_within) || self.expects(Rule::within)) =>
            {
                Some(("how soon is said by `within`", "within"))
            }
            (Rule::strict_item, "->")
                if self.expects(Rule::ascription) || self.expects(Rule::colon) =>
            {
                Some(("a type follows `:`", ":"))
            }
            (Rule::strict_learn_entry, "each" | "every" | "by") if self.expects(Rule::link) => {
                Some(("what it is counted by follows `per`", "per"))
            }
            (Rule::strict_item, "confidence" | "prob" | "p") if self.before() == "with" => {
                Some(("a claim says a probability", "probability"))
            }
            (Rule::strict_child, "=") if self.expects(Rule::guards) => {
                Some(("a guard is followed by `=>`", "=>"))
            }
            (Rule::strict_item, ";") if self.begins_with("enum") => {
                Some(("the values of an enum are parted by commas", ","))
            }
            (_, ";") if self.open_is_paren() && self.follows_a_range() => {
                Some(("what is asked of each member follows a `:`", ":"))
            }
            (_, ";") if self.open_is_paren() && self.expects(Rule::comma) => {
                Some(("write `,`", ","))
            }
            (Rule::strict_child | Rule::strict_item, ";") if self.expects(Rule::comma) => {
                Some(("the children of a node are parted by commas", ","))
            }
            (Rule::strict_item, "is") if self.expects(Rule::is) => {
                Some(("a value is given with `=`", "="))
            }
            _ => None,
        }
    }
}
