//! Statements.
//!
//! A `let` is computed where it is read, unless something that it reads is about to change while it is still to be
//! read; then it is computed before the change. The draws of a statement are those in its own expressions: a branch's
//! condition draws before the branch, the statements inside draw for themselves.

use super::code::{Op, Register};
use super::compiler::{Binding, Compiler, Label, TooLarge};
use super::layout::Fixed;
use crate::ir::expr::{Local, Temp};
use crate::ir::law::{Block, Law, Stmt};
use crate::ir::program::State;
use crate::ir::tree::Status;
use crate::ir::{Expr, ExprId, Id};

/// Something whose value changes while code runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slot {
    State(Id<State>),
    Local(Id<Local>),
    Temp(Id<Temp>),
}

impl<'a> Compiler<'a> {
    /// A behaviour's tick: its partition in the order U, S, F, R, then its control law. The answer is the
    /// [`Status`] as a number: success 0, failure 1, running 2.
    ///
    /// # Errors
    /// If registers run out.
    pub fn law(&mut self, law: &'a Law) -> Result<(), TooLarge> {
        let (mut success, mut failure) = (Label::default(), Label::default());
        self.condition(law.requires, false, &mut failure)?;
        self.condition(law.succeed, true, &mut success)?;
        self.condition(law.fail, true, &mut failure)?;
        self.block(&law.control)?;
        self.exit(answer(Status::Running));
        if success.is_used() {
            self.bind(success);
            self.exit(answer(Status::Success));
        }
        if failure.is_used() {
            self.bind(failure);
            self.exit(answer(Status::Failure));
        }
        Ok(())
    }

    /// The tick of a behaviour that is declared only: failure.
    pub fn fail(&mut self) {
        self.exit(answer(Status::Failure));
    }

    /// Sets a behaviour's variables as it starts.
    ///
    /// # Errors
    /// If registers run out.
    pub fn locals(&mut self, law: &Law) -> Result<(), TooLarge> {
        for (id, local) in law.locals.iter() {
            self.set_local(id, local.initial)?;
        }
        Ok(())
    }

    /// A block of statements.
    ///
    /// # Errors
    /// If registers run out.
    pub fn block(&mut self, block: &'a Block) -> Result<(), TooLarge> {
        let mut statements = block.0.as_slice();
        while let Some((statement, rest)) = statements.split_first() {
            self.rest.push(rest);
            self.statement(statement)?;
            self.rest.pop();
            statements = rest;
        }
        Ok(())
    }

    fn statement(&mut self, statement: &'a Stmt) -> Result<(), TooLarge> {
        match statement {
            Stmt::Let(temp, value) => self.bind_name(*temp, *value),
            Stmt::SetState(state, value) => self.set_state(*state, *value),
            Stmt::SetLocal(local, value) => self.set_local(*local, *value),
            Stmt::If(condition, then, otherwise) => self.branch(*condition, then, otherwise),
            Stmt::Drive {
                speed,
                strafe,
                turn,
            } => {
                let draws = self.draws(&[*speed, *strafe, *turn])?;
                for (register, value) in [
                    (Fixed::Speed, speed),
                    (Fixed::Strafe, strafe),
                    (Fixed::Turn, turn),
                ] {
                    // A tick begins with all three at rest.
                    if self.pool.constant(*value) != Some(0.0) {
                        self.assign(register.register(), *value)?;
                    }
                }
                self.undraw(&draws);
                Ok(())
            }
        }
    }

    /// Sets registers, each to the value of its expression before any of them is set.
    ///
    /// # Errors
    /// If registers run out.
    pub fn assign_all(&mut self, pairs: &[(Register, ExprId)]) -> Result<(), TooLarge> {
        let expressions: Vec<_> = pairs.iter().map(|&(_, id)| id).collect();
        let draws = self.draws(&expressions)?;
        let values = expressions
            .iter()
            .map(|&id| self.held(id))
            .collect::<Result<Vec<_>, _>>()?;
        for (&(register, _), value) in pairs.iter().zip(values) {
            self.emit(Op::Move, register, value, 0);
        }
        self.undraw(&draws);
        Ok(())
    }

    /// Sets a state variable.
    ///
    /// # Errors
    /// If registers run out.
    pub fn set_state(&mut self, state: Id<State>, value: ExprId) -> Result<(), TooLarge> {
        let draws = self.draws(&[value])?;
        self.settle(Slot::State(state))?;
        self.assign(self.layout.state(state), value)?;
        self.changed(Slot::State(state));
        self.undraw(&draws);
        Ok(())
    }

    fn set_local(&mut self, local: Id<Local>, value: ExprId) -> Result<(), TooLarge> {
        let draws = self.draws(&[value])?;
        self.settle(Slot::Local(local))?;
        self.assign(self.local(local.index()), value)?;
        self.changed(Slot::Local(local));
        self.undraw(&draws);
        Ok(())
    }

    fn bind_name(&mut self, temp: Id<Temp>, value: ExprId) -> Result<(), TooLarge> {
        self.settle(Slot::Temp(temp))?;
        let draws = self.draws(&[value])?;
        let itself = self.pool.any(value, &mut |expr| expr == Expr::Temp(temp));
        let binding = if draws.is_empty() && !itself {
            Binding::Deferred(value)
        } else {
            Binding::Known(self.held(value)?)
        };
        self.changed(Slot::Temp(temp));
        self.temps.insert(temp, binding);
        self.undraw(&draws);
        Ok(())
    }

    fn branch(
        &mut self,
        condition: ExprId,
        then: &'a Block,
        otherwise: &'a Block,
    ) -> Result<(), TooLarge> {
        let draws = self.draws(&[condition])?;
        if let Some(value) = self.pool.constant(condition) {
            return self.block(if value == 0.0 { otherwise } else { then });
        }
        self.rest.push(&then.0);
        self.rest.push(&otherwise.0);
        let mut slots = Vec::new();
        assigned(then, &mut slots);
        assigned(otherwise, &mut slots);
        for slot in slots {
            self.settle(slot)?;
        }
        self.rest.pop();
        self.rest.pop();

        let mut no = Label::default();
        let known = self.condition(condition, false, &mut no)?;
        self.undraw(&draws);
        let (temps, scratch) = (self.temps.clone(), self.scratch);
        self.block(then)?;
        self.temps.clone_from(&temps);
        if otherwise.0.is_empty() {
            self.bind(no);
        } else {
            let mut end = Label::default();
            self.jump(Op::Jump, &mut end, 0, 0);
            self.bind(no);
            self.memo.forget(known);
            self.scratch = scratch;
            self.block(otherwise)?;
            self.bind(end);
            self.temps = temps;
        }
        self.memo.forget(known);
        self.scratch = scratch;
        Ok(())
    }

    /// The value of an expression in a register that nothing else changes.
    fn held(&mut self, id: ExprId) -> Result<Register, TooLarge> {
        let fresh = self.scratch;
        let register = self.value(id)?;
        let mutable = usize::from(register) < self.layout.scratch();
        if mutable && usize::from(register) < fresh {
            let copy = self.fresh()?;
            self.emit(Op::Move, copy, register, 0);
            return Ok(copy);
        }
        Ok(register)
    }

    /// Makes the draws of a statement, in the order of their numbers.
    fn draws(&mut self, expressions: &[ExprId]) -> Result<Vec<ExprId>, TooLarge> {
        let mut draws = Vec::new();
        for &id in expressions {
            self.collect_draws(id, &mut draws);
        }
        draws.sort_unstable();
        draws.dedup();
        draws.sort_by_key(|&(number, _)| number);
        for &(_, id) in &draws {
            self.memo.invalidate(|known| known == id);
            self.value(id)?;
        }
        Ok(draws.into_iter().map(|(_, id)| id).collect())
    }

    fn collect_draws(&self, id: ExprId, draws: &mut Vec<(u32, ExprId)>) {
        let mut seen = rustc_hash::FxHashSet::default();
        let mut open = vec![id];
        while let Some(id) = open.pop() {
            if seen.insert(id) {
                if let Expr::Draw(number, _) = self.pool.get(id) {
                    draws.push((number, id));
                }
                open.extend(self.pool.operands(id));
            }
        }
    }

    /// The draws of a statement are over: the next statement draws anew.
    fn undraw(&mut self, draws: &[ExprId]) {
        if !draws.is_empty() {
            let pool = self.pool;
            self.memo.invalidate(|id| {
                pool.any(id, &mut |expr| {
                    draws.iter().any(|&draw| pool.get(draw) == expr)
                })
            });
        }
    }

    /// Computes the deferred names that read a slot which is about to change and that are still to be read.
    fn settle(&mut self, slot: Slot) -> Result<(), TooLarge> {
        let mut pending: Vec<_> = self
            .temps
            .iter()
            .filter_map(|(&temp, binding)| match binding {
                Binding::Deferred(value) => Some((temp, *value)),
                Binding::Known(_) => None,
            })
            .filter(|&(temp, value)| {
                slot != Slot::Temp(temp) && self.reads(value, slot) && self.is_read(temp)
            })
            .collect();
        // In order of their making, whatever the order of the map.
        pending.sort_unstable();
        for (temp, value) in pending {
            let register = self.held(value)?;
            self.temps.insert(temp, Binding::Known(register));
        }
        Ok(())
    }

    /// Forgets what was computed from a slot that has changed.
    fn changed(&mut self, slot: Slot) {
        let mut memo = std::mem::take(&mut self.memo);
        memo.invalidate(|id| self.reads(id, slot));
        self.memo = memo;
    }

    /// Whether an expression reads a slot, itself or through a name that is not yet computed.
    fn reads(&self, id: ExprId, slot: Slot) -> bool {
        self.pool.any(id, &mut |expr| match expr {
            Expr::State(state) => slot == Slot::State(state),
            Expr::Local(local) => slot == Slot::Local(local),
            Expr::Temp(temp) => {
                slot == Slot::Temp(temp)
                    || match self.temps.get(&temp) {
                        Some(&Binding::Deferred(value)) => self.reads(value, slot),
                        _ => false,
                    }
            }
            _ => false,
        })
    }

    /// Whether a name is read by what follows, or by another name that is not yet computed.
    fn is_read(&self, temp: Id<Temp>) -> bool {
        let here = |id: ExprId| self.pool.any(id, &mut |expr| expr == Expr::Temp(temp));
        self.rest.iter().any(|rest| mentions(rest, &here))
            || self.temps.values().any(|binding| match binding {
                Binding::Deferred(value) => here(*value),
                Binding::Known(_) => false,
            })
    }
}

/// The number by which code answers with a status.
fn answer(status: Status) -> u16 {
    match status {
        Status::Success => 0,
        Status::Failure => 1,
        Status::Running => 2,
    }
}

fn mentions(statements: &[Stmt], here: &impl Fn(ExprId) -> bool) -> bool {
    statements.iter().any(|statement| match statement {
        Stmt::Let(_, value) | Stmt::SetState(_, value) | Stmt::SetLocal(_, value) => here(*value),
        Stmt::If(condition, then, otherwise) => {
            here(*condition) || mentions(&then.0, here) || mentions(&otherwise.0, here)
        }
        Stmt::Drive {
            speed,
            strafe,
            turn,
        } => here(*speed) || here(*strafe) || here(*turn),
    })
}

/// The slots that a block changes, names apart: those are its own.
fn assigned(block: &Block, slots: &mut Vec<Slot>) {
    for statement in &block.0 {
        match statement {
            Stmt::SetState(state, _) => slots.push(Slot::State(*state)),
            Stmt::SetLocal(local, _) => slots.push(Slot::Local(*local)),
            Stmt::If(_, then, otherwise) => {
                assigned(then, slots);
                assigned(otherwise, slots);
            }
            Stmt::Let(..) | Stmt::Drive { .. } => {}
        }
    }
}
