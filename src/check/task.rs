//! Tasks: observations, choices, history, rewards, and how episodes start and end.

pub mod history;
pub mod learner;
pub mod schedule;
mod start;

use super::Checker;
use super::context::{Context, Region};
use super::expr::plain_ref;
use super::lint::Quantity;
use super::names::Decl;
use super::report::Draft;
use super::types::Type;
use super::types::units::Dim;
use crate::diagnostic::{Applicability, Code};
use crate::ir::expr::{Binary, Expr as Pooled, ExprId};
use crate::ir::law::Behavior;
use crate::ir::program::Predicate;
use crate::ir::task::{History, Price, RewardLine, Task, Written};
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{self, AspectKind, BinaryOp, Expr, ExprKind, Paid};
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
            prices: Vec::new(),
            written: Written::default(),
        };
        let mut ends = 0;
        let mut seen: BTreeMap<&str, Span> = BTreeMap::new();
        let mut said: BTreeMap<String, Span> = BTreeMap::new();
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
                AspectKind::Observe(list) => {
                    (built.observe, built.written.observe) = self.observed(list);
                }
                AspectKind::Choose(list) => {
                    (built.choose, built.written.choose) = self.chosen(list);
                }
                AspectKind::History { window, outcomes } => {
                    built.history = self.history(window, outcomes);
                }
                AspectKind::Patience(ticks) => built.patience = self.ticks(ticks, "`patience`"),
                AspectKind::Start(start) => starts.push(start),
                AspectKind::EndOn(event) => {
                    self.context = Context::new(Region::Reward);
                    let called = plain_ref(event).is_some_and(|event| event.args.is_some());
                    if called && self.unbound_members(event, " in ").is_some() {
                        continue;
                    }
                    let scopes = match plain_ref(event) {
                        Some(reference) => self.ranges(reference),
                        None => Some(vec![Vec::new()]),
                    };
                    let events = self.for_each_member(scopes.unwrap_or_default(), |checker, _| {
                        checker.ends_on(event, aspect.span)
                    });
                    let text = print::expr(event);
                    for event in events.into_iter().flatten() {
                        built.end_on.push(event);
                        built.written.end_on.push(ends);
                        built.written.ends.push(text.clone());
                    }
                    ends += 1;
                    match said.get(&text) {
                        Some(first) => {
                            self.said_twice(&format!("end on {text}"), aspect.span, *first)
                        }
                        None => {
                            said.insert(text, aspect.span);
                        }
                    }
                }
                AspectKind::EndAfter(ticks) => {
                    built.end_after = self.end_after(ticks).unwrap_or(0);
                }
                AspectKind::Reward { lines, otherwise } => {
                    self.reward(lines, otherwise.as_ref(), &mut built);
                }
                AspectKind::Error => {}
            }
        }
        for start in starts {
            built.start = self.start(start, Some((built.name.clone(), built.history)));
        }
        self.dear_moments(task, &built);
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

    fn observed(&mut self, list: &'a [Expr]) -> (Vec<Id<Predicate>>, Vec<usize>) {
        let mut observed: Vec<Id<Predicate>> = Vec::new();
        let mut places = Vec::new();
        for (place, expr) in list.iter().enumerate() {
            let Some(reference) = plain_ref(expr) else {
                let declaration = format!("predicate NAME = {}", print::expr(expr));
                self.not_named(expr, "a predicate", &declaration);
                continue;
            };
            let help = self.predicate_of(reference);
            let predicate = self.declared_as(reference, "a predicate", help, |decl| match decl {
                Decl::Predicate(predicate) => Some(predicate),
                _ => None,
            });
            let (Some((predicate, library)), Some(scopes)) = (predicate, self.ranges(reference))
            else {
                continue;
            };
            let ids = self.for_each_member(scopes, |checker, _| {
                checker.predicate_instance(predicate, library, reference)
            });
            for id in ids.into_iter().flatten() {
                self.once(&mut observed, id, reference.span);
                places.resize(observed.len(), place);
            }
        }
        (observed, places)
    }

    /// The behaviours of a list, and for each the place of its entry.
    fn chosen(&mut self, list: &'a [Expr]) -> (Vec<Id<Behavior>>, Vec<usize>) {
        let mut chosen: Vec<Id<Behavior>> = Vec::new();
        let mut places = Vec::new();
        for (place, expr) in list.iter().enumerate() {
            let Some(reference) = plain_ref(expr) else {
                self.not_named(expr, "a behaviour", "behavior NAME { … }");
                continue;
            };
            let scopes = self.ranges(reference).unwrap_or_default();
            let ids = self.for_each_member(scopes, |checker, _| checker.behavior_ref(reference));
            for id in ids.into_iter().flatten() {
                self.once(&mut chosen, id, reference.span);
                places.resize(chosen.len(), place);
            }
        }
        (chosen, places)
    }

    /// What the aspect at `aspect` says that an episode ends on.
    fn ends_on(&mut self, event: &'a Expr, aspect: Span) -> Option<ExprId> {
        let role = "what an episode ends on";
        let typed = self.expr_like(event, &Type::Bool);
        if typed.ty.dim() != Some(Dim::TIME) {
            return self.coerce(typed, event, &Type::Bool, role).scalar();
        }
        // That is how long it lasts at most: it is said, though by another word.
        self.names.lose("end");
        let words = Span {
            end: event.span.start,
            ..aspect
        };
        let message = format!("{role} is {}, not {}", Type::Bool, typed.ty);
        self.unlike(&typed, &Type::Bool, message)
            .this_is(&typed.ty)
            .fix(
                "how long it lasts at most is said by `end after`",
                words,
                "end after ",
                Applicability::Unsafe,
            )
            .none()
    }

    pub fn once<T: PartialEq>(&mut self, list: &mut Vec<T>, item: T, span: Span) {
        if list.contains(&item) {
            self.error(Code::E0503, span, "this is in the list already")
                .label("listed a second time");
        } else {
            list.push(item);
        }
    }

    /// How many ticks an episode has at most.
    fn end_after(&mut self, expr: &'a Expr) -> Option<u64> {
        const ROLE: &str = "`end after`";
        // `end after 5 min or ruined`
        if let Some((draft, other)) = self.joined(expr, ROLE) {
            let help = "what else ends an episode has a line of its own";
            return draft.help(format!("{help}: `end on {other}`")).none();
        }
        // Of an episode of one tick something else is told.
        self.counted(expr, ROLE).map(|(ticks, _)| ticks)
    }

    /// A time as a whole number of ticks, at least one.
    pub fn ticks(&mut self, expr: &'a Expr, role: &str) -> Option<u64> {
        if let Some((draft, _)) = self.joined(expr, role) {
            return draft.none();
        }
        let (ticks, time) = self.counted(expr, role)?;
        self.quantities.insert(expr.span, time);
        Some(ticks)
    }

    /// Reports conditions that are joined where a time stands, and gives the second of them.
    fn joined(&mut self, expr: &'a Expr, role: &str) -> Option<(Draft<'_>, String)> {
        let ExprKind::Binary { op, right, .. } = &expr.kind else {
            return None;
        };
        if !matches!(op.node, BinaryOp::And | BinaryOp::Or) {
            return None;
        }
        let draft = self.error(Code::E0302, op.span, format!("{role} takes a time alone"));
        Some((draft.label("joins conditions"), print::expr(right)))
    }

    /// A time as a whole number of ticks, at least one, and as it is written.
    fn counted(&mut self, expr: &'a Expr, role: &str) -> Option<(u64, Quantity)> {
        let seconds = self.constant(expr, &Type::TIME, role)?;
        let tick = self.tick?;
        let exact = seconds / tick;
        let ticks = exact.round();
        if (1.0..=1e15).contains(&ticks) {
            return Some((ticks as u64, Quantity::Time(seconds)));
        }
        self.less_than_a_tick(expr.span, role, exact)
            .note_if((tick >= 1.0).then(|| format!("a tick of this world takes {tick} s")))
            .none()
    }

    /// Reports a time of so many `ticks`, which is no time, none that is counted, or too long.
    pub fn less_than_a_tick(&mut self, span: Span, role: &str, ticks: f64) -> Draft<'_> {
        let label = if ticks <= 0.0 {
            "this takes no time"
        } else if ticks.round() < 1.0 {
            "this is less than half a tick"
        } else {
            "this is too long"
        };
        self.out_of_range(span, format!("{role} is at least one tick"), label)
    }

    fn reward(
        &mut self,
        lines: &'a [ast::RewardLine],
        otherwise: Option<&'a Expr>,
        task: &mut Task,
    ) {
        for (place, line) in lines.iter().enumerate() {
            self.context = Context::new(Region::Reward);
            let event = match &line.paid {
                Paid::On(event) => event,
                Paid::Per { during, time } => {
                    task.prices
                        .extend(self.price(during.as_ref(), time, &line.value));
                    continue;
                }
            };
            let called = plain_ref(event).is_some_and(|event| event.args.is_some());
            let binds = called || self.reads_parameter_of(event, &line.value);
            if binds && self.unbound_members(event, " in ").is_some() {
                continue;
            }
            let range = plain_ref(event).filter(|reference| Self::ranging(reference));
            let scopes = match range {
                Some(reference) => self.ranges(reference),
                None => Some(vec![Vec::new()]),
            };
            let built = self.for_each_member(scopes.unwrap_or_default(), |checker, _| {
                let on = checker.expect(event, &Type::Bool, "what is rewarded");
                let value = checker.expect(&line.value, &Type::NUMBER, "a reward");
                let (on, value) = (on.scalar()?, value.scalar()?);
                let name = match (range, checker.program.pool.get(on)) {
                    (Some(_), Pooled::Event(id)) => checker.program.events[id].name.to_string(),
                    _ => print::expr(event),
                };
                Some(RewardLine {
                    name,
                    event: on,
                    value,
                })
            });
            for line in built.into_iter().flatten() {
                task.reward.push(line);
                task.written.reward.push(place);
            }
        }
        self.context = Context::new(Region::Reward);
        if let Some(value) = otherwise
            && let Some(value) = self.expect(value, &Type::NUMBER, "a reward").scalar()
        {
            task.otherwise = value;
        }
    }

    /// `while condition, per time: value`
    fn price(
        &mut self,
        during: Option<&'a Expr>,
        time: &'a Expr,
        value: &'a Expr,
    ) -> Option<Price> {
        let what = "what has to hold while time is paid";
        let during = match during {
            Some(during) => {
                let holds = self.expect(during, &Type::Bool, what).scalar();
                self.asks(during.span, holds);
                holds
            }
            None => Some(self.program.pool.bool(true)),
        };
        let seconds = self.constant(time, &Type::TIME, "the time that is paid");
        let paid = self.expect(value, &Type::NUMBER, "a reward").scalar();
        let (seconds, paid) = (seconds?, paid?);
        if seconds <= 0.0 {
            return self
                .out_of_range(
                    time.span,
                    "the time that is paid is above zero",
                    "no time passes in this",
                )
                .none();
        }
        let seconds = self.program.pool.num(seconds);
        let per_second = self.program.pool.binary(Binary::Div, paid, seconds);
        Some(Price {
            name: format!("per {}", print::expr(time)),
            during: during?,
            per_second,
        })
    }

    /// Warns of a cost for each decision where a behaviour may succeed in the tick in which it starts, however the robot
    /// stands: what it costs to wait is then another thing for each behaviour.
    fn dear_moments(&mut self, task: &'a ast::Task, built: &Task) {
        let pool = &self.program.pool;
        if pool
            .constant(built.otherwise)
            .is_none_or(|cost| cost == 0.0)
        {
            return;
        }
        let at_once = built.choose.iter().find(|id| {
            let law = self.program.behaviors[**id].law.as_ref();
            law.is_some_and(|law| {
                let takes_time = pool.any(law.succeed, &mut |expr| {
                    !matches!(
                        expr,
                        Pooled::Num(_)
                            | Pooled::Bool(_)
                            | Pooled::State(_)
                            | Pooled::Unary(..)
                            | Pooled::Binary(..)
                            | Pooled::Select(..)
                    )
                });
                !takes_time && pool.constant(law.succeed) != Some(0.0)
            })
        });
        let Some(id) = at_once else { return };
        let name = self.program.behaviors[*id].name.clone();
        let otherwise = task.aspects.iter().find_map(|aspect| match &aspect.kind {
            AspectKind::Reward { otherwise, .. } => otherwise.as_ref(),
            _ => None,
        });
        let Some(otherwise) = otherwise else { return };
        let message = format!("this is paid per decision, and `{name}` may succeed at once");
        self.warning(Code::W0515, otherwise.span, message)
            .label("a tick of that costs as much as a long drive")
            .help("let time have a price of its own: `per 1 s: -0.01`");
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
