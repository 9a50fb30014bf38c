//! Tasks and learners.

use crate::source::Span;
use crate::syntax::ast::{Expr, Ident, Ref, Spanned};

/// `task name { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// Its name.
    pub name: Ident,
    /// Its aspects, in their order.
    pub aspects: Vec<Aspect>,
}

/// An aspect of a task.
#[derive(Clone, Debug, PartialEq)]
pub struct Aspect {
    /// What it is.
    pub kind: AspectKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of aspects.
#[derive(Clone, Debug, PartialEq)]
pub enum AspectKind {
    /// `observe a, b`
    Observe(Vec<Expr>),
    /// `choose a, b`
    Choose(Vec<Expr>),
    /// `history last 1 success, failure`
    History {
        /// How many terminations the window holds.
        window: Expr,
        /// Which terminations enter it.
        outcomes: Vec<Spanned<Outcome>>,
    },
    /// `patience 600 ticks`
    Patience(Expr),
    /// `start { … }`
    Start(Start),
    /// `end on event`
    EndOn(Expr),
    /// `end after 5_000 ticks`
    EndAfter(Expr),
    /// `reward { … }`
    Reward {
        /// `on event: value`, `per time: value`
        lines: Vec<RewardLine>,
        /// `otherwise: value`
        otherwise: Option<Expr>,
    },
    /// Not understood, and reported.
    Error,
}

/// How a behaviour ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// With success.
    Success,
    /// With failure.
    Failure,
}

/// `start { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Start {
    /// Its lines, in the order in which they run.
    pub lines: Vec<StartLine>,
    /// From the word to the brace.
    pub span: Span,
}

/// `target = expr`
#[derive(Clone, Debug, PartialEq)]
pub struct StartLine {
    /// What is set.
    pub target: Ref,
    /// Its value.
    pub value: Expr,
    /// The line.
    pub span: Span,
}

/// `on event: value`, `per time: value`, `while condition, per time: value`
#[derive(Clone, Debug, PartialEq)]
pub struct RewardLine {
    /// When it is paid.
    pub paid: Paid,
    /// How much is paid.
    pub value: Expr,
    /// The line.
    pub span: Span,
}

/// When a reward is paid.
#[derive(Clone, Debug, PartialEq)]
pub enum Paid {
    /// `on event`: as the event happens.
    On(Expr),
    /// `while condition, per time`: for the time that passes.
    Per {
        /// What has to hold meanwhile.
        during: Option<Expr>,
        /// The time that the value is for.
        time: Expr,
    },
}

impl Paid {
    /// Where the event or the time stands.
    pub fn span(&self) -> Span {
        match self {
            Paid::On(event) => event.span,
            Paid::Per { time, .. } => time.span,
        }
    }
}

/// `learn name for task { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Learn {
    /// The learner's name, `learned` if not given.
    pub name: Option<Ident>,
    /// The task.
    pub task: Ident,
    /// Its settings.
    pub entries: Vec<LearnEntry>,
}

/// An entry of a learner.
#[allow(clippy::large_enum_variant, reason = "a learner has a dozen of them")]
#[derive(Clone, Debug, PartialEq)]
pub enum LearnEntry {
    /// `start { … }`
    Start(Start),
    /// `name = expr [of | per | -> expr]`
    Setting(Setting),
    /// Not understood, and reported.
    Error(Span),
}

/// `name = expr`, with what may follow it.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Its name.
    pub name: Ident,
    /// Its value.
    pub value: Expr,
    /// `of`, `per` or `->` and what follows.
    pub tail: Option<(Spanned<Link>, Expr)>,
    /// The line.
    pub span: Span,
}

/// What joins the two values of a setting.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// `16_700 of 300 ticks`
    Of,
    /// `0.95 per decision`
    Per,
    /// `35% -> 5%`
    Arrow,
}
