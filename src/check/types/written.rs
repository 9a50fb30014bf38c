//! Types as they are written.

use crate::check::Checker;
use crate::check::names::TypeDecl;
use crate::check::types::Type;
use crate::check::types::units::Dim;
use crate::diagnostic::Code;
use crate::spelling::spelled;
use crate::syntax::ast::{Ident, TypeExpr};

/// The most factors of a type that anybody would write.
const FACTORS: u64 = 8;

/// The names of built-in types.
const BUILT_IN: &[(&str, Type)] = &[
    ("bool", Type::Bool),
    ("number", Type::NUMBER),
    ("ratio", Type::Ratio),
    ("length", Type::LENGTH),
    ("time", Type::TIME),
    ("angle", Type::ANGLE),
    ("speed", Type::SPEED),
    ("turn_rate", Type::TURN_RATE),
    ("frequency", Type::FREQUENCY),
    ("point", Type::Point),
    ("place", Type::Place(None)),
    ("wall", Type::Wall(None)),
    ("robot", Type::Robot),
    ("sensor", Type::Sensor),
    ("target", Type::Target),
];

/// The names of built-in types.
pub fn names() -> impl Iterator<Item = &'static str> {
    BUILT_IN.iter().map(|(name, _)| *name)
}

impl Type {
    /// The type as the language writes it; `None` of what is never written.
    pub fn written(&self) -> Option<String> {
        let named = BUILT_IN.iter().find(|(_, ty)| ty == self);
        match self {
            Type::Enum(name) | Type::Place(Some(name)) | Type::Wall(Some(name)) => {
                Some(spelled(name).into_owned())
            }
            Type::Quantity(dim) if named.is_none() => {
                (dim.factors() <= FACTORS).then(|| dim.written())
            }
            _ => named.map(|(name, _)| (*name).to_owned()),
        }
    }
}

impl<'a> Checker<'a> {
    /// The type that is written.
    pub fn type_expr(&mut self, written: &TypeExpr) -> Type {
        // A type that is missing is reported.
        if written.factors.is_empty() {
            return Type::Error;
        }
        if let [(name, false)] = written.factors.as_slice() {
            return self.named_type(name);
        }
        let mut dim = Dim::NONE;
        for (name, divides) in &written.factors {
            let ty = self.named_type(name);
            match ty.dim() {
                Some(factor) => dim = dim.times(factor, if *divides { -1 } else { 1 }),
                None if ty == Type::Error => return Type::Error,
                None => {
                    self.error(
                        Code::E0304,
                        name.span,
                        format!(
                            "`{}` has no unit, so it makes no product or quotient",
                            name.name
                        ),
                    )
                    .this_is(ty);
                    return Type::Error;
                }
            }
        }
        Type::Quantity(dim)
    }

    /// The type of that name: built in, an enum or a kind.
    pub fn named_type(&mut self, name: &Ident) -> Type {
        if let Some((_, ty)) = BUILT_IN.iter().find(|(known, _)| *known == name.name) {
            self.is_built_in(name);
            return ty.clone();
        }
        // Of two kinds of one name nobody knows which is meant.
        if self.names.is_lost(&name.name) {
            return Type::Error;
        }
        let found = self.names.types.get(name.name.as_str()).copied();
        if let Some(decl) = found {
            self.stands_for(name, decl.ident().span);
        }
        match found {
            Some(TypeDecl::Enum(_)) => Type::Enum(name.name.clone()),
            Some(TypeDecl::PlaceKind(_)) => Type::Place(Some(name.name.clone())),
            Some(TypeDecl::WallKind(_)) => Type::Wall(Some(name.name.clone())),
            None => {
                let built_in = BUILT_IN.iter().map(|(name, _)| *name);
                let known = built_in.chain(self.names.types.keys().copied());
                let likely = self.likely(&name.name, known);
                let other = self.names.value(&name.name, self.context.library);
                self.names.lost_type |= likely.is_none() && other.is_none();
                self.undeclared(name, "type", likely);
                Type::Error
            }
        }
    }
}
