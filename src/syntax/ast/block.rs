//! Statements.

use crate::source::Span;
use crate::syntax::ast::{Expr, Ident, Ref, Spanned, TypeExpr};

/// `{ … }` with statements.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// The statements.
    pub stmts: Vec<Stmt>,
    /// From brace to brace.
    pub span: Span,
}

/// A statement.
#[derive(Clone, Debug, PartialEq)]
pub struct Stmt {
    /// What it is.
    pub kind: StmtKind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of statements.
#[derive(Clone, Debug, PartialEq)]
pub enum StmtKind {
    /// `let name: type = expr`
    Let(Binding),
    /// `for b in bush { … }`
    For {
        /// What binds.
        name: Ident,
        /// What it ranges over.
        domain: Ident,
        /// What is done for each.
        block: Block,
    },
    /// `if … { … } else …`
    Branch(Branch),
    /// `target = expr`, `target += expr`
    Assign {
        /// What is set.
        target: Ref,
        /// How.
        op: Spanned<AssignOp>,
        /// The value.
        value: Expr,
    },
    /// `drive(…)`
    Call(Ref),
    /// Not understood, and reported.
    Error,
}

/// `let name: type = expr`
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    /// What binds.
    pub name: Ident,
    /// Its type.
    pub ty: Option<TypeExpr>,
    /// Its value.
    pub value: Expr,
    /// The line.
    pub span: Span,
}

/// `if cond { … } else …`
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// The condition.
    pub cond: Expr,
    /// What is done if it holds.
    pub then: Block,
    /// What is done else.
    pub otherwise: Option<Box<Else>>,
}

/// What follows `else`.
#[derive(Clone, Debug, PartialEq)]
pub enum Else {
    /// `else if …`
    If(Branch),
    /// `else { … }`
    Block(Block),
}

/// `=`, `+=` and the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssignOp {
    /// `=`
    Set,
    /// `+=`
    Add,
    /// `-=`
    Sub,
    /// `*=`
    Mul,
    /// `/=`
    Div,
}
