//! Behaviours.

use crate::source::Span;
use crate::syntax::ast::{Block, Expr, Ident, Params, Ref, TypeExpr};

/// `behavior name(params) { … }`
#[derive(Clone, Debug, PartialEq)]
pub struct Behavior {
    /// Its name.
    pub name: Ident,
    /// Its parameters.
    pub params: Option<Params>,
    /// What it does.
    pub body: BehaviorBody,
}

/// What a behaviour does.
#[derive(Clone, Debug, PartialEq)]
pub enum BehaviorBody {
    /// Declared only, for trees of foreign tables.
    Declared,
    /// `= goto(A)`
    Alias(Ref),
    /// `{ … }`
    Clauses(Vec<Clause>),
}

/// A clause of a behaviour.
#[derive(Clone, Debug, PartialEq)]
pub struct Clause {
    /// What it is.
    pub kind: ClauseKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of clauses.
#[derive(Clone, Debug, PartialEq)]
pub enum ClauseKind {
    /// `local name: type = expr`
    Local {
        /// Its name.
        name: Ident,
        /// Its type.
        ty: Option<TypeExpr>,
        /// Its value when the behaviour starts.
        value: Expr,
    },
    /// `requires expr`
    Requires(Expr),
    /// `succeed when expr`
    Succeed(Expr),
    /// `fail when expr`
    Fail(Expr),
    /// `control { … }`
    Control(Block),
    /// Not understood, and reported.
    Error,
}
