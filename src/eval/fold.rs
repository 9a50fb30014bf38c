//! Expressions and blocks under an assumption, such as that nothing has ended in this tick.

use crate::ir::law::{Block, Law, Stmt};
use crate::ir::{Expr, ExprId, Pool};
use rustc_hash::FxHashMap;

/// Rewrites expressions into their values under an assumption, in the pool that they come from.
///
/// Draws are left as they are.
pub struct Folding<'a, F> {
    pool: &'a mut Pool,
    assume: F,
    known: FxHashMap<ExprId, ExprId>,
}

impl<'a, F: Fn(Expr) -> Option<bool>> Folding<'a, F> {
    /// A folding under the truth values that `assume` gives.
    pub fn new(pool: &'a mut Pool, assume: F) -> Self {
        Self {
            pool,
            assume,
            known: FxHashMap::default(),
        }
    }

    /// An expression under the assumption.
    pub fn expr(&mut self, id: ExprId) -> ExprId {
        if let Some(&folded) = self.known.get(&id) {
            return folded;
        }
        let expr = self.pool.get(id);
        let folded = match ((self.assume)(expr), expr) {
            (Some(truth), _) => self.pool.bool(truth),
            (None, Expr::Unary(op, a)) => {
                let a = self.expr(a);
                self.pool.unary(op, a)
            }
            (None, Expr::Binary(op, a, b)) => {
                let (a, b) = (self.expr(a), self.expr(b));
                self.pool.binary(op, a, b)
            }
            (None, Expr::Select(a, b, c)) => {
                let (a, b, c) = (self.expr(a), self.expr(b), self.expr(c));
                self.pool.select(a, b, c)
            }
            (None, Expr::Visible(a, b)) => {
                let (a, b) = (self.expr(a), self.expr(b));
                self.pool.leaf(Expr::Visible(a, b))
            }
            (None, _) => id,
        };
        self.known.insert(id, folded);
        folded
    }

    /// A block under the assumption, without the branches that it excludes.
    pub fn block(&mut self, block: &Block) -> Block {
        let mut folded = Vec::with_capacity(block.0.len());
        for statement in &block.0 {
            match statement {
                Stmt::Let(temp, value) => folded.push(Stmt::Let(*temp, self.expr(*value))),
                Stmt::SetState(state, value) => {
                    folded.push(Stmt::SetState(*state, self.expr(*value)));
                }
                Stmt::SetLocal(local, value) => {
                    folded.push(Stmt::SetLocal(*local, self.expr(*value)));
                }
                Stmt::If(condition, then, otherwise) => {
                    let condition = self.expr(*condition);
                    match self.pool.constant(condition) {
                        Some(0.0) => folded.extend(self.block(otherwise).0),
                        Some(_) => folded.extend(self.block(then).0),
                        None => folded.push(Stmt::If(
                            condition,
                            self.block(then),
                            self.block(otherwise),
                        )),
                    }
                }
                Stmt::Drive {
                    speed,
                    strafe,
                    turn,
                } => folded.push(Stmt::Drive {
                    speed: self.expr(*speed),
                    strafe: self.expr(*strafe),
                    turn: self.expr(*turn),
                }),
            }
        }
        Block(folded)
    }

    /// A control law under the assumption.
    pub fn law(&mut self, law: &Law) -> Law {
        Law {
            locals: law.locals.clone(),
            requires: self.expr(law.requires),
            succeed: self.expr(law.succeed),
            fail: self.expr(law.fail),
            control: self.block(&law.control),
        }
    }
}
