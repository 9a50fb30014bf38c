//! Statements as a list of actions, and which names are computed where they are bound.
//!
//! ```text
//! let far = distance(left) * hand        Name far, now: `hand` changes before its last reader
//! let off = bearing(left)                Name off, where it is read
//! if far > 1 m { hand = 0 }              If, Set hand, End
//! drive(speed = far, turn = off)         Command speed, Command turn
//! ```

use super::layout::Fixed;
use crate::ir::expr::{Local, Temp};
use crate::ir::law::{Block, Stmt};
use crate::ir::program::State;
use crate::ir::{Expr, ExprId, Id, Pool};
use rustc_hash::{FxHashMap, FxHashSet};

/// One thing that code does.
#[derive(Clone, Copy, Debug)]
pub(super) enum Action {
    /// Makes a draw, a new one each time.
    Draw(ExprId),
    /// Binds a name.
    Name(Id<Temp>, ExprId, Moment),
    /// Sets a state variable.
    SetState(Id<State>, ExprId),
    /// Sets a variable of the behaviour.
    SetLocal(Id<Local>, ExprId),
    /// Sets one of the outputs that command the wheels.
    Command(Fixed, ExprId),
    /// Does what follows only where this holds, up to its `Else` or `End`.
    If(ExprId),
    /// Does what follows where the condition does not hold, up to its `End`.
    Else,
    /// Ends a branch.
    End,
}

/// When the value of a name is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Moment {
    /// Where the name is bound, because something that it reads changes before its last reader.
    Now,
    /// Where the name is read, if it is: the value is the same there.
    WhereRead,
}

impl Action {
    /// The expression whose value it uses.
    fn uses(self) -> Option<ExprId> {
        match self {
            Action::Draw(id)
            | Action::Name(_, id, _)
            | Action::SetState(_, id)
            | Action::SetLocal(_, id)
            | Action::Command(_, id)
            | Action::If(id) => Some(id),
            Action::Else | Action::End => None,
        }
    }

    /// The leaf whose value is another one afterwards.
    pub(super) fn changes(self, pool: &Pool) -> Option<Expr> {
        match self {
            Action::Draw(id) => Some(pool.get(id)),
            Action::Name(temp, ..) => Some(Expr::Temp(temp)),
            Action::SetState(state, _) => Some(Expr::State(state)),
            Action::SetLocal(local, _) => Some(Expr::Local(local)),
            Action::Command(..) | Action::If(_) | Action::Else | Action::End => None,
        }
    }
}

/// The actions of a block, in order.
pub(super) fn actions(pool: &Pool, block: &Block) -> Vec<Action> {
    let mut list = Vec::new();
    push_block(pool, block, &mut list, &mut Vec::new());
    decide_moments(pool, &mut list);
    list
}

/// The actions of a block in which these draws were made before.
fn push_block(pool: &Pool, block: &Block, list: &mut Vec<Action>, drawn: &mut Vec<ExprId>) {
    let outside = drawn.len();
    for statement in &block.0 {
        let mut draws = |list: &mut Vec<Action>, expressions: &[ExprId]| {
            for id in draws(pool, expressions) {
                if !drawn.contains(&id) {
                    drawn.push(id);
                    list.push(Action::Draw(id));
                }
            }
        };
        match statement {
            Stmt::Let(temp, value) => {
                draws(list, &[*value]);
                list.push(Action::Name(*temp, *value, Moment::WhereRead));
            }
            Stmt::SetState(state, value) => {
                draws(list, &[*value]);
                list.push(Action::SetState(*state, *value));
            }
            Stmt::SetLocal(local, value) => {
                draws(list, &[*value]);
                list.push(Action::SetLocal(*local, *value));
            }
            Stmt::If(condition, then, otherwise) => match pool.constant(*condition) {
                Some(0.0) => push_block(pool, otherwise, list, drawn),
                Some(_) => push_block(pool, then, list, drawn),
                None => {
                    draws(list, &[*condition]);
                    list.push(Action::If(*condition));
                    push_block(pool, then, list, drawn);
                    if !otherwise.0.is_empty() {
                        list.push(Action::Else);
                        push_block(pool, otherwise, list, drawn);
                    }
                    list.push(Action::End);
                }
            },
            Stmt::Drive {
                speed,
                strafe,
                turn,
            } => {
                draws(list, &[*speed, *strafe, *turn]);
                let outputs = [
                    (Fixed::Speed, *speed),
                    (Fixed::Strafe, *strafe),
                    (Fixed::Turn, *turn),
                ];
                // A tick begins with all three at rest.
                let moving = |&(_, value): &(_, ExprId)| pool.constant(value) != Some(0.0);
                let commands = outputs.into_iter().filter(moving);
                list.extend(commands.map(|(output, value)| Action::Command(output, value)));
            }
        }
    }
    drawn.truncate(outside);
}

/// The draws in some expressions, in the order in which they are made.
pub(super) fn draws(pool: &Pool, expressions: &[ExprId]) -> Vec<ExprId> {
    let mut found = Vec::new();
    let mut seen = FxHashSet::default();
    let mut open = expressions.to_vec();
    while let Some(id) = open.pop() {
        if seen.insert(id) {
            if let Expr::Draw(number, _) = pool.get(id) {
                found.push((number, id));
            }
            open.extend(pool.operands(id));
        }
    }
    found.sort_unstable();
    found.into_iter().map(|(_, id)| id).collect()
}

/// Finds the names that are computed where they are bound.
fn decide_moments(pool: &Pool, list: &mut [Action]) {
    let mut waiting = FxHashMap::default();
    let mut rest = list;
    while let [first, after @ ..] = rest {
        if let Action::Name(temp, value, moment) = first {
            let leaves = leaves(pool, *value, &waiting);
            if changes_before_last_use(pool, *temp, &leaves, after) {
                *moment = Moment::Now;
                waiting.remove(temp);
            } else {
                waiting.insert(*temp, leaves);
            }
        }
        rest = after;
    }
}

/// What a value is computed from: leaves of the pool, those of the names that are computed where they are read
/// included.
fn leaves(pool: &Pool, value: ExprId, waiting: &FxHashMap<Id<Temp>, Vec<Expr>>) -> Vec<Expr> {
    let mut leaves = Vec::new();
    pool.any(value, &mut |expr| {
        if matches!(
            expr,
            Expr::State(_) | Expr::Local(_) | Expr::Temp(_) | Expr::Draw(..)
        ) {
            leaves.push(expr);
        }
        if let Expr::Temp(temp) = expr {
            leaves.extend(waiting.get(&temp).into_iter().flatten());
        }
        false
    });
    leaves
}

/// Whether one of the leaves that a name is computed from changes before the last action that uses the name, itself or
/// through another name.
fn changes_before_last_use(pool: &Pool, temp: Id<Temp>, leaves: &[Expr], after: &[Action]) -> bool {
    let mut names = vec![Expr::Temp(temp)];
    let mut changed = leaves.contains(&Expr::Temp(temp));
    for action in after {
        let used = action.uses();
        if used.is_some_and(|id| pool.any(id, &mut |expr| names.contains(&expr))) {
            if changed {
                return true;
            }
            if let Action::Name(other, ..) = *action {
                names.push(Expr::Temp(other));
            }
        }
        changed |= action
            .changes(pool)
            .is_some_and(|leaf| leaves.contains(&leaf));
    }
    false
}
