//! Statements as code.

use super::actions::{Action, Moment, actions, draws};
use super::code::{Op, Register};
use super::compiler::{Binding, Compiler, Label, TooLarge};
use super::memo::Mark;
use crate::ir::law::{Block, Law, Stmt};
use crate::ir::tree::Status;
use crate::ir::{Expr, ExprId};

/// A branch whose end is still to come.
struct Branch {
    /// Where the condition does not hold.
    no: Label,
    /// Where it holds, at the end.
    end: Label,
    /// What is known on both sides.
    known: Mark,
    /// The scratch registers in use on both sides.
    scratch: usize,
}

impl Compiler<'_> {
    /// A behaviour's tick: its partition in the order U, S, F, R, then its control law. [`status`] reads the answer.
    ///
    /// # Errors
    /// If registers run out.
    pub fn law(&mut self, law: &Law) -> Result<(), TooLarge> {
        let (mut success, mut failure) = (Label::default(), Label::default());
        self.condition(law.requires, false, &mut failure)?;
        self.condition(law.succeed, true, &mut success)?;
        self.condition(law.fail, true, &mut failure)?;
        self.block(&law.control)?;
        self.exit(RUNNING);
        if success.is_used() {
            self.bind(success);
            self.exit(SUCCESS);
        }
        if failure.is_used() {
            self.bind(failure);
            self.exit(FAILURE);
        }
        Ok(())
    }

    /// The tick of a behaviour that is declared only: failure.
    pub fn fail(&mut self) {
        self.exit(FAILURE);
    }

    /// Sets a behaviour's variables as it starts.
    ///
    /// # Errors
    /// If registers run out.
    pub fn locals(&mut self, law: &Law) -> Result<(), TooLarge> {
        let locals = law.locals.iter();
        self.block(&Block(
            locals
                .map(|(id, local)| Stmt::SetLocal(id, local.initial))
                .collect(),
        ))
    }

    /// A block of statements.
    ///
    /// # Errors
    /// If registers run out.
    pub fn block(&mut self, block: &Block) -> Result<(), TooLarge> {
        let mut branches = Vec::new();
        for action in actions(self.pool, block) {
            self.action(action, &mut branches)?;
        }
        Ok(())
    }

    fn action(&mut self, action: Action, branches: &mut Vec<Branch>) -> Result<(), TooLarge> {
        match action {
            Action::Draw(id) => return self.redraw(id),
            Action::Name(temp, value, moment) => {
                let binding = match moment {
                    Moment::Now => Binding::Known(self.held(value)?),
                    Moment::WhereRead => Binding::Deferred(value),
                };
                self.temps.insert(temp, binding);
            }
            Action::SetState(state, value) => self.assign(self.layout.state(state), value)?,
            Action::SetLocal(local, value) => self.assign(self.local(local), value)?,
            Action::Command(output, value) => self.assign(output.register(), value)?,
            Action::If(condition) => {
                let mut no = Label::default();
                let known = self.condition(condition, false, &mut no)?;
                branches.push(Branch {
                    no,
                    end: Label::default(),
                    known,
                    scratch: self.scratch,
                });
            }
            Action::Else => {
                if let Some(branch) = branches.last_mut() {
                    self.jump(Op::Jump, &mut branch.end, 0, 0);
                    self.bind(std::mem::take(&mut branch.no));
                    self.memo.forget(branch.known);
                    self.scratch = branch.scratch;
                }
            }
            Action::End => {
                if let Some(branch) = branches.pop() {
                    self.bind(branch.no);
                    self.bind(branch.end);
                    self.memo.forget(branch.known);
                    self.scratch = branch.scratch;
                }
            }
        }
        if let Some(leaf) = action.changes(self.pool) {
            self.forget(leaf);
        }
        Ok(())
    }

    /// Sets registers, each to the value of its expression before any of them is set.
    ///
    /// # Errors
    /// If registers run out.
    pub fn assign_all(&mut self, pairs: &[(Register, ExprId)]) -> Result<(), TooLarge> {
        let expressions: Vec<_> = pairs.iter().map(|&(_, id)| id).collect();
        for id in draws(self.pool, &expressions) {
            self.redraw(id)?;
        }
        let values = expressions
            .iter()
            .map(|&id| self.held(id))
            .collect::<Result<Vec<_>, _>>()?;
        for (&(register, _), value) in pairs.iter().zip(values) {
            self.emit(Op::Move, register, value, 0);
        }
        Ok(())
    }

    /// The value of an expression in a register that nothing else changes.
    fn held(&mut self, id: ExprId) -> Result<Register, TooLarge> {
        let register = self.value(id)?;
        if usize::from(register) >= self.layout.scratch() {
            return Ok(register);
        }
        let copy = self.fresh()?;
        self.emit(Op::Move, copy, register, 0);
        Ok(copy)
    }

    /// Makes a draw; a value drawn before is forgotten.
    fn redraw(&mut self, id: ExprId) -> Result<(), TooLarge> {
        self.forget(self.pool.get(id));
        self.value(id).map(|_| ())
    }

    /// Forgets what was computed from a leaf that has changed. What was drawn stays as it is, whatever it was drawn from.
    fn forget(&mut self, leaf: Expr) {
        let pool = self.pool;
        self.memo.invalidate(|id| match pool.get(id) {
            drawn @ Expr::Draw(..) => drawn == leaf,
            _ => pool.any(id, &mut |expr| expr == leaf),
        });
    }
}

const SUCCESS: u16 = 0;
const FAILURE: u16 = 1;
const RUNNING: u16 = 2;

/// The status that the code of a law answers with.
#[inline]
pub fn status(answer: u16) -> Status {
    match answer {
        SUCCESS => Status::Success,
        FAILURE => Status::Failure,
        _ => Status::Running,
    }
}
