//! Expressions as jumps.

use super::code::{Op, Register};
use super::compiler::{Binding, Compiler, Label, TooLarge};
use super::memo::Mark;
use crate::ir::expr::{Binary, Unary};
use crate::ir::{Expr, ExprId};

impl Compiler<'_> {
    /// Jumps to `target` if the expression has the value `when`, and goes on here if not.
    ///
    /// The mark that it gives bounds what is known at `target`: what was computed before the first jump there.
    ///
    /// # Errors
    /// If registers run out.
    pub fn jump_where(
        &mut self,
        id: ExprId,
        when: bool,
        target: &mut Label,
    ) -> Result<(), TooLarge> {
        self.condition(id, when, target).map(|_| ())
    }

    pub(super) fn condition(
        &mut self,
        id: ExprId,
        when: bool,
        target: &mut Label,
    ) -> Result<Mark, TooLarge> {
        if self.memo.get(id).is_none() {
            match self.pool.get(id) {
                Expr::Unary(Unary::Not, a) => return self.condition(a, !when, target),
                Expr::Binary(Binary::And, a, b) => return self.both(a, b, when, target),
                Expr::Binary(Binary::Or, a, b) => return self.either(a, b, when, target),
                Expr::Binary(op @ (Binary::Eq | Binary::Ne | Binary::Lt | Binary::Le), a, b) => {
                    return self.comparison(op, a, b, when, target);
                }
                Expr::Temp(temp) => {
                    if let Some(&Binding::Deferred(value)) = self.temps.get(&temp) {
                        return self.condition(value, when, target);
                    }
                }
                Expr::Num(_) | Expr::Bool(_) => {
                    if (self.pool.constant(id) != Some(0.0)) == when {
                        self.jump(Op::Jump, target, 0, 0);
                    }
                    return Ok(self.memo.mark());
                }
                _ => {}
            }
        }
        let value = self.value(id)?;
        Ok(self.jump_on(value, when, target))
    }

    /// Jumps to `target` if the truth value of a register is `when`.
    fn jump_on(&mut self, value: Register, when: bool, target: &mut Label) -> Mark {
        let known = self.memo.mark();
        let op = if when { Op::JumpIf } else { Op::JumpUnless };
        self.jump(op, target, value, 0);
        known
    }

    /// `a and b`
    fn both(
        &mut self,
        a: ExprId,
        b: ExprId,
        when: bool,
        target: &mut Label,
    ) -> Result<Mark, TooLarge> {
        if when {
            let mut no = Label::default();
            let without_b = self.condition(a, false, &mut no)?;
            let known = self.condition(b, true, target)?;
            self.bind(no);
            self.memo.forget(without_b);
            Ok(known.min(without_b))
        } else {
            let known = self.condition(a, false, target)?;
            Ok(known.min(self.condition(b, false, target)?))
        }
    }

    /// `a or b`
    fn either(
        &mut self,
        a: ExprId,
        b: ExprId,
        when: bool,
        target: &mut Label,
    ) -> Result<Mark, TooLarge> {
        if when {
            let known = self.condition(a, true, target)?;
            Ok(known.min(self.condition(b, true, target)?))
        } else {
            let mut yes = Label::default();
            let without_b = self.condition(a, true, &mut yes)?;
            let known = self.condition(b, false, target)?;
            self.bind(yes);
            self.memo.forget(without_b);
            Ok(known.min(without_b))
        }
    }

    fn comparison(
        &mut self,
        op: Binary,
        a: ExprId,
        b: ExprId,
        when: bool,
        target: &mut Label,
    ) -> Result<Mark, TooLarge> {
        if let Some(near) = self.near(op, a, b)? {
            return Ok(self.jump_on(near, when, target));
        }
        // Farther than something is not as near, and the other way round, where both are numbers.
        let turned = match op {
            Binary::Lt => Binary::Le,
            Binary::Le => Binary::Lt,
            other => other,
        };
        let is_number = self.pool.constant(a).is_some_and(|a| !a.is_nan());
        if is_number && let Some(near) = self.near(turned, b, a)? {
            return Ok(self.jump_on(near, !when, target));
        }
        let (a, b) = self.compared(op, a, b)?;
        let op = match (op, when) {
            (Binary::Eq, true) | (Binary::Ne, false) => Op::JumpEq,
            (Binary::Eq, false) | (Binary::Ne, true) => Op::JumpNe,
            (Binary::Lt, true) => Op::JumpLt,
            (Binary::Lt, false) => Op::JumpUnlessLt,
            (_, true) => Op::JumpLe,
            (_, false) => Op::JumpUnlessLe,
        };
        let known = self.memo.mark();
        self.jump(op, target, a, b);
        Ok(known)
    }
}
