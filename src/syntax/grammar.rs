//! The parser that pest makes of `grammar/bt.pest`.

use pest::Parser as _;
use pest::error::{ErrorVariant, InputLocation};
use pest::iterators::{Pair, Pairs};
use pest_derive::Parser;

#[derive(Parser)]
#[grammar = "../grammar/bt.pest"]
struct Grammar;

/// A production with the text that it took.
pub(super) type Node<'i> = Pair<'i, Rule>;

/// Where parsing stopped, and what could have stood there.
pub(super) struct Stop {
    /// The byte at which nothing fitted.
    pub(super) at: usize,
    /// The productions that were tried there.
    pub(super) expected: Vec<Rule>,
}

/// The productions of a whole text.
pub(super) fn parse(rule: Rule, text: &str) -> Result<Pairs<'_, Rule>, Stop> {
    Grammar::parse(rule, text).map_err(|error| {
        let at = match error.location {
            InputLocation::Pos(at) | InputLocation::Span((at, _)) => at,
        };
        match error.variant {
            ErrorVariant::ParsingError { positives, .. } => Stop {
                at,
                expected: positives,
            },
            // pest's own guard of the stack; the depth is bounded before.
            ErrorVariant::CustomError { .. } => Stop {
                at,
                expected: Vec::new(),
            },
        }
    })
}

/// The parts of a production, taken one after another.
pub(super) struct Parts<'i> {
    rest: std::iter::Peekable<Pairs<'i, Rule>>,
}

impl<'i> Parts<'i> {
    /// The parts of `node`.
    pub(super) fn of(node: Node<'i>) -> Self {
        Self {
            rest: node.into_inner().peekable(),
        }
    }

    /// The next part if it is a `rule`.
    pub(super) fn maybe(&mut self, rule: Rule) -> Option<Node<'i>> {
        self.rest.next_if(|node| node.as_rule() == rule)
    }

    /// Drops the next part if it is a `rule`, and says whether it was.
    pub(super) fn has(&mut self, rule: Rule) -> bool {
        self.maybe(rule).is_some()
    }

    /// The rule of the next part.
    pub(super) fn ahead(&mut self) -> Option<Rule> {
        self.rest.peek().map(Pair::as_rule)
    }

    /// The next part.
    pub(super) fn next(&mut self) -> Option<Node<'i>> {
        self.rest.next()
    }
}

impl<'i> IntoIterator for Parts<'i> {
    type Item = Node<'i>;
    type IntoIter = std::iter::Peekable<Pairs<'i, Rule>>;

    fn into_iter(self) -> Self::IntoIter {
        self.rest
    }
}
