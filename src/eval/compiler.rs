//! The compiler: one piece of code at a time, over one layout.

use super::code::{Code, Instruction, Op, Register};
use super::layout::{Fixed, Layout};
use super::memo::Memo;
use crate::ir::expr::{Local, Pose, Temp};
use crate::ir::law::Behavior;
use crate::ir::program::{Event, State};
use crate::ir::world::Robot;
use crate::ir::{Expr, ExprId, Id, Pool};
use rustc_hash::FxHashMap;
use std::fmt;

/// The program does not fit the machine: too many registers or instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TooLarge;

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(
            "the program has more variables, constants and walls that are asked for than fit 4096 registers",
        )
    }
}

impl std::error::Error for TooLarge {}

/// Compiles one piece of code; [`Compiler::finish`] gives it.
pub struct Compiler<'a> {
    pub(super) pool: &'a Pool,
    pub(super) layout: &'a mut Layout,
    /// Whose variables `Expr::Local` means.
    behavior: Option<Id<Behavior>>,
    pub(super) code: Vec<Instruction>,
    pub(super) memo: Memo,
    /// The next free scratch register.
    pub(super) scratch: usize,
    /// Where the last label stands: the instruction before it is not the only way to the one after it.
    label: usize,
    pub(super) temps: FxHashMap<Id<Temp>, Binding>,
    /// Whether the code reads how long the behaviour has run.
    pub(super) timed: bool,
}

/// What a name stands for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Binding {
    /// A value that was computed.
    Known(Register),
    /// A value that is computed where it is read.
    Deferred(ExprId),
}

/// Jumps that wait for the place that they go to.
#[derive(Debug, Default)]
pub struct Label(Vec<usize>);

impl<'a> Compiler<'a> {
    /// A compiler for a piece of code of no behaviour, or of one.
    pub fn new(pool: &'a Pool, layout: &'a mut Layout, behavior: Option<Id<Behavior>>) -> Self {
        let scratch = layout.scratch();
        Self {
            pool,
            layout,
            behavior,
            code: Vec::new(),
            memo: Memo::default(),
            scratch,
            label: 0,
            temps: FxHashMap::default(),
            timed: false,
        }
    }

    /// The code.
    ///
    /// # Errors
    /// If jumps cannot reach across it.
    pub fn finish(self) -> Result<Code, TooLarge> {
        if self.code.len() > usize::from(Register::MAX) {
            return Err(TooLarge);
        }
        Ok(Code::new(self.code))
    }

    /// Sets a register to the value of an expression.
    ///
    /// # Errors
    /// If registers run out.
    pub fn assign(&mut self, register: Register, mut id: ExprId) -> Result<(), TooLarge> {
        while let Expr::Temp(temp) = self.pool.get(id)
            && let Some(&Binding::Deferred(value)) = self.temps.get(&temp)
        {
            id = value;
        }
        if let Expr::Select(condition, then, otherwise) = self.pool.get(id)
            && Fixed::is_output(register)
            && self.memo.get(id).is_none()
        {
            self.select_into(register, [condition, then, otherwise])?;
            self.memo.insert(id, register);
            return Ok(());
        }
        let before = self.code.len();
        let fresh = self.scratch;
        let value = self.value(id)?;
        // Where the last instruction made the value, it writes straight to the register.
        if self.code.len() > before
            && self.label != self.code.len()
            && usize::from(value) >= fresh
            && let Some(last) = self.code.last_mut()
            && last.dst == value
            && last.op.makes_a_value()
        {
            last.dst = register;
            if Fixed::is_output(register) {
                self.memo.relocate(id, register);
            } else {
                self.memo.invalidate(|known| known == id);
            }
        } else if value != register {
            self.emit(Op::Move, register, value, 0);
        }
        Ok(())
    }

    /// Computes whether an event happens, and reports it if it does.
    ///
    /// # Errors
    /// If registers run out.
    pub fn event(&mut self, event: Id<Event>, when: ExprId) -> Result<(), TooLarge> {
        let register = self.layout.event(event);
        self.assign(register, when)?;
        let mut no = Label::default();
        self.jump(Op::JumpUnless, &mut no, register, 0);
        self.emit(Op::Fire, 0, event.index() as Register, 0);
        self.bind(no);
        Ok(())
    }

    /// The register of a state variable.
    pub fn state_register(&self, state: Id<State>) -> Register {
        self.layout.state(state)
    }

    /// The register of a part of a robot's pose.
    pub fn robot_register(&self, robot: Id<Robot>, pose: Pose) -> Register {
        self.layout.robot(robot, pose)
    }

    /// Whether the code so far reads how long the behaviour has run.
    pub fn is_timed(&self) -> bool {
        self.timed
    }

    /// Reports the value of an atom.
    ///
    /// # Errors
    /// If registers run out.
    pub fn atom(&mut self, bit: u16, id: ExprId) -> Result<(), TooLarge> {
        if self.pool.constant(id) == Some(0.0) {
            return Ok(());
        }
        let value = self.value(id)?;
        self.emit(Op::Atom, bit, value, 0);
        Ok(())
    }

    /// Ends the run with an answer.
    pub fn exit(&mut self, answer: u16) {
        self.emit(Op::Exit, 0, answer, 0);
    }

    pub(super) fn emit(&mut self, op: Op, dst: Register, a: Register, b: Register) {
        self.code.push(Instruction { op, dst, a, b });
    }

    pub(super) fn jump(&mut self, op: Op, to: &mut Label, a: Register, b: Register) {
        to.0.push(self.code.len());
        self.emit(op, 0, a, b);
    }

    /// The label is here.
    pub fn bind(&mut self, label: Label) {
        let here = self.code.len();
        if !label.0.is_empty() {
            self.label = here;
        }
        for at in label.0 {
            if let Some(jump) = self.code.get_mut(at) {
                jump.dst = here as Register;
            }
        }
    }

    pub(super) fn fresh(&mut self) -> Result<Register, TooLarge> {
        let register = self.scratch;
        self.scratch += 1;
        self.layout.reserve(self.scratch)?;
        Ok(register as Register)
    }

    pub(super) fn local(&self, local: Id<Local>) -> Register {
        let first = self.behavior.map_or(0, |id| self.layout.locals(id));
        first + local.index() as Register
    }
}

impl Label {
    /// Whether anything jumps there.
    pub fn is_used(&self) -> bool {
        !self.0.is_empty()
    }
}
