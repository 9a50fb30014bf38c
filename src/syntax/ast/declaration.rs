//! Items that declare a name, with the parameters and types in their heads.

use crate::source::Span;
use crate::syntax::ast::{Block, Expr, Ident, Spanned, Yield};

/// `use std`, `use "path"` or `use "path" sha256:digits`.
#[derive(Clone, Debug, PartialEq)]
pub struct Use {
    /// What is used.
    pub what: Spanned<UseWhat>,
    /// The SHA-256 that the file has to have, in hexadecimal digits.
    pub pin: Option<Spanned<String>>,
}

/// What a `use` names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UseWhat {
    /// The embedded library.
    Std,
    /// A file, by a path relative to the file that uses it.
    Path(String),
}

/// `enum name { a, b }`
#[derive(Clone, Debug, PartialEq)]
pub struct Enum {
    /// Its name.
    pub name: Ident,
    /// Its variants.
    pub variants: Vec<Ident>,
}

/// `input name: type` or `input name: {a, b}`
#[derive(Clone, Debug, PartialEq)]
pub struct Input {
    /// Its name.
    pub name: Ident,
    /// What it may be.
    pub kind: InputKind,
}

/// What an input may be.
#[derive(Clone, Debug, PartialEq)]
pub enum InputKind {
    /// A number of this type.
    Number(TypeExpr),
    /// One of these values.
    Category(Vec<Ident>),
}

/// `state name(params): type = expr`
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Its name.
    pub name: Ident,
    /// The parameters of a family.
    pub params: Option<Params>,
    /// Its type; that of the value if not given.
    pub ty: Option<TypeExpr>,
    /// The value at the start of an episode.
    pub value: Expr,
}

/// `event name(params) = expr`
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Its name.
    pub name: Ident,
    /// The parameters of a family.
    pub params: Option<Params>,
    /// When it happens.
    pub value: Expr,
}

/// `on event { … }`; in `on picked(b: bush) { … }` the parameters bind.
#[derive(Clone, Debug, PartialEq)]
pub struct On {
    /// What it waits for.
    pub trigger: Trigger,
    /// Its effects.
    pub block: Block,
}

/// What an `on` waits for.
#[derive(Clone, Debug, PartialEq)]
pub enum Trigger {
    /// An event or any expression of events.
    Expr(Expr),
    /// Every event of a family; the parameters, with their types, bind.
    Family {
        /// The family.
        name: Ident,
        /// What binds.
        params: Params,
    },
}

/// `let name(params): type = body`
#[derive(Clone, Debug, PartialEq)]
pub struct Let {
    /// Its name.
    pub name: Ident,
    /// Its parameters.
    pub params: Option<Params>,
    /// The type of its value.
    pub ty: Option<TypeExpr>,
    /// Its value.
    pub body: LetBody,
}

/// The value of a `let`.
#[derive(Clone, Debug, PartialEq)]
pub enum LetBody {
    /// `= expr`
    Expr(Expr),
    /// `= { let … expr }`
    Yield(Yield),
}

/// `predicate name(params) = expr`; without a value it is declared only.
#[derive(Clone, Debug, PartialEq)]
pub struct Predicate {
    /// Its name.
    pub name: Ident,
    /// The parameters of a family.
    pub params: Option<Params>,
    /// When it holds.
    pub value: Option<Expr>,
}

/// `(name: type = default, …)`
#[derive(Clone, Debug, PartialEq)]
pub struct Params {
    /// The parameters.
    pub params: Vec<Param>,
    /// From parenthesis to parenthesis.
    pub span: Span,
}

/// `name: type = default`
#[derive(Clone, Debug, PartialEq)]
pub struct Param {
    /// Its name.
    pub name: Ident,
    /// Its type.
    pub ty: TypeExpr,
    /// Its value if no argument is given.
    pub default: Option<Expr>,
    /// Where it stands.
    pub span: Span,
}

/// `length/time`
#[derive(Clone, Debug, PartialEq)]
pub struct TypeExpr {
    /// The names, each with whether it divides.
    pub factors: Vec<(Ident, bool)>,
    /// Where it stands.
    pub span: Span,
}
