//! Names and types.

use super::doc::Doc;
use crate::spelling::spelled;
use crate::syntax::ast::{Ident, TypeExpr};

/// A name, in backquotes if it needs them.
pub(super) fn ident(ident: &Ident) -> Doc<'_> {
    Doc::from(spelled(&ident.name))
}

/// `length/time`
pub(super) fn type_expr(ty: &TypeExpr) -> Doc<'_> {
    let mut parts = Vec::new();
    for (index, (name, divides)) in ty.factors.iter().enumerate() {
        if index > 0 {
            parts.push(Doc::from(if *divides { "/" } else { "*" }));
        }
        parts.push(ident(name));
    }
    Doc::row(parts)
}
