//! Regions of a behaviour that it never gets to: what `requires`, `succeed when` and `fail when` leave of one another.

use super::apart::because;
use super::cases::{About, Case, Cases, Says, of_expr};
use super::interval::Interval;
use super::ranges::range;
use super::sizes::covers;
use super::view::View;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::{Expr, ExprId, Local};
use crate::ir::law::{Behavior, Law};
use crate::ir::tree::Node;
use crate::ir::{Id, Name, Pool, Program};
use crate::source::Span;
use crate::syntax::ast::{AspectKind, BehaviorBody, Clause, ClauseKind, Item, ItemKind, Ref};
use std::collections::{BTreeMap, BTreeSet};

/// The most ticks that are counted.
const MOST_TICKS: f64 = 1e12;

/// A `fail when` of a behaviour, with what is looked at before it.
#[derive(Clone, Copy, Debug)]
pub struct FailClause {
    /// What `requires` asks.
    pub requires: ExprId,
    /// What `succeed when` asks.
    pub succeed: ExprId,
    /// What the clauses before it ask.
    pub before: ExprId,
    /// What it asks.
    pub when: ExprId,
}

/// What has a known value as a behaviour starts.
#[derive(Debug, Default)]
struct Starting {
    /// Each expression that is the time since then.
    elapsed: Option<ExprId>,
    /// The expression that is each variable of a behaviour.
    locals: BTreeMap<Id<Local>, ExprId>,
}

impl Starting {
    /// Of all behaviours of a pool.
    fn of(pool: &Pool) -> Self {
        let mut found = Self::default();
        for (id, expr) in pool.iter() {
            match expr {
                Expr::Elapsed => found.elapsed = Some(id),
                Expr::Local(local) => {
                    found.locals.insert(local, id);
                }
                _ => {}
            }
        }
        found
    }

    /// What is known as a behaviour starts: no time has passed, and its variables have the values that they start with.
    fn case(&self, view: View, law: &Law) -> Cases {
        let pool = &view.program.pool;
        let elapsed = self.elapsed.map(|id| {
            let none = Says::Within(Interval::just(0.0));
            (About::Number(id), none)
        });
        let locals = law.locals.iter().filter_map(|(local, it)| {
            let id = *self.locals.get(&local)?;
            if let Expr::Bool(value) = pool.get(it.initial) {
                return Some((About::Truth(id), Says::Is(value)));
            }
            let within = range(view, it.initial);
            (within != Interval::ALL).then_some((About::Number(id), Says::Within(within)))
        });
        Cases::Some(vec![elapsed.into_iter().chain(locals).collect::<Case>()])
    }
}

/// What is so in the tick in which a behaviour starts.
const AS_IT_STARTS: &str =
    "as it starts, `elapsed` is 0, and each local has the value of its declaration";

impl<'a> Checker<'a> {
    /// Notes where a program calls a behaviour of the library.
    pub fn calls_library(
        &mut self,
        library: bool,
        reference: &'a Ref,
        behavior: Option<Id<Behavior>>,
    ) {
        let own = !self.context.library && !self.bodies.is_unrolling();
        if let Some(behavior) = behavior.filter(|_| library && own) {
            self.library_calls.insert(reference.span, behavior);
        }
    }

    /// Warns of behaviours of the library that are over before they do anything, and of those that never succeed as they are
    /// called, where they are called first. `choices` are the conditions of success of which that has been told.
    pub fn calls_without_effect(&mut self, choices: &BTreeSet<ExprId>) {
        let mut told = BTreeSet::new();
        let starting = Starting::of(&self.program.pool);
        for (at, id) in std::mem::take(&mut self.library_calls) {
            let behavior = &self.program.behaviors[id];
            let view = View::of_behavior(&self.program, behavior);
            let law = behavior.law.as_ref();
            let never = law.filter(|law| {
                succeeds_never(view, law, &starting) && !choices.contains(&law.succeed)
            });
            if let Some(law) = never {
                if told.insert(id) {
                    let (name, why) = (behavior.name.bare(), because(view, law.succeed));
                    self.never_succeeds(at, &name, why);
                }
                continue;
            }
            let always = |asked| of_expr(view, asked, false).is_never();
            let (over, allowed) = law.map_or((false, false), |law| {
                let starts = || starting.case(view, law);
                let allowed = always(law.requires);
                let over = always(law.succeed) && (allowed || !self.goes_everywhere(behavior))
                    || allowed && starts().implies(&of_expr(view, law.succeed, true));
                (over, allowed)
            });
            let name = behavior.name.bare();
            if over && told.insert(id) {
                let (message, label) = match allowed {
                    true => (
                        format!("`{name}` succeeds at once"),
                        "it takes no time and does nothing",
                    ),
                    false => (
                        format!("`{name}` is over at once"),
                        "where it does not fail it succeeds: it takes no time and does nothing",
                    ),
                };
                let why = law.and_then(|law| because(view, law.succeed));
                self.warning(Code::W0302, at, message)
                    .label(label)
                    .note_if(why);
            } else if let Some(end) = to_and_fro(behavior).filter(|_| told.insert(id)) {
                self.warning(
                    Code::W0303,
                    at,
                    format!("both ends of this patrol are `{end}`"),
                )
                .label("the robot drives there and stays")
                .help("give it two places to drive to and fro between");
            }
        }
    }

    /// Whether a behaviour is given a place that is the whole arena: that is told of the place.
    fn goes_everywhere(&self, behavior: &Behavior) -> bool {
        let Some(world) = &self.program.world else {
            return false;
        };
        let given = behavior
            .name
            .given()
            .next()
            .map(|(_, given)| given.to_string());
        let mut places = world.places.values();
        places.any(|place| given == Some(place.name.to_string()) && covers(&place.shape, world))
    }

    /// Warns of each `fail when` that what is looked at before it leaves nothing to say.
    fn fails_without_effect(&mut self, clauses: &'a [Clause]) {
        let world = self.program.world.as_ref();
        if world.is_some_and(|world| !world.others.is_empty()) {
            return;
        }
        let fails = clauses.iter().filter_map(|clause| match &clause.kind {
            ClauseKind::Fail(test) => Some((clause, test)),
            _ => None,
        });
        let mut first = None;
        for (clause, test) in fails {
            let first = *first.get_or_insert(test.span);
            let found = self.fails.get(&test.span).cloned().unwrap_or_default();
            let program = &self.program;
            let says = found.iter().all(|it| {
                let is_constant = program.pool.constant(it.when).is_some();
                !is_constant && !of_expr(program, it.when, true).is_never()
            });
            if !says || found.is_empty() || self.says_one_thing_twice(test.span) {
                continue;
            }
            if self.fails_too_late(test, &found) {
                continue;
            }
            let program = &self.program;
            let implies = |asked: fn(&FailClause) -> ExprId, wanted: bool| {
                found.iter().all(|it| {
                    let when = of_expr(program, it.when, true);
                    when.implies(&of_expr(program, asked(it), wanted))
                })
            };
            let (label, earlier) = if implies(|it| it.requires, false) {
                ("wherever this holds, `requires` does not", None)
            } else if implies(|it| it.succeed, true) {
                ("wherever this holds, it has succeeded already", None)
            } else if implies(|it| it.before, true) {
                ("wherever this holds, it has failed already", Some(first))
            } else {
                continue;
            };
            let draft = self
                .warning(
                    Code::W0302,
                    place(clause),
                    "this `fail when` changes nothing",
                )
                .label(label);
            match earlier {
                Some(first) => draft.also(first, "this is looked at first").emit(),
                None => draft.emit(),
            }
        }
    }

    /// Warns of regions that no instance of a behaviour gets to.
    pub fn regions_without_effect(&mut self, items: impl Iterator<Item = &'a Item>) {
        let starting = Starting::of(&self.program.pool);
        for item in items {
            let ItemKind::Behavior(behavior) = &item.kind else {
                continue;
            };
            let BehaviorBody::Clauses(clauses) = &behavior.body else {
                continue;
            };
            let behaviors = self.program.behaviors.iter();
            let own = behaviors.filter(|(_, other)| {
                other.name.family == behavior.name.name && other.law.is_some()
            });
            let own: Vec<Id<Behavior>> = own.map(|(id, _)| id).collect();
            if !own.is_empty() {
                self.regions_of(clauses, &own, &starting);
            }
        }
    }

    fn regions_of(&mut self, clauses: &'a [Clause], own: &[Id<Behavior>], starting: &Starting) {
        // What never or always holds within a clause says enough of it.
        let first = |wanted: fn(&ClauseKind) -> bool| {
            let mut clauses = clauses.iter();
            let first = clauses.find(|clause| wanted(&clause.kind))?;
            (!self.is_told_within(Code::W0601, first.span)).then(|| place(first))
        };
        let requires = first(|kind| matches!(kind, ClauseKind::Requires(_)));
        let succeed = first(|kind| matches!(kind, ClauseKind::Succeed(_)));
        let fail = first(|kind| matches!(kind, ClauseKind::Fail(_)));
        let drives =
            first(|kind| matches!(kind, ClauseKind::Control(block) if !block.stmts.is_empty()));
        let program = &self.program;
        let every = |test: &dyn Fn(View, &Law) -> bool| own.iter().all(|id| of(program, *id, test));
        let requires_never = every(&|view, law| of_expr(view, law.requires, true).is_never());
        let requires_always = every(&|view, law| of_expr(view, law.requires, false).is_never());
        // What never runs is told of what it requires.
        let refused_is_told = clauses.iter().any(|clause| {
            matches!(clause.kind, ClauseKind::Requires(_))
                && self.is_told_within(Code::W0601, clause.span)
        });
        if requires_never && refused_is_told {
            return;
        }
        // What follows from the values of locals is told of how they start.
        let at_once = every(&|view, law| {
            let view = View { law: None, ..view };
            let allowed = of_expr(view, law.requires, true);
            allowed.implies(&of_expr(view, law.succeed, true))
        });
        let shadowed = every(&|view, law| {
            let fails = of_expr(view, law.fail, true);
            fails.implies(&of_expr(view, law.succeed, true))
        });
        let fails_never = every(&never_fails);
        let never_succeeds = every(&|view, law| succeeds_never(view, law, starting));
        let fails_at_once = every(&|view, law| {
            let view = View { law: None, ..view };
            let allowed = of_expr(view, law.requires, true);
            let goes_on = allowed.and(&of_expr(view, law.succeed, false));
            goes_on.implies(&of_expr(view, law.fail, true))
        });
        let as_it_starts = |asked: fn(&Law) -> ExprId| {
            every(&|view, law| {
                let starts = starting.case(view, law);
                let waits = program.pool.constant(asked(law)).is_none();
                waits && starts.implies(&of_expr(view, asked(law), true))
            })
        };
        let succeeds_as_it_starts = as_it_starts(|law| law.succeed);
        let fails_as_it_starts = as_it_starts(|law| law.fail);
        let refused_as_it_starts = every(&|view, law| {
            let starts = starting.case(view, law);
            starts.and(&of_expr(view, law.requires, true)).is_never()
        });
        if let (true, Some(at)) = (requires_never, requires) {
            self.warning(Code::W0302, at, "this behaviour never runs")
                .label("what it requires never holds, so it fails at once");
        } else if let (true, Some(at)) = (refused_as_it_starts, requires) {
            self.warning(Code::W0302, at, "this behaviour never runs")
                .label("what it requires does not hold as it starts, so it fails at once")
                .note(AS_IT_STARTS);
        } else if let (true, Some(at), Some(control)) = (at_once, succeed, drives) {
            self.warning(Code::W0302, control, "this control law never runs")
                .label("never reached")
                .also(
                    at,
                    "this holds from the start, so the behaviour succeeds at once",
                );
        } else if let (true, Some(at)) = (succeeds_as_it_starts, succeed) {
            self.over_as_it_starts("succeeds", at);
        } else if let (true, Some(at)) = (fails_never, fail) {
            let why = self.lacking_local(own, &|program, id| of(program, id, &never_fails));
            self.warning(Code::W0302, at, "this behaviour never fails here")
                .label("what it waits for never holds")
                .note_if(why);
        } else if let (true, Some(at), Some(before)) = (shadowed, fail, succeed) {
            self.warning(Code::W0302, at, "this behaviour never fails here")
                .label("wherever this holds, it has succeeded already")
                .also(before, "`succeed when` is looked at first");
        } else if let (true, Some(at), Some(control)) = (fails_at_once, fail, drives) {
            self.warning(Code::W0302, control, "this control law never runs")
                .label("never reached")
                .also(
                    at,
                    "this holds from the start, so the behaviour fails at once",
                );
        } else if let (true, Some(fail)) = (fails_as_it_starts, fail) {
            let at = self.failing(clauses, own, starting).unwrap_or(fail);
            self.over_as_it_starts("fails", at);
        } else if let (true, Some(at)) = (never_succeeds, succeed) {
            let near = |id: &Id<Behavior>| {
                let behavior = &program.behaviors[*id];
                let view = View::of_behavior(program, behavior);
                because(view, behavior.law.as_ref()?.succeed)
            };
            let holds = !every(&|view, law| of_expr(view, law.succeed, true).is_never());
            let why = own.first().and_then(near).or_else(|| {
                let never = |view: View, law: &Law| succeeds_never(view, law, starting);
                self.lacking_local(own, &|program, id| of(program, id, &never))
            });
            let label = match holds {
                true => "where this holds, it has failed",
                false => "what it waits for never holds",
            };
            self.warning(Code::W0302, at, "this behaviour never succeeds")
                .label(label)
                .note_if(why);
        } else if let (true, Some(at)) = (requires_always, requires) {
            self.warning(Code::W0604, at, "this requires nothing")
                .label("it always holds");
        } else {
            self.fails_without_effect(clauses);
        }
    }

    /// The first `fail when` that holds as the behaviour starts.
    fn failing(
        &self,
        clauses: &[Clause],
        own: &[Id<Behavior>],
        starting: &Starting,
    ) -> Option<Span> {
        let behavior = &self.program.behaviors[*own.first()?];
        let view = View::of_behavior(&self.program, behavior);
        let starts = starting.case(view, behavior.law.as_ref()?);
        let holds = |clause: &&Clause| {
            let ClauseKind::Fail(test) = &clause.kind else {
                return false;
            };
            let found = self.fails.get(&test.span).and_then(|found| found.first());
            found.is_some_and(|it| starts.implies(&of_expr(&self.program, it.when, true)))
        };
        clauses.iter().find(holds).map(place)
    }

    /// Warns of a clause that ends a behaviour in the tick in which it starts.
    fn over_as_it_starts(&mut self, ends: &str, at: Span) {
        self.warning(
            Code::W0302,
            at,
            format!("this behaviour {ends} as soon as it starts"),
        )
        .label("this holds from the start")
        .note(AS_IT_STARTS)
        .help("what is waited for holds later only, such as `elapsed >= 2 s`");
    }

    /// Warns of behaviours of the library that a task chooses and that never succeed as they are called.
    /// Gives their conditions of success.
    pub fn choices_that_never_succeed(
        &mut self,
        items: impl Iterator<Item = &'a Item> + Clone,
    ) -> BTreeSet<ExprId> {
        let starting = Starting::of(&self.program.pool);
        let mut told = BTreeSet::new();
        let declared = items.clone().filter_map(|item| match &item.kind {
            ItemKind::Behavior(behavior) => Some((behavior.name.name.as_str(), &behavior.body)),
            _ => None,
        });
        let declared: BTreeMap<&str, &BehaviorBody> = declared.collect();
        // What another name stands for has its own clauses, too, if that has.
        let is_own = |name: &str| match declared.get(name) {
            Some(BehaviorBody::Alias(of)) => matches!(
                declared.get(of.name.name.as_str()),
                Some(BehaviorBody::Clauses(_))
            ),
            Some(body) => matches!(body, BehaviorBody::Clauses(_)),
            None => false,
        };
        let (mut found, mut late) = (Vec::new(), Vec::new());
        for item in items {
            let ItemKind::Task(task) = &item.kind else {
                continue;
            };
            let name = Name::word(&task.name.name);
            let Some(task_id) = self.program.tasks.named(&name) else {
                continue;
            };
            let checked = &self.program.tasks[task_id];
            let list = task.aspects.iter().find_map(|aspect| match &aspect.kind {
                AspectKind::Choose(list) => Some(list),
                _ => None,
            });
            for (place, id) in checked.written.choose.iter().zip(&checked.choose) {
                let behavior = &self.program.behaviors[*id];
                let law = behavior.law.as_ref();
                let view = View::of_behavior(&self.program, behavior);
                let law = law.filter(|law| succeeds_never(view, law, &starting));
                let at = list.and_then(|list| list.get(*place));
                let learners = self.program.learners.values();
                let learners = learners.filter(|learner| learner.task == task_id);
                let longest = learners.map(|learner| learner.episode_ticks);
                let longest = longest.fold(checked.end_after, u64::max);
                // Of its own clauses it is told where no instance of it succeeds.
                let another_succeeds = || {
                    let behaviors = self.program.behaviors.iter();
                    let mut family =
                        behaviors.filter(|(_, it)| it.name.family == behavior.name.family);
                    family.any(|(id, _)| {
                        of(&self.program, id, &|view, law| {
                            !succeeds_never(view, law, &starting)
                        })
                    })
                };
                if let (None, Some(at), Some(written)) = (law, at, behavior.law.as_ref())
                    && succeeds_after(view, written, longest, &starting)
                {
                    late.push((at.span, behavior.name.bare(), longest));
                }
                if let (Some(law), Some(at)) = (law, at)
                    && (!is_own(&behavior.name.family) || another_succeeds())
                {
                    let why = because(view, law.succeed);
                    told.insert(law.succeed);
                    found.push((at.span, behavior.name.bare(), why));
                }
            }
        }
        for (at, name, why) in found {
            self.never_succeeds(at, &name, why);
        }
        for (at, name, ticks) in late {
            self.warning(Code::W0512, at, "no episode lasts so long")
                .label(format!("so `{name}` never succeeds"))
                .note(format!("an episode ends after {ticks} ticks"));
        }
        told
    }

    fn never_succeeds(&mut self, at: Span, name: &str, why: Option<String>) {
        self.warning(Code::W0302, at, format!("`{name}` never succeeds"))
            .label("what it waits for never holds")
            .note_if(why);
    }

    /// Whether a timeout ends a behaviour before it could end by itself; warned of if so.
    pub fn is_timed_out(&mut self, at: Span, ticks: u64, child: &Node) -> bool {
        let Node::Behavior(id) = child else {
            return false;
        };
        let program = &self.program;
        let behavior = &program.behaviors[*id];
        let tick = program.world.as_ref().map(|world| world.tick);
        let elapsed = Starting::of(&program.pool).elapsed;
        let (Some(law), Some(tick), Some(elapsed)) = (&behavior.law, tick, elapsed) else {
            return false;
        };
        let time = ticks as f64 * tick;
        let within = Interval::between(0.0, time + tick / 2.0);
        let in_time = Cases::Some(vec![Case::from([(
            About::Number(elapsed),
            Says::Within(within),
        )])]);
        let view = View::of_behavior(program, behavior);
        let ends = of_expr(view, law.succeed, true).or(&of_expr(view, law.fail, true));
        let never = of_expr(view, law.requires, false).is_never() && ends.and(&in_time).is_never();
        if ends.is_never() || !never {
            return false;
        }
        let message = format!("`{}` never ends in that time", behavior.name.bare());
        self.warning(Code::W0302, at, message)
            .label("this always fails, whatever happens");
        true
    }
}

/// The place that both ends of a patrol are.
fn to_and_fro(behavior: &Behavior) -> Option<String> {
    let mut given = behavior.name.given().map(|(_, given)| given.to_string());
    let (from, to) = (given.next()?, given.next()?);
    (behavior.name.family == "patrol" && from == to).then_some(from)
}

/// Whether this is so of the law of a behaviour, read as its robot does.
fn of(program: &Program, id: Id<Behavior>, test: &dyn Fn(View, &Law) -> bool) -> bool {
    let behavior = &program.behaviors[id];
    let law = behavior.law.as_ref();
    law.is_some_and(|law| test(View::of_behavior(program, behavior), law))
}

/// Whether a behaviour that is to fail at some time never does.
fn never_fails(view: View, law: &Law) -> bool {
    let waits = view.program.pool.constant(law.fail).is_none();
    waits && of_expr(view, law.fail, true).is_never()
}

/// Whether a behaviour that is to succeed at some time never does: what it waits for never holds, or only where it has failed.
fn succeeds_never(view: View, law: &Law, starting: &Starting) -> bool {
    let waits = view.program.pool.constant(law.succeed).is_none();
    let succeeds = of_expr(view, law.succeed, true);
    let allowed = of_expr(view, law.requires, true);
    waits && (allowed.and(&succeeds).is_never() || fails_before(view, law, &succeeds, starting))
}

/// Whether a behaviour succeeds, if ever, after more ticks than these.
fn succeeds_after(view: View, law: &Law, ticks: u64, starting: &Starting) -> bool {
    let tick = view.program.world.as_ref().map(|world| world.tick);
    let (Some(tick), Some(elapsed)) = (tick, starting.elapsed) else {
        return false;
    };
    let Cases::Some(cases) = of_expr(view, law.succeed, true) else {
        return false;
    };
    let late = |case: &Case| match case.get(&About::Number(elapsed)) {
        Some(Says::Within(within)) => within.ends().0 > ticks as f64 * tick,
        _ => false,
    };
    !cases.is_empty() && cases.iter().all(late)
}

/// Whether a behaviour fails by time before it could succeed by time.
fn fails_before(view: View, law: &Law, succeeds: &Cases, starting: &Starting) -> bool {
    let tick = view.program.world.as_ref().map(|world| world.tick);
    let (Some(tick), Some(elapsed)) = (tick, starting.elapsed) else {
        return false;
    };
    let since = |case: &Case, alone: bool| match case.get(&About::Number(elapsed)) {
        Some(Says::Within(within)) if !alone || case.len() == 1 => first_tick(*within, tick, alone),
        _ => None,
    };
    let (Cases::Some(succeeds), Cases::Some(fails)) = (succeeds, of_expr(view, law.fail, true))
    else {
        return false;
    };
    let earliest = succeeds.iter().map(|case| since(case, false).unwrap_or(0));
    let fails = fails.iter().filter_map(|case| since(case, true)).min();
    fails.is_some_and(|fails| earliest.min().is_some_and(|earliest| fails < earliest))
}

/// The first tick in which the time that a behaviour has run is in an interval; `stays`: if it stays in it from then on.
fn first_tick(within: Interval, tick: f64, stays: bool) -> Option<u64> {
    let (low, high) = within.ends();
    if low <= 0.0 || low / tick > MOST_TICKS || stays && high < f64::INFINITY {
        return None;
    }
    let first = (low / tick).floor() as u64;
    (first..first + 3).find(|ticks| within.contains(*ticks as f64 * tick))
}

/// The words that a clause begins with.
fn place(clause: &Clause) -> Span {
    let length = match clause.kind {
        ClauseKind::Requires(_) => "requires".len(),
        ClauseKind::Succeed(_) => "succeed when".len(),
        ClauseKind::Fail(_) => "fail when".len(),
        ClauseKind::Control(_) => "control".len(),
        ClauseKind::Local { .. } | ClauseKind::Error => return clause.span,
    };
    let start = clause.span.range().start;
    let end = (start + length).min(clause.span.range().end);
    Span::new(clause.span.file, start, end)
}
