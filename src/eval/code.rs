//! The instructions of the register machine: one for each operator of the language, and the machine's own.

#[cfg(feature = "native")]
use super::native::Native;
use crate::ir::expr::{Binary, Unary};
use crate::ir::operator::operators;
#[cfg(feature = "native")]
use std::sync::OnceLock;

/// A register's number.
pub type Register = u16;

macro_rules! instructions {
    (
        unary ($a:ident) { $($unary:ident $un:literal $ut:ident => $ug:ident, $uc:literal, $uf:expr;)* }
        binary ($x:ident, $y:ident) { $($binary:ident $bn:literal $bt:ident => $bg:ident, $bc:literal, $bf:expr;)* }
    ) => {
        /// What an instruction does. `a`, `b` and `dst` are registers unless it says otherwise.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(u8)]
        #[allow(missing_docs, reason = "operators are named after the function")]
        pub enum Op {
            // `dst = op a`
            $($unary,)*
            // `dst = a op b`
            $($binary,)*
            /// `dst = a`
            Move,
            /// `dst` = the direction of the vector of x coordinate `b` and y coordinate `a`, in [−π, π)
            Direction,
            /// `dst = a² + b²`
            SquareSum,
            /// `dst = a − b`, wrapped to [−π, π)
            WrapSub,
            /// `dst = a`, kept within ±b
            Clamp,
            /// Goes on at the instruction `dst`.
            Jump,
            // Goes on at `dst` where the condition on `a` (and `b`) holds, or does not.
            JumpIf,
            JumpUnless,
            JumpEq,
            JumpNe,
            JumpLt,
            JumpLe,
            JumpUnlessLt,
            JumpUnlessLe,
            /// `dst` = whether no wall stands between the robot and the point (`a`, `b`).
            Visible,
            /// The second of the two registers from `dst` says whether no wall stands between the robot and the fixed point (`a`,
            /// `b`). It is asked anew where the robot has come farther than the first says.
            Sees,
            /// `dst` = whether the nearest wall is nearer than `b`. It is looked at, into the four registers from `a`, where
            /// [`Fixed::Clear`](super::Fixed::Clear) does not say that it is farther.
            Nearer,
            /// `dst` = whether the nearest wall is as near as `b`, as above.
            Within,
            /// Fills the four registers from `dst` with echo source number `a`: distance, x and y of the vector to it,
            /// seen.
            Look,
            /// `dst` = whether the robot is in place number `a`.
            Inside,
            /// `dst` = uniform in [a, b).
            Uniform,
            /// `dst` = Gaussian of mean `a` and standard deviation `b`.
            Normal,
            /// `dst` = true with probability `a`.
            Chance,
            /// `dst` = one of 0 … a − 1.
            Pick,
            /// Reports event number `a`.
            Fire,
            /// Sets bit number `dst` of the atoms where `a` holds.
            Atom,
            /// Ends the run with the answer `a`.
            Exit,
        }

        impl From<Unary> for Op {
            fn from(op: Unary) -> Self {
                match op { $(Unary::$unary => Op::$unary,)* }
            }
        }

        impl From<Binary> for Op {
            fn from(op: Binary) -> Self {
                match op { $(Binary::$binary => Op::$binary,)* }
            }
        }

        impl Op {
            /// The value of an operator of the language; `None` for every other instruction.
            #[inline(always)]
            pub(super) fn apply(self, a: impl Fn() -> f64, b: impl Fn() -> f64) -> Option<f64> {
                match self {
                    $(Op::$unary => Some(Unary::$unary.apply(a())),)*
                    $(Op::$binary => Some(Binary::$binary.apply(a(), b())),)*
                    _ => None,
                }
            }
        }
    };
}
operators!(instructions);

impl Op {
    /// Whether all it does is to set `dst`.
    pub(super) fn makes_a_value(self) -> bool {
        !self.jumps() && !matches!(self, Op::Look | Op::Sees | Op::Fire | Op::Atom | Op::Exit)
    }

    /// Whether it may go on elsewhere, at `dst`.
    pub(super) fn jumps(self) -> bool {
        matches!(
            self,
            Op::Jump
                | Op::JumpIf
                | Op::JumpUnless
                | Op::JumpEq
                | Op::JumpNe
                | Op::JumpLt
                | Op::JumpLe
                | Op::JumpUnlessLt
                | Op::JumpUnlessLe
        )
    }
}

/// An instruction: eight bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Instruction {
    /// What it does.
    pub op: Op,
    /// Where its result goes.
    pub dst: Register,
    /// Its first operand.
    pub a: Register,
    /// Its second operand.
    pub b: Register,
}

/// A compiled piece of a program. A run that reaches the end answers 0.
#[derive(Clone, Debug, Default)]
pub struct Code {
    instructions: Box<[Instruction]>,
    /// The same as machine code, once it is there.
    #[cfg(feature = "native")]
    pub(super) native: OnceLock<Native>,
}

impl Code {
    /// The instructions.
    #[inline]
    pub fn instructions(&self) -> &[Instruction] {
        &self.instructions
    }
}

impl Code {
    pub(super) fn new(instructions: Vec<Instruction>) -> Self {
        Self {
            instructions: instructions.into(),
            #[cfg(feature = "native")]
            native: OnceLock::new(),
        }
    }
}

const _: () = assert!(size_of::<Instruction>() == 8);
