//! Tasks: observations, choices, history, rewards, and how episodes start and end.

pub mod history;
mod learner;
mod schedule;
mod start;

use super::Checker;
use super::context::{Context, Region};
use super::expr::plain_ref;
use super::names::Decl;
use super::types::Type;
use crate::diagnostic::Code;
use crate::ir::expr::ExprId;
use crate::ir::law::Behavior;
use crate::ir::program::Predicate;
use crate::ir::task::{History, RewardLine, Task};
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{self, AspectKind, Expr};
use crate::syntax::print;
use std::collections::BTreeMap;

impl<'a> Checker<'a> {
    /// `task name { … }`
    pub fn task(&mut self, task: &'a ast::Task) {
        let zero = self.program.pool.num(0.0);
        let mut built = Task {
            name: Name::word(&task.name.name),
            observe: Vec::new(),
            choose: Vec::new(),
            history: History::default(),
            patience: None,
            start: Vec::new(),
            end_on: Vec::new(),
            end_after: 0,
            reward: Vec::new(),
            otherwise: zero,
        };
        let mut seen: BTreeMap<&str, Span> = BTreeMap::new();
        // A `start` may refer to a `history` that comes after it.
        let mut starts = Vec::new();
        for aspect in &task.aspects {
            self.context = Context::new(Region::Tree);
            let word = aspect_word(&aspect.kind);
            let repeats = matches!(aspect.kind, AspectKind::EndOn(_) | AspectKind::Error);
            let first = *seen.entry(word).or_insert(aspect.span);
            if first != aspect.span && !repeats {
                self.said_twice(word, aspect.span, first);
                continue;
            }
            match &aspect.kind {
                AspectKind::Observe(list) => built.observe = self.observed(list),
                AspectKind::Choose(list) => built.choose = self.chosen(list),
                AspectKind::History { window, outcomes } => {
                    built.history = self.history(window, outcomes);
                }
                AspectKind::Patience(ticks) => built.patience = self.ticks(ticks, "`patience`"),
                AspectKind::Start(start) => starts.push(start),
                AspectKind::EndOn(event) => {
                    self.context = Context::new(Region::Reward);
                    let event = self.expect(event, &Type::Bool, "what an episode ends on");
                    built.end_on.extend(event.scalar());
                }
                AspectKind::EndAfter(ticks) => {
                    built.end_after = self.ticks(ticks, "`end after`").unwrap_or(0);
                }
                AspectKind::Reward { lines, otherwise } => {
                    (built.reward, built.otherwise) = self.reward(lines, otherwise.as_ref());
                }
                AspectKind::Error => {}
            }
        }
        for start in starts {
            built.start = self.start(start, Some(built.history));
        }
        for (word, example) in [
            ("choose", "choose goto(A), goto(B)"),
            ("end after", "end after 5_000 ticks"),
            ("reward", "reward { on EVENT: +1 otherwise: -0.1 }"),
        ] {
            if !seen.contains_key(word) {
                let owner = format!("the task `{}`", task.name.name);
                self.missing(Code::E0502, task.name.span, &owner, word, example);
            }
        }
        if !self.has_world {
            self.no_world(task.name.span, "a task", "where is this to be done?");
        }
        // A task with a mistake is kept, so that references to it are not reported as well.
        self.program.tasks.push(built);
    }

    fn observed(&mut self, list: &'a [Expr]) -> Vec<Id<Predicate>> {
        let mut observed: Vec<Id<Predicate>> = Vec::new();
        for expr in list {
            let Some(reference) = plain_ref(expr) else {
                let declaration = format!("predicate NAME = {}", print::expr(expr));
                self.not_named(expr, "a predicate", &declaration);
                continue;
            };
            let predicate = self.declared_as(reference, "a predicate", |decl| match decl {
                Decl::Predicate(predicate) => Some(predicate),
                _ => None,
            });
            if let Some((predicate, library)) = predicate
                && let Some(id) = self.predicate_instance(predicate, library, reference)
            {
                self.once(&mut observed, id, reference.span);
            }
        }
        observed
    }

    fn chosen(&mut self, list: &'a [Expr]) -> Vec<Id<Behavior>> {
        let mut chosen: Vec<Id<Behavior>> = Vec::new();
        for expr in list {
            let Some(reference) = plain_ref(expr) else {
                self.not_named(expr, "a behaviour", "behavior NAME { … }");
                continue;
            };
            if let Some(id) = self.behavior_ref(reference) {
                self.once(&mut chosen, id, reference.span);
            }
        }
        chosen
    }

    fn once<T: PartialEq>(&mut self, list: &mut Vec<T>, item: T, span: Span) {
        if list.contains(&item) {
            self.error(Code::E0503, span, "this is in the list already")
                .label("listed a second time");
        } else {
            list.push(item);
        }
    }

    /// A time as a whole number of ticks, at least one.
    pub fn ticks(&mut self, expr: &'a Expr, role: &str) -> Option<u64> {
        let seconds = self.constant(expr, &Type::TIME, role)?;
        let ticks = (seconds / self.tick?).round();
        if (1.0..=1e15).contains(&ticks) {
            return Some(ticks as u64);
        }
        let label = if seconds <= 0.0 {
            "this takes no time"
        } else if ticks < 1.0 {
            "this is less than half a tick"
        } else {
            "this is too long"
        };
        self.out_of_range(expr.span, format!("{role} is at least one tick"), label)
            .none()
    }

    fn reward(
        &mut self,
        lines: &'a [ast::RewardLine],
        otherwise: Option<&'a Expr>,
    ) -> (Vec<RewardLine>, ExprId) {
        let mut built = Vec::new();
        for line in lines {
            self.context = Context::new(Region::Reward);
            let event = self.expect(&line.event, &Type::Bool, "what is rewarded");
            let value = self.expect(&line.value, &Type::NUMBER, "a reward");
            if let (Some(event), Some(value)) = (event.scalar(), value.scalar()) {
                built.push(RewardLine {
                    name: print::expr(&line.event),
                    event,
                    value,
                });
            }
        }
        self.context = Context::new(Region::Reward);
        let otherwise =
            otherwise.and_then(|value| self.expect(value, &Type::NUMBER, "a reward").scalar());
        let otherwise = otherwise.unwrap_or_else(|| self.program.pool.num(0.0));
        (built, otherwise)
    }
}

fn aspect_word(kind: &AspectKind) -> &'static str {
    match kind {
        AspectKind::Observe(_) => "observe",
        AspectKind::Choose(_) => "choose",
        AspectKind::History { .. } => "history",
        AspectKind::Patience(_) => "patience",
        AspectKind::Start(_) => "start",
        AspectKind::EndOn(_) => "end on",
        AspectKind::EndAfter(_) => "end after",
        AspectKind::Reward { .. } => "reward",
        AspectKind::Error => "",
    }
}
