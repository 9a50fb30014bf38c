//! Tasks: what is observed, chosen, remembered and rewarded; how episodes start and end.

pub mod learner;

use super::Checker;
use super::context::{Context, Region};
use super::names::{Decl, START_WORDS, unknown};
use super::types::units::Dim;
use super::types::{Type, Typed, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::law::Behavior;
use crate::ir::program::Predicate;
use crate::ir::task::{History, RewardLine, StartLine, Task};
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{self, AspectKind, Expr, ExprKind, Outcome, Ref, Spanned};
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
        // A `start` may speak of the history, wherever that stands.
        let mut starts = Vec::new();
        for aspect in &task.aspects {
            self.context = Context::new(Region::Tree);
            let word = aspect_word(&aspect.kind);
            let repeats = matches!(aspect.kind, AspectKind::EndOn(_) | AspectKind::Error);
            if let Some(first) = seen.get(word)
                && !repeats
            {
                let first = *first;
                self.report(
                    Diagnostic::new(Code::E0503, aspect.span, format!("`{word}` is there twice"))
                        .label("said again here")
                        .also(first, "first said here"),
                );
                continue;
            }
            seen.insert(word, aspect.span);
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
                self.report(
                    Diagnostic::new(
                        Code::E0502,
                        task.name.span,
                        format!("the task `{}` does not say its `{word}`", task.name.name),
                    )
                    .label(format!("`{word}` is missing"))
                    .help(format!("for example: `{example}`")),
                );
            }
        }
        if !self.has_world {
            self.report(
                Diagnostic::new(
                    Code::E0407,
                    task.name.span,
                    "a task needs a world, and there is none",
                )
                .label("where is this to be done?"),
            );
        }
        // A task with a mistake in it is known by name, so that what refers to it is not reported as well.
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
            let name = reference.name.name.as_str();
            match self.names.value(name, false) {
                Some((Decl::Predicate(predicate), library)) => {
                    if let Some(id) = self.predicate_instance(predicate, library, reference) {
                        self.once(&mut observed, id, reference.span);
                    }
                }
                Some((decl, _)) => self.wrong_kind(reference, "a predicate", decl.what()),
                None => {
                    let predicates = self.names.values(|decl| matches!(decl, Decl::Predicate(_)));
                    let diagnostic = unknown(&reference.name, "predicate", predicates);
                    self.report(diagnostic);
                }
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

    /// The behaviour that a reference names; anything else is reported.
    pub fn behavior_ref(&mut self, reference: &'a Ref) -> Option<Id<Behavior>> {
        match self.names.value(&reference.name.name, false) {
            Some((Decl::Behavior(behavior), library)) => {
                match self.behavior_instance(behavior, library, reference)? {
                    Value::Behavior(id) => Some(id),
                    _ => None,
                }
            }
            Some((decl, _)) => {
                self.wrong_kind(reference, "a behaviour", decl.what());
                None
            }
            None => {
                let behaviors = self.names.values(|decl| matches!(decl, Decl::Behavior(_)));
                let diagnostic = unknown(&reference.name, "behaviour", behaviors);
                let diagnostic = self.perhaps_of_library(diagnostic, &reference.name.name);
                self.report(diagnostic);
                None
            }
        }
    }

    /// Offers the library where it would bring the missing name.
    pub fn perhaps_of_library(&self, diagnostic: Diagnostic, name: &str) -> Diagnostic {
        let used = self
            .names
            .value("idle", true)
            .is_some_and(|(_, library)| library);
        if !used && ["goto", "dock", "follow_wall", "wander", "idle"].contains(&name) {
            diagnostic.help(format!("`use std` brings `{name}`"))
        } else {
            diagnostic
        }
    }

    fn once<T: PartialEq>(&mut self, list: &mut Vec<T>, item: T, span: Span) {
        if list.contains(&item) {
            self.report(
                Diagnostic::new(Code::E0503, span, "this is in the list already")
                    .label("listed a second time"),
            );
        } else {
            list.push(item);
        }
    }

    /// Reports a name of the wrong kind.
    pub fn wrong_kind(&mut self, reference: &Ref, wanted: &str, found: &str) {
        self.report(
            Diagnostic::new(
                Code::E0203,
                reference.span,
                format!("{wanted} is needed here"),
            )
            .label(format!("`{}` is {found}", reference.name.name)),
        );
    }

    pub fn not_named(&mut self, expr: &Expr, wanted: &str, declaration: &str) {
        if !matches!(expr.kind, ExprKind::Error) {
            self.report(
                Diagnostic::new(Code::E0203, expr.span, format!("{wanted} is needed here"))
                    .label("this is an expression without a name")
                    .help(format!("declare one: `{declaration}`")),
            );
        }
    }

    fn history(&mut self, window: &'a Expr, outcomes: &[Spanned<Outcome>]) -> History {
        let length = self.constant(window, &Type::NUMBER, "the length of the history");
        let window_length = match length {
            Some(n) if n.fract() == 0.0 && (1.0..=64.0).contains(&n) => n as usize,
            Some(n) => {
                let label = if n.fract() != 0.0 {
                    "this is no whole number"
                } else if n < 1.0 {
                    "nothing would be remembered"
                } else {
                    "these are too many"
                };
                self.out_of_range(window.span, "a history holds 1 to 64 terminations", label);
                0
            }
            None => 0,
        };
        let keeps = |outcome| outcomes.iter().any(|kept| kept.node == outcome);
        History {
            window: window_length,
            success: keeps(Outcome::Success),
            failure: keeps(Outcome::Failure),
        }
    }

    /// A time as a whole number of ticks, at least one.
    pub fn ticks(&mut self, expr: &'a Expr, role: &str) -> Option<u64> {
        let time = Type::Quantity(Dim::TIME);
        let seconds = self.constant(expr, &time, role)?;
        let ticks = (seconds / self.tick?).round();
        if (1.0..=1e15).contains(&ticks) {
            return Some(ticks as u64);
        }
        let label = if seconds <= 0.0 {
            "this takes no time"
        } else if ticks < 1.0 {
            "this is less than half a tick"
        } else {
            "this is beyond all counting"
        };
        self.out_of_range(expr.span, &format!("{role} is at least one tick"), label);
        None
    }

    /// `start { … }`
    pub fn start(&mut self, start: &'a ast::Start, history: Option<History>) -> Vec<StartLine> {
        self.context = Context::new(Region::Start);
        self.kept = history;
        let mut lines: Vec<StartLine> = Vec::new();
        let mut set: Vec<&ast::Ident> = Vec::new();
        for line in &start.lines {
            let built = self.start_line(line);
            let name = &line.target.name;
            match set.iter().find(|first| first.name == name.name) {
                Some(first) => self.report(
                    Diagnostic::new(
                        Code::E0503,
                        name.span,
                        format!("`{}` is set twice", name.name),
                    )
                    .label("this line would undo the first")
                    .also(first.span, "first set here"),
                ),
                None => set.push(name),
            }
            lines.extend(built.into_iter().flatten());
        }
        self.kept = None;
        lines
    }

    fn start_line(&mut self, line: &'a ast::StartLine) -> Option<Vec<StartLine>> {
        self.context.region = Region::Start;
        let name = line.target.name.name.as_str();
        match name {
            "pose" => {
                let value = self.expr(&line.value);
                if !value.ty.fits(&Type::Anywhere) {
                    self.report(
                        Diagnostic::new(Code::E0302, value.span, "`pose` is `anywhere`")
                            .label(format!("this is {}", value.ty))
                            .help(
                                "a pose of your own: `position = (1 m, 2 m)`, `heading = 90 deg`",
                            ),
                    );
                }
                return Some(vec![StartLine::Anywhere]);
            }
            "position" => {
                let value = self.expect(&line.value, &Type::Point, "`position`");
                return match value.value {
                    Value::Point(x, y) => Some(vec![StartLine::Position(x, y)]),
                    _ => None,
                };
            }
            "heading" => {
                let angle = Type::Quantity(Dim::ANGLE);
                let value = self.expect(&line.value, &angle, "`heading`");
                return value.scalar().map(|id| vec![StartLine::Heading(id)]);
            }
            "history" => {
                self.context.region = Region::StartHistory;
                let value = self.expr(&line.value);
                if !value.ty.fits(&Type::Termination) {
                    self.report(
                        Diagnostic::new(
                            Code::E0302,
                            value.span,
                            "`history` starts with the end of a behaviour",
                        )
                        .label(format!("this is {}", value.ty))
                        .help("for example: `history = success(goto(A))`"),
                    );
                    return None;
                }
                return value.scalar().map(|id| vec![StartLine::History(id)]);
            }
            _ => {}
        }
        let Some((Decl::State(state), _)) = self.names.value(name, false) else {
            let diagnostic = match self.names.value(name, false) {
                Some((decl, _)) => Diagnostic::new(
                    Code::E0203,
                    line.target.span,
                    format!("a start cannot set `{name}`"),
                )
                .label(format!("this is {}", decl.what())),
                None => {
                    let states = self.names.values(|decl| matches!(decl, Decl::State(_)));
                    unknown(&line.target.name, "state", states.chain(START_WORDS))
                }
            };
            self.report(diagnostic);
            return None;
        };
        let slot: Typed = self.state_value(state, &line.target);
        if slot.ty == Type::Error {
            return None;
        }
        let value = self.expect(&line.value, &slot.ty, &format!("`{name}`"));
        let ids = self.states.get(name).map(|slot| slot.ids.clone());
        let parts = match value.value {
            Value::Scalar(id) => vec![id],
            Value::Point(x, y) => vec![x, y],
            _ => return None,
        };
        let ids = ids.unwrap_or_default().into_iter();
        Some(
            ids.zip(parts)
                .map(|(id, part)| StartLine::State(id, part))
                .collect(),
        )
    }

    fn reward(
        &mut self,
        lines: &'a [ast::RewardLine],
        otherwise: Option<&'a Expr>,
    ) -> (Vec<RewardLine>, crate::ir::ExprId) {
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

/// The reference that an expression is.
fn plain_ref(expr: &Expr) -> Option<&Ref> {
    match &expr.kind {
        ExprKind::Ref(reference) => Some(reference),
        ExprKind::Paren(inner) => plain_ref(inner),
        _ => None,
    }
}
