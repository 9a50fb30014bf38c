//! Tests of trees without a world.

use crate::source::Span;
use crate::syntax::ast::{Expr, Ident, Ref, Spanned};

/// `test "title" of tree { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Test {
    /// What it says, without its quotes; its place has them.
    pub title: Ident,
    /// The tree that is ticked.
    pub tree: Ref,
    /// Its lines, in order.
    pub lines: Vec<TestLine>,
}

/// A line of a test.
#[derive(Clone, Debug, PartialEq)]
pub struct TestLine {
    /// What it is.
    pub kind: TestLineKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of lines of a test.
#[derive(Clone, Debug, PartialEq)]
pub enum TestLineKind {
    /// `given low, not full`: what holds from here on.
    Given(Vec<Expr>),
    /// `tick low for 3 s => goto(A) succeeds`
    Tick {
        /// What holds from here on.
        changes: Vec<Expr>,
        /// For how long the tree is ticked; for one tick if not said.
        lasting: Option<Expr>,
        /// What is expected, in the order of the tick.
        steps: Vec<Step>,
    },
    /// Not understood, and reported.
    Error,
}

/// A behaviour that is ticked, or the tree itself, with what it answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The behaviour, or the tree.
    pub name: Ref,
    /// What it answers; a behaviour runs if not said.
    pub answer: Option<Spanned<Answer>>,
}

impl Step {
    /// From the name to the answer.
    pub fn span(&self) -> Span {
        let answer = self.answer.map(|answer| answer.span);
        answer.map_or(self.name.span, |answer| self.name.span.to(answer))
    }
}

/// What a test says of a behaviour or a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Answer {
    /// It answers success.
    Succeeds,
    /// It answers failure.
    Fails,
    /// It goes on.
    Runs,
}
