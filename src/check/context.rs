//! Where an expression stands: what is in scope there and what is allowed.

use super::types::{Type, Value};
use crate::ir::Id;
use crate::ir::expr::Local;
use crate::source::Span;

/// The part of a program that an expression stands in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// The world and the initial values of states: constants.
    World,
    /// A shared expression.
    Let,
    /// A predicate.
    Predicate,
    /// An event.
    Event,
    /// An effect of every tick.
    EachTick,
    /// An effect of an event.
    Effect,
    /// A reward.
    Reward,
    /// `requires`, `succeed when`, `fail when`.
    Clause,
    /// The initial value of a local.
    Local,
    /// A control law.
    Control,
    /// A line of `start`.
    Start,
    /// The `history` line of a `start`.
    StartHistory,
    /// A schedule of a learner.
    Schedule,
    /// A guard or an argument in a tree.
    Tree,
}

impl Region {
    /// Whether random draws are allowed.
    pub fn draws(self) -> bool {
        matches!(
            self,
            Region::EachTick
                | Region::Effect
                | Region::Local
                | Region::Control
                | Region::Start
                | Region::StartHistory
        )
    }

    /// Whether the text belongs to a behaviour.
    pub fn in_behavior(self) -> bool {
        matches!(self, Region::Clause | Region::Local | Region::Control)
    }

    /// Whether it is known which events happen in this tick.
    pub fn sees_events(self) -> bool {
        matches!(self, Region::Event | Region::Effect | Region::Reward)
    }

    /// What to call it, with its article.
    pub fn name(self) -> &'static str {
        match self {
            Region::World => "a constant",
            Region::Let => "a shared expression",
            Region::Predicate => "a predicate",
            Region::Event => "an event",
            Region::EachTick => "an effect of every tick",
            Region::Effect => "an effect",
            Region::Reward => "a reward",
            Region::Clause => "a behaviour's region",
            Region::Local => "a local",
            Region::Control => "a control law",
            Region::Start | Region::StartHistory => "a start line",
            Region::Schedule => "a schedule",
            Region::Tree => "a tree",
        }
    }
}

/// A name that is bound in a body.
#[derive(Clone, Debug)]
pub struct Binding {
    /// The name.
    pub name: String,
    /// Its type.
    pub ty: Type,
    /// Its value.
    pub value: Value,
    /// The variables behind a local; two for a point, none where they are not known.
    pub locals: Vec<Id<Local>>,
    /// Whether it is a local, which may be assigned to.
    pub settable: bool,
    /// Where it is bound.
    pub span: Span,
}

/// Where an expression stands.
#[derive(Clone, Debug)]
pub struct Context {
    /// The part of the program.
    pub region: Region,
    /// Whether the text is the library's.
    pub library: bool,
    /// The names bound so far, the innermost last.
    pub scope: Vec<Binding>,
}

impl Context {
    /// The user's text, nothing bound.
    pub fn new(region: Region) -> Self {
        Self {
            region,
            library: false,
            scope: Vec::new(),
        }
    }

    /// The innermost binding of a name.
    pub fn lookup(&self, name: &str) -> Option<&Binding> {
        self.scope.iter().rev().find(|binding| binding.name == name)
    }
}
