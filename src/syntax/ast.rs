//! The spanned syntax tree, one type a production of the grammar.
//!
//! Every node knows its place. Text that the parser could not make sense of stands as an `Error` node, which
//! a diagnostic has reported already: later passes skip it without a message.

mod behavior;
mod block;
mod declaration;
mod expr;
pub(super) mod shift;
mod task;
mod test;
mod tree;
mod world;

use crate::source::Span;
pub use behavior::{Behavior, BehaviorBody, Clause, ClauseKind};
pub use block::{AssignOp, Binding, Block, Branch, Else, Stmt, StmtKind};
pub use declaration::{
    Enum, Event, Input, InputKind, Let, LetBody, On, Param, Params, Predicate, State, Trigger,
    TypeExpr, Use, UseWhat,
};
pub(super) use expr::chain_depth;
pub use expr::{
    Arg, ArgKind, Axis, BinaryOp, Choice, Expr, ExprKind, Literal, Otherwise, Ref, UnaryOp, Unit,
    UnitFactor, Yield, chain,
};
use std::fmt;
pub use task::{
    Aspect, AspectKind, Learn, LearnEntry, Link, Outcome, Paid, RewardLine, Setting, Start,
    StartLine, Task,
};
pub use test::{Answer, Step, Test, TestLine, TestLineKind};
pub use tree::{Claim, ClaimWhat, Node, NodeKind, Tree, Word};
pub use world::{Field, RobotEntry, RobotEntryKind, World, WorldEntry, WorldEntryKind};

/// A name as it is used or declared; without its backquotes if it had any.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Ident {
    /// The name.
    pub name: String,
    /// Where it stands, backquotes included.
    pub span: Span,
}

/// A value with its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spanned<T> {
    /// The value.
    pub node: T,
    /// Its place.
    pub span: Span,
}

/// A comment, as the formatter keeps it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comment {
    /// Which of the three kinds it is.
    pub kind: CommentKind,
    /// The text after the slashes, without trailing blanks.
    pub text: String,
    /// From the first slash to the last character.
    pub span: Span,
}

/// The three kinds of comments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommentKind {
    /// `//`
    Plain,
    /// `///`, of the next item.
    Item,
    /// `//!`, of the file.
    File,
}

/// A whole file.
#[derive(Clone, Default, PartialEq)]
pub struct File {
    /// The items, in their order.
    pub items: Vec<Item>,
    /// Every comment of every kind, by position.
    pub comments: Vec<Comment>,
    /// The whole text.
    pub span: Span,
    /// What mistakes have taken from it.
    pub lost: Lost,
}

/// Without what mistakes have taken: a tree that is shown has none.
impl fmt::Debug for File {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut shown = f.debug_struct("File");
        shown.field("items", &self.items);
        shown.field("comments", &self.comments);
        shown.field("span", &self.span).finish()
    }
}

/// What mistakes have taken from a file, so that what depends on it is not blamed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lost {
    /// Whether there was any mistake.
    pub any: bool,
    /// The names that declarations seem to declare which were not understood.
    pub names: Vec<String>,
    /// Whether a `use` was not understood, or a declaration without a name, or the rest of the file is missing.
    pub unnamed: bool,
    /// Whether a world was not understood.
    pub world: bool,
    /// Where the text was not understood: what else is found there may follow from that.
    pub places: Vec<Span>,
}

/// A top-level item with its documentation.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// The `///` lines before it, without slashes and without the blank after them.
    pub docs: Vec<String>,
    /// What it is.
    pub kind: ItemKind,
    /// Without its documentation.
    pub span: Span,
}

/// The kinds of items.
#[derive(Clone, Debug, PartialEq)]
pub enum ItemKind {
    /// `use std`, `use "other.bt"`
    Use(Use),
    /// `world name { … }`
    World(World),
    /// `enum name { a, b }`
    Enum(Enum),
    /// `state name: type = expr`
    State(State),
    /// `input name: type`
    Input(Input),
    /// `event name = expr`
    Event(Event),
    /// `each tick { … }`
    EachTick(Block),
    /// `on event { … }`
    On(On),
    /// `let name(…): type = expr`
    Let(Let),
    /// `predicate name = expr`
    Predicate(Predicate),
    /// `behavior name(…) { … }`
    Behavior(Behavior),
    /// `task name { … }`
    Task(Task),
    /// `learn name { … }`
    Learn(Learn),
    /// `tree name for task = node`
    Tree(Tree),
    /// `claim a equals b`
    Claim(Claim),
    /// `test "title" of tree { … }`
    Test(Test),
    /// Not understood, and reported.
    Error,
}
