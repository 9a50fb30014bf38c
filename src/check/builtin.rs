//! The names that the compiler knows: constants of the moment, functions, draws.

use crate::ir::expr::{Binary, Unary};

macro_rules! named {
    ($(#[$doc:meta])* $set:ident { $($variant:ident $name:literal,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum $set { $($variant,)* }

        impl $set {
            const NAMES: &'static [(&'static str, $set)] = &[$(($name, $set::$variant),)*];

            /// Its name.
            pub fn name(self) -> &'static str {
                Self::NAMES.iter().find(|(_, it)| *it == self).map_or("", |(name, _)| name)
            }

            /// The built-in of that name.
            pub fn named(name: &str) -> Option<Self> {
                Self::NAMES.iter().find(|(known, _)| *known == name).map(|(_, it)| *it)
            }
        }
    };
}

named! {
    /// Names without arguments.
    Constant {
        Heading "heading",
        Position "position",
        MaxSpeed "max_speed",
        MaxTurn "max_turn",
        Touching "touching",
        Elapsed "elapsed",
        Tick "tick",
        NearestWall "nearest_wall",
        Nowhere "nowhere",
        Visits "visits",
        Progress "progress",
        Anywhere "anywhere",
    }
}

named! {
    /// Names with arguments, besides the operators of [`crate::ir::expr`].
    Function {
        Clamp "clamp",
        Distance "distance",
        Bearing "bearing",
        Direction "direction",
        Visible "visible",
        Inside "inside",
        Facing "facing",
        Success "success",
        Failure "failure",
        Running "running",
        Pose "pose",
        Done "done",
        Failed "failed",
        Uniform "uniform",
        Normal "normal",
        Chance "chance",
        OneOf "one_of",
        Tune "tune",
        Any "any",
        All "all",
        Count "count",
        Nearest "nearest",
        Disc "disc",
        Rect "rect",
        Polygon "polygon",
        Polyline "polyline",
        Line "line",
    }
}

/// What a call of a built-in name calls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BuiltIn {
    /// A function of one number.
    Unary(Unary),
    /// A function of two numbers.
    Binary(Binary),
    /// Anything else.
    Function(Function),
}

impl BuiltIn {
    /// Whether a declaration of the user may have its name: what is declared is meant then.
    pub fn gives_way(self) -> bool {
        matches!(self, Self::Function(Function::Running | Function::Pose))
    }

    /// The built-in of that name.
    pub fn named(name: &str) -> Option<Self> {
        let unary = || Unary::named(name).map(Self::Unary);
        let binary = || Binary::named(name).map(Self::Binary);
        let function = Function::named(name).map(Self::Function);
        function.or_else(unary).or_else(binary)
    }
}

/// Every built-in name.
pub fn names() -> impl Iterator<Item = &'static str> {
    let constants = Constant::NAMES.iter().map(|(name, _)| *name);
    let unary = Unary::ALL.iter().map(|op| op.name());
    let binary = Binary::ALL.iter().map(|op| op.name());
    let functions = Function::NAMES.iter().map(|(name, _)| *name);
    let calls = unary.chain(binary).chain(functions);
    constants.chain(calls.filter(|name| !name.is_empty()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::types::written;
    use crate::syntax::words::{FUNCTIONS, TYPES};

    /// What the parser takes for built-in names is built in.
    #[test]
    fn the_parser_knows_what_is_built_in() {
        for name in FUNCTIONS {
            assert!(BuiltIn::named(name).is_some(), "{name}");
        }
        assert!(written::names().eq(TYPES));
    }
}
