//! Behaviours: control laws with their partition of the state space (paper, sections II-C and V).

use super::expr::{ExprId, Local, Temp};
use super::name::Name;
use super::program::State;
use super::table::{Id, Table};

/// A behaviour with its arguments, such as `goto(A)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Behavior {
    /// Its name, with its arguments.
    pub name: Name,
    /// What it does; `None` if it is declared only.
    pub law: Option<Law>,
}

/// What a behaviour does: its partition {U, S, F, R} and the control law of R.
#[derive(Clone, Debug, PartialEq)]
pub struct Law {
    /// The behaviour's own variables, set in this order when it starts.
    pub locals: Table<Local>,
    /// U is where this does not hold: failure, nothing is driven.
    pub requires: ExprId,
    /// S, looked at next: success.
    pub succeed: ExprId,
    /// F, looked at next: failure.
    pub fail: ExprId,
    /// Runs everywhere else, R.
    pub control: Block,
}

/// Statements in sequence.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Block(pub Vec<Stmt>);

impl Block {
    /// Whether it commands the wheels on some path.
    pub fn may_drive(&self) -> bool {
        self.0.iter().any(|stmt| match stmt {
            Stmt::Drive { .. } => true,
            Stmt::If(_, then, otherwise) => then.may_drive() || otherwise.may_drive(),
            _ => false,
        })
    }
}

/// A statement of a control law or of an effect.
///
/// A random draw is made once in a block, before the first statement that reads it, whichever branch of an expression does:
/// all that read it in the block, and in blocks within it, get one value. Draws of a statement are made in the order of
/// their ids.
#[derive(Clone, Debug, PartialEq)]
pub enum Stmt {
    /// Binds a name; the value is that of this moment.
    Let(Id<Temp>, ExprId),
    /// Sets a state variable; effects and control laws may.
    SetState(Id<State>, ExprId),
    /// Sets a variable of the behaviour.
    SetLocal(Id<Local>, ExprId),
    /// A branch.
    If(ExprId, Block, Block),
    /// Commands the wheels for this tick; at most one on each path.
    Drive {
        /// Forward speed in m/s.
        speed: ExprId,
        /// Speed to the left in m/s; zero for a differential drive.
        strafe: ExprId,
        /// Rate of turn in rad/s, counter-clockwise.
        turn: ExprId,
    },
}
