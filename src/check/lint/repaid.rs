//! Rewards that are paid again in each tick, for a success that stands.

use super::cases::{conjuncts, of_expr};
use super::tree::at_success;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::{Expr, ExprId};
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::tree::Status;
use crate::ir::{Id, Program};
use crate::source::Span;

impl Checker<'_> {
    /// `on success(goto(job)): 1`: a robot that is there already succeeds at once, tick by tick. Told where the line of this
    /// number pays for nothing else, and pays well.
    pub fn pays_for_standing(&mut self, at: Span, checked: &Task, place: usize) {
        let lines = checked.written.reward.iter().zip(&checked.reward);
        let mut lines = lines.filter(|(of, _)| **of == place).map(|(_, line)| line);
        let stands = lines.find_map(|line| {
            let pays = self.program.pool.constant(line.value)? > 0.0;
            let happens = of_expr(&self.program, line.event, true)
                .and(&at_success(&self.program, line.event));
            let pays = pays && !happens.is_never();
            standing(&self.program, line.event).filter(|_| pays)
        });
        let Some(behavior) = stands else { return };
        let name = self.program.behaviors[behavior].name.bare();
        let message = "this is paid again in every tick that the robot stays".to_owned();
        self.warning(Code::W0519, at, message)
            .label(format!("where `{name}` has succeeded it succeeds again at once"))
            .help(format!(
                "pay for what changes: `success({name}) and STATE`, with a state that the event sets"
            ));
    }
}

/// The behaviour whose success is all that a condition waits for, if it stands once it has come.
fn standing(program: &Program, condition: ExprId) -> Option<Id<Behavior>> {
    let mut found = None;
    for id in conjuncts(program, condition) {
        match program.pool.get(id) {
            Expr::Ended(behavior, Status::Success) if found.is_none() => {
                let law = program.behaviors[behavior].law.as_ref()?;
                let waits = program.pool.constant(law.succeed).is_none();
                let stays = lasts(program, law.requires) && lasts(program, law.succeed);
                found = (waits && stays).then_some(behavior);
                found?;
            }
            _ if !lasts(program, id) => return None,
            _ => {}
        }
    }
    found
}

/// Whether an expression keeps its value as long as the robot stands: it reads nothing but where that is.
pub(super) fn lasts(program: &Program, id: ExprId) -> bool {
    let mut changes = |part| {
        !matches!(
            part,
            Expr::Num(_)
                | Expr::Bool(_)
                | Expr::Pose(_)
                | Expr::Inside(_)
                | Expr::Visible(..)
                | Expr::Unary(..)
                | Expr::Binary(..)
                | Expr::Select(..)
        )
    };
    !program.pool.any(id, &mut changes)
}
