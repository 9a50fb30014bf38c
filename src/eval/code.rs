//! The instructions of the register machine.

/// A register's number.
pub type Register = u16;

/// What an instruction does. `a`, `b` and `dst` are registers unless it says otherwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
#[allow(missing_docs, reason = "arithmetic is named after the function")]
pub enum Op {
    /// `dst = a`
    Move,
    // `dst = a op b`
    Add,
    Sub,
    Mul,
    Div,
    Min,
    Max,
    Pow,
    Atan2,
    Hypot,
    Eq,
    Ne,
    Lt,
    Le,
    And,
    Or,
    /// `dst` = the direction of the vector of x coordinate `b` and y coordinate `a`, in [−π, π)
    Direction,
    /// `dst = a² + b²`
    SquareSum,
    /// `dst = a − b`, wrapped to [−π, π)
    WrapSub,
    /// `dst = a`, kept within ±b
    Clamp,
    // `dst = op a`
    Neg,
    Not,
    Abs,
    Sign,
    Sqrt,
    Exp,
    Ln,
    Floor,
    Ceil,
    Round,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Wrap,
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
    /// Fills the four registers from `dst` with echo source number `a`: distance, x and y of the vector to it, seen.
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
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Code(pub(super) Box<[Instruction]>);

impl Code {
    /// The instructions.
    pub fn instructions(&self) -> &[Instruction] {
        &self.0
    }

    /// Whether a run does nothing.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

const _: () = assert!(size_of::<Instruction>() == 8);
