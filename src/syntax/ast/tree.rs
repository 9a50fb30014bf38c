//! Trees and the claims about them.

use crate::source::Span;
use crate::syntax::ast::{Arg, Expr, Ident, Params, Spanned};

/// `tree name(params) for task = node`
#[derive(Clone, Debug, PartialEq)]
pub struct Tree {
    /// Its name.
    pub name: Ident,
    /// The parameters of a subtree.
    pub params: Option<Params>,
    /// The task that it is for.
    pub task: Option<Ident>,
    /// The tree.
    pub root: Node,
}

/// A node of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// What it is.
    pub kind: NodeKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of nodes.
#[derive(Clone, Debug, PartialEq)]
pub enum NodeKind {
    /// `memory sequence { … }`, `retry(3) { … }`
    Composite {
        /// The place of `memory`, if it is there.
        memory: Option<Span>,
        /// Which composite or decorator it is.
        word: Spanned<Word>,
        /// Its arguments.
        args: Option<Vec<Arg>>,
        /// Its children.
        children: Vec<Node>,
    },
    /// `guard => node`
    Guarded {
        /// The guard.
        guard: Expr,
        /// What it guards.
        node: Box<Node>,
    },
    /// A condition, a behaviour or a subtree.
    Leaf(Expr),
    /// Not understood, and reported.
    Error,
}

/// The words of composites and decorators.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Word {
    /// Tries its children until one does not fail.
    Selector,
    /// Tries its children until one does not succeed.
    Sequence,
    /// Ticks all its children.
    Parallel,
    /// Exchanges success and failure.
    Invert,
    /// Turns failure into success.
    Succeed,
    /// Turns success into failure.
    Fail,
    /// Tries again after a failure.
    Retry,
    /// Starts again after a success.
    Repeat,
    /// Fails after a time.
    Timeout,
}

/// `claim tree equals tree`, `claim tree never event …`
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// The tree that it is about.
    pub tree: Ident,
    /// What is claimed.
    pub what: ClaimWhat,
    /// `within t`
    pub within: Option<Expr>,
    /// `with probability >= p`; true if strict.
    pub probability: Option<(bool, Expr)>,
}

/// What is claimed.
#[derive(Clone, Debug, PartialEq)]
pub enum ClaimWhat {
    /// `equals other`
    Equals(Ident),
    /// `never event`
    Never(Expr),
    /// `reaches event`
    Reaches(Expr),
}
