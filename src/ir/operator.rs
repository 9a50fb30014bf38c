//! The operators and functions of numbers. This table is the only place that lists them: the checker reads their names
//! and types from it, the pool folds constants by its formulas, and the register machine computes by them.

use crate::math;

/// What kind of value an operator takes or gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A truth value: 0 or 1.
    Truth,
    /// A plain number.
    Number,
    /// An angle in radians.
    Angle,
    /// A number of any unit; a result is of its operands' unit.
    Quantity,
    /// A number whose unit follows from the operands' units.
    Derived,
}

/// Hands the table to another macro: `operators!(callback)`.
///
/// A row is: variant, name as a function of the language (empty if it is none), kinds of operands and result, cost in
/// additions (roughly), formula. Truth values are 0 and 1.
macro_rules! operators {
    ($callback:ident) => {
        $callback! {
            unary (a) {
                Neg "" Quantity => Quantity, 1, -a;
                Not "" Truth => Truth, 1, f64::from(a == 0.0);
                Abs "abs" Quantity => Quantity, 1, a.abs();
                // Zero for NaN.
                Sign "sign" Quantity => Number, 1, f64::from(a > 0.0) - f64::from(a < 0.0);
                Sqrt "sqrt" Quantity => Derived, 1, a.sqrt();
                Exp "exp" Number => Number, 5, math::exp(a);
                Ln "ln" Number => Number, 5, math::ln(a);
                Floor "floor" Number => Number, 5, a.floor();
                Ceil "ceil" Number => Number, 5, a.ceil();
                Round "round" Number => Number, 5, a.round();
                Sin "sin" Angle => Number, 5, math::sin(a);
                Cos "cos" Angle => Number, 5, math::cos(a);
                Tan "tan" Angle => Number, 5, math::tan(a);
                Asin "asin" Number => Angle, 5, math::asin(a);
                Acos "acos" Number => Angle, 5, math::acos(a);
                Atan "atan" Number => Angle, 5, math::atan(a);
                Wrap "wrap" Angle => Angle, 5, math::wrap(a);
            }
            binary (a, b) {
                Add "" Quantity => Quantity, 1, a + b;
                Sub "" Quantity => Quantity, 1, a - b;
                Mul "" Quantity => Derived, 1, a * b;
                Div "" Quantity => Derived, 5, a / b;
                // Written out so that every machine treats NaN and signed zeros alike.
                Min "min" Quantity => Quantity, 1, if b < a { b } else { a };
                Max "max" Quantity => Quantity, 1, if b > a { b } else { a };
                Pow "" Quantity => Derived, 5, math::pow(a, b);
                Atan2 "atan2" Quantity => Angle, 5, math::atan2(a, b);
                Hypot "" Quantity => Quantity, 5, math::hypot(a, b);
                Eq "" Quantity => Truth, 1, f64::from(a == b);
                Ne "" Quantity => Truth, 1, f64::from(a != b);
                Lt "" Quantity => Truth, 1, f64::from(a < b);
                Le "" Quantity => Truth, 1, f64::from(a <= b);
                And "" Truth => Truth, 1, f64::from((a != 0.0) & (b != 0.0));
                Or "" Truth => Truth, 1, f64::from((a != 0.0) | (b != 0.0));
            }
        }
    };
}
pub(crate) use operators;

/// One enum of operators with what the table says of each.
macro_rules! operator_enum {
    (
        $(#[$doc:meta])* $set:ident ($($operand:ident),*)
        { $($variant:ident $name:literal $takes:ident => $gives:ident, $cost:literal, $formula:expr;)* }
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[allow(missing_docs, reason = "each is the function of that name")]
        pub enum $set { $($variant,)* }

        impl $set {
            /// Every one, in the order of the table.
            pub const ALL: &'static [$set] = &[$($set::$variant,)*];

            /// Its name as a function of the language; empty if the language writes it otherwise.
            pub const fn name(self) -> &'static str {
                match self { $($set::$variant => $name,)* }
            }

            /// The function of that name.
            pub fn named(name: &str) -> Option<Self> {
                let mut functions = Self::ALL.iter().filter(|op| !op.name().is_empty());
                functions.find(|op| op.name() == name).copied()
            }

            /// The kind of every operand.
            pub const fn takes(self) -> Kind {
                match self { $($set::$variant => Kind::$takes,)* }
            }

            /// The kind of the result.
            pub const fn gives(self) -> Kind {
                match self { $($set::$variant => Kind::$gives,)* }
            }

            /// What it costs in additions, roughly.
            pub const fn cost(self) -> u32 {
                match self { $($set::$variant => $cost,)* }
            }

            /// The value, by the rules of IEEE 754.
            #[inline(always)]
            pub fn apply(self, $($operand: f64),*) -> f64 {
                match self { $($set::$variant => $formula,)* }
            }
        }
    };
}

macro_rules! operator_enums {
    (
        unary ($a:ident) { $($u:ident $un:literal $ut:ident => $ug:ident, $uc:literal, $uf:expr;)* }
        binary ($x:ident, $y:ident) { $($b:ident $bn:literal $bt:ident => $bg:ident, $bc:literal, $bf:expr;)* }
    ) => {
        operator_enum! {
            /// Functions of one operand.
            Unary ($a) { $($u $un $ut => $ug, $uc, $uf;)* }
        }
        operator_enum! {
            /// Functions of two operands.
            Binary ($x, $y) { $($b $bn $bt => $bg, $bc, $bf;)* }
        }
    };
}
operators!(operator_enums);
