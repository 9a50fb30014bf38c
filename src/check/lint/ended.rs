//! Predicates that hold only once the episode has ended: what they ask is what ends it.

use super::cases::{About, Case, Cases, Says, of_expr};
use super::ranges::range;
use super::stays::{Set, begins, of_block};
use super::view::View;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::{Expr, ExprId};
use crate::ir::world::{Robot, World};
use crate::ir::{Id, Name};
use crate::syntax::ast::{self, AspectKind, Item, ItemKind};

/// The most ends of a task that are held against its predicates.
const MOST: usize = 64;

impl<'a> Checker<'a> {
    /// Warns of predicates that a task observes and that hold only where its episodes have ended.
    pub fn observed_too_late(&mut self, items: impl Iterator<Item = &'a Item>) {
        let begins = begins(&self.program);
        let mut later = Set::new();
        for effect in self.program.effects.iter() {
            of_block(&effect.block, World::acting(), &mut later);
        }
        for item in items {
            if let ItemKind::Task(task) = &item.kind {
                self.of_task(task, [&begins, &later]);
            }
        }
    }

    fn of_task(&mut self, task: &'a ast::Task, settings: [&Set; 2]) {
        let program = &self.program;
        let ends = task.aspects.iter().filter_map(|aspect| match &aspect.kind {
            AspectKind::EndOn(event) => Some(event.span),
            _ => None,
        });
        let ends: Vec<_> = ends.collect();
        let named = program.tasks.named(&Name::word(&task.name.name));
        let Some(checked) = named.map(|id| &program.tasks[id]) else {
            return;
        };
        let all = checked
            .written
            .end_on
            .iter()
            .zip(&checked.end_on)
            .take(MOST);
        let held: Vec<(usize, Cases)> = all
            // Of an end that holds whatever happens that is told.
            .filter(|(_, end)| !of_expr(program, **end, false).is_never())
            .map(|(place, end)| (*place, of_expr(program, *end, true)))
            .collect();
        let mut found = Vec::new();
        for (at, id) in self.observed_by(task) {
            let predicate = &program.predicates[id];
            let Some(when) = predicate.when else {
                continue;
            };
            let cases = of_expr(View::of(program, &predicate.name), when, true);
            let end = held.iter().find(|(_, end)| cases.implies(end));
            let end = end.and_then(|(place, _)| ends.get(*place));
            if let Some(end) = end
                && !cases.is_never()
                && self.only_ticks_bring(&cases, when, settings)
            {
                found.push((at.span, predicate.name.bare(), *end));
            }
        }
        for (at, name, end) in found {
            if self.told().overlap(at) {
                continue;
            }
            let message = format!("`{name}` holds only once the episode has ended");
            self.warning(Code::W0601, at, message)
                .label("so no decision is ever made where it holds")
                .also(end, "wherever it holds, this has ended the episode");
        }
    }

    /// Whether a condition that has these cases comes to hold by what happens in ticks alone: not as an episode starts, and not by
    /// effects, which come after the ends have been looked at.
    fn only_ticks_bring(&self, cases: &Cases, when: ExprId, [begins, later]: [&Set; 2]) -> bool {
        let Cases::Some(cases) = cases else {
            return false;
        };
        let program = &self.program;
        // What doors, other robots and behaviours do is looked at then, too.
        let other = program.pool.any(when, &mut |part| {
            !matches!(
                part,
                Expr::Num(_) | Expr::Bool(_) | Expr::State(_) | Expr::Unary(..) | Expr::Binary(..)
            )
        });
        let ruled_out = |set: &Set, (about, says): (&About, &Says)| {
            let (About::Number(of) | About::Truth(of)) = about else {
                return false;
            };
            let Expr::State(state) = program.pool.get(*of) else {
                return false;
            };
            let mut settings = set.get(&state).into_iter().flatten();
            settings.all(|(robot, value)| self.rules_out((*robot, *value), *says))
        };
        let by_ticks = |case: &Case| {
            case.iter().all(|literal| ruled_out(later, literal))
                && case.iter().any(|literal| ruled_out(begins, literal))
        };
        !other && cases.iter().all(by_ticks)
    }

    /// Whether a value that a state is set to is none of which this is said.
    fn rules_out(&self, (robot, value): (Id<Robot>, ExprId), says: Says) -> bool {
        let program = &self.program;
        let view = View {
            robot,
            ..View::from(program)
        };
        match says {
            Says::Within(within) => within.and(range(view, value)).is_empty(),
            Says::Is(wanted) => of_expr(view, value, wanted).is_never(),
            Says::Among(among) => match program.pool.get(value) {
                Expr::Num(value) => {
                    (0.0..f64::from(u64::BITS)).contains(&value) && among & 1 << value as u32 == 0
                }
                _ => false,
            },
            Says::NoNumber => false,
        }
    }
}
