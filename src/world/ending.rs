//! The end of a tick: events, reward, effects and predicates (steps 5 to 8).

use super::atoms::Atoms;
use super::error::BuildError;
use crate::eval::{Compiler, Fixed, Folding, Label, TooLarge};
use crate::ir::expr::Binary;
use crate::ir::law::{Block, Stmt};
use crate::ir::task::Task;
use crate::ir::{Expr, ExprId, Id, Pool, Program};

/// The answer of the quiet end if an event happens after all.
pub(super) const NOT_QUIET: u16 = 1;

/// What the code of an end has to say.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// The reward of a tick in which nothing happens is not always the same.
    pub(super) rewards: bool,
    /// What ticks pay is not always the same.
    pub(super) flows: bool,
    /// The predicates are read at once.
    pub(super) reads: bool,
}

/// What the end of a tick computes.
#[derive(Clone, Debug)]
pub(super) struct Ending {
    events: Vec<ExprId>,
    /// Whether a rewarded event fires.
    closed: ExprId,
    /// The number of the line of `end on` that fires, counted from one.
    end: ExprId,
    reward: ExprId,
    pub(super) otherwise: ExprId,
    /// What the tick pays, whatever happens in it.
    pub(super) flow: ExprId,
    effects: Block,
    predicates: Vec<(u16, ExprId)>,
}

impl Ending {
    pub(super) fn new(
        program: &Program,
        task: &Task,
        atoms: &Atoms,
        pool: &mut Pool,
    ) -> Result<Self, BuildError> {
        let tick = program.world.as_ref().map_or(0.0, |world| world.tick);
        let (tick, none) = (pool.num(tick), pool.num(0.0));
        let mut flow = none;
        for price in &task.prices {
            let paid = pool.binary(Binary::Mul, price.per_second, tick);
            let paid = pool.select(price.during, paid, none);
            flow = match flow == none {
                true => paid,
                false => pool.binary(Binary::Add, flow, paid),
            };
        }
        let mut closed = pool.bool(false);
        let mut reward = task.otherwise;
        for line in task.reward.iter().rev() {
            closed = pool.or(line.event, closed);
            reward = pool.select(line.event, line.value, reward);
        }
        let mut end = pool.num(0.0);
        for (i, &line) in task.end_on.iter().enumerate().rev() {
            let number = pool.num((i + 1) as f64);
            end = pool.select(line, number, end);
        }
        // All conditions are evaluated before the first effect. A plain event has its value already, and folds where
        // it cannot happen; any other condition gets a name.
        let (mut conditions, mut effects) = (Vec::new(), Vec::new());
        for (i, effect) in program.effects.iter().enumerate() {
            let mut condition = effect.on;
            if !matches!(pool.get(condition), Expr::Event(_)) {
                let name = Id::new(program.temps.len() + i);
                conditions.push(Stmt::Let(name, condition));
                condition = pool.leaf(Expr::Temp(name));
            }
            effects.push(Stmt::If(condition, effect.block.clone(), Block::default()));
        }
        conditions.append(&mut effects);
        let predicates = atoms
            .predicates()
            .map(|(bit, id)| {
                let predicate = &program.predicates[id];
                let when = predicate.when;
                when.map(|when| (bit, when))
                    .ok_or_else(|| BuildError::Declared(predicate.name.clone()))
            })
            .collect::<Result<_, _>>()?;
        Ok(Self {
            events: program.events.values().map(|event| event.when).collect(),
            closed,
            end,
            reward,
            otherwise: task.otherwise,
            flow,
            effects: Block(conditions),
            predicates,
        })
    }

    pub(super) fn fold<F: Fn(Expr) -> Option<bool>>(&self, folding: &mut Folding<'_, F>) -> Self {
        Self {
            events: self.events.iter().map(|&id| folding.expr(id)).collect(),
            closed: folding.expr(self.closed),
            end: folding.expr(self.end),
            reward: folding.expr(self.reward),
            otherwise: folding.expr(self.otherwise),
            flow: folding.expr(self.flow),
            effects: folding.block(&self.effects),
            predicates: self
                .predicates
                .iter()
                .map(|&(bit, id)| (bit, folding.expr(id)))
                .collect(),
        }
    }

    pub(super) fn read_predicates(&self, compiler: &mut Compiler<'_>) -> Result<(), TooLarge> {
        self.predicates
            .iter()
            .try_for_each(|&(bit, id)| compiler.atom(bit, id))
    }

    /// Everything, in order.
    pub(super) fn compile(&self, end: End, compiler: &mut Compiler<'_>) -> Result<(), TooLarge> {
        for (i, &when) in self.events.iter().enumerate() {
            compiler.event(Id::new(i), when)?;
        }
        compiler.assign(Fixed::Closed.register(), self.closed)?;
        compiler.assign(Fixed::Reward.register(), self.reward)?;
        compiler.assign(Fixed::End.register(), self.end)?;
        if end.flows {
            compiler.assign(Fixed::Flow.register(), self.flow)?;
        }
        compiler.block(&self.effects)?;
        if end.reads {
            self.read_predicates(compiler)?;
        }
        Ok(())
    }

    /// What is left where nothing has terminated and no event happens.
    pub(super) fn compile_quiet(
        &self,
        end: End,
        compiler: &mut Compiler<'_>,
    ) -> Result<(), TooLarge> {
        let mut happens = Label::default();
        for &when in &self.events {
            compiler.jump_where(when, true, &mut happens)?;
        }
        compiler.jump_where(self.closed, true, &mut happens)?;
        compiler.jump_where(self.end, true, &mut happens)?;
        if end.rewards {
            compiler.assign(Fixed::Reward.register(), self.otherwise)?;
        }
        if end.flows {
            compiler.assign(Fixed::Flow.register(), self.flow)?;
        }
        compiler.block(&self.effects)?;
        if end.reads {
            self.read_predicates(compiler)?;
        }
        if happens.is_used() {
            compiler.exit(0);
            compiler.bind(happens);
            compiler.exit(NOT_QUIET);
        }
        Ok(())
    }
}
