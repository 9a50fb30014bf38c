//! Rewards that are never paid, ends that count for nothing, and times that never pass.

use super::cases::{About, Case, Cases, Says, of_expr};
use super::conditions::is_nameless;
use super::repaid::{self, Setters};
use super::tree::as_it_succeeds;
use crate::check::Checker;
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Expr, ExprId};
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::{Id, Name, Program};
use crate::source::Span;
use crate::syntax::ast::{
    self, AspectKind, BinaryOp, ExprKind, Item, ItemKind, Paid, RewardLine, UnaryOp,
};
use crate::syntax::print;
use std::collections::{BTreeMap, BTreeSet};

/// How many lines of a task are held against each line; of what comes after them, nothing is said.
const MOST: usize = 128;

impl<'a> Checker<'a> {
    /// Warns of what a task says about rewards, ends and times without any effect.
    pub fn rewards_without_effect(&mut self, items: impl Iterator<Item = &'a Item>) {
        let happen = self.families_that_happen();
        let setters = Setters::of(&self.program);
        for item in items {
            let ItemKind::Task(task) = &item.kind else {
                continue;
            };
            let name = Name::word(&task.name.name);
            if let Some(id) = self.program.tasks.named(&name) {
                self.rewards_of(task, id, (&happen, &setters));
            }
        }
    }

    fn rewards_of(
        &mut self,
        task: &'a ast::Task,
        id: Id<Task>,
        (happen, setters): (&BTreeSet<String>, &Setters),
    ) {
        let checked = self.program.tasks[id].clone();
        let mut ends = 0;
        let values = checked.reward.iter().map(|line| line.value);
        let prices = checked.prices.iter().map(|price| price.per_second);
        let mut values = values.chain(prices).chain([checked.otherwise]);
        let pays_nothing = values.all(|id| self.program.pool.constant(id) == Some(0.0));
        let paid = self.cases_of(checked.reward.iter().map(|line| &line.event));
        let denied = denied(task);
        for aspect in &task.aspects {
            match &aspect.kind {
                AspectKind::Reward { lines, otherwise } => {
                    self.lines_without_effect(lines, (id, &checked), happen, setters);
                    self.prices_twice(lines);
                    if pays_nothing {
                        let last = otherwise.as_ref().or(lines.last().map(|line| &line.value));
                        let span = last.map_or(aspect.span, |value| value.span);
                        self.warning(Code::W0510, span, "every reward of this task is 0")
                            .label("so any tree is as good as any other");
                    } else {
                        self.prices_of_nothing(lines);
                    }
                }
                AspectKind::EndOn(event) => {
                    // Of a line that waits for its absence another warning is told, and of a reward that pays nothing.
                    if !denied.contains(&print::expr(event)) && !pays_nothing {
                        self.end_without_value(event, ends, &checked, (&paid, happen));
                    }
                    ends += 1;
                }
                AspectKind::Patience(time)
                    if checked
                        .patience
                        .is_some_and(|ticks| ticks >= checked.end_after) =>
                {
                    self.warning(Code::W0512, time.span, "no episode lasts so long")
                        .label("so patience never runs out")
                        .note(format!("an episode ends after {} ticks", checked.end_after));
                }
                _ => {}
            }
        }
    }

    /// The first line whose event happens gives the reward.
    fn lines_without_effect(
        &mut self,
        lines: &'a [RewardLine],
        (id, checked): (Id<Task>, &Task),
        happen: &BTreeSet<String>,
        setters: &Setters,
    ) {
        let mut before: Vec<(Span, Cases)> = Vec::new();
        let ends: Vec<Cases> = self.cases_of(&checked.end_on);
        let ends = ends.get(..MOST).unwrap_or(&ends);
        let run = self.run_in_learning(id);
        for (place, line) in lines.iter().enumerate() {
            let here = line.paid.span();
            // A line for the members of a kind is one for each.
            let members = checked.written.reward.iter().zip(&checked.reward);
            let members = members.filter(|(of, _)| **of == place);
            let cases: Vec<Cases> = members
                .map(|(_, line)| of_expr(&self.program, line.event, true))
                .collect();
            let Some(first) = cases.first() else {
                continue;
            };
            let earlier = before.iter().find(|(_, earlier)| first.implies(earlier));
            let covered = |cases: &Cases| before.iter().any(|(_, earlier)| cases.implies(earlier));
            if cases.iter().all(Cases::is_never) {
                if self.waits_for_an_event(checked, place, happen) {
                    continue;
                }
                let members = checked.written.reward.iter().zip(&checked.reward);
                let members = members.filter(|(of, _)| **of == place);
                let asked: Vec<ExprId> = members.map(|(_, line)| line.event).collect();
                self.never_happens(here, "this reward is never paid", &asked);
            } else if let Some((earlier, _)) = earlier.filter(|_| cases.iter().all(covered)) {
                let earlier = *earlier;
                // Of a condition that always holds it has been told.
                let mut before = before.iter().filter(|(at, _)| *at == earlier);
                let told = |it: &Diagnostic| it.code == Code::W0601;
                if before.any(|(_, cases)| cases.is_always()) && self.diagnostics.iter().any(told) {
                    continue;
                }
                // So has been of an event that is another one under its name.
                let event = match &line.paid {
                    Paid::On(event) => plain_ref(event),
                    Paid::Per { .. } => None,
                };
                let event = event.and_then(|asked| self.names.value(&asked.name.name, false));
                if let Some((Decl::Event(event), _)) = event
                    && self.is_told_within(Code::W0513, event.value.span)
                {
                    continue;
                }
                self.warning(Code::W0509, here, "this reward is never paid")
                    .label("whenever this happens, an earlier line pays")
                    .also(earlier, "this line comes first");
            }
            if self.pays_whatever_happens(&line.paid, (checked, place)) {
                continue;
            }
            let members = checked.written.reward.iter().zip(&checked.reward);
            let members = members.filter(|(of, _)| **of == place);
            let stands = members.map(|(_, line)| as_it_succeeds(&self.program, line.event));
            let mut paid = cases.iter().zip(stands);
            let ends = paid.all(|(cases, stands)| {
                let cases = cases.and(&stands);
                ends.iter().any(|end| cases.implies(end))
            });
            if let Paid::On(condition) = &line.paid
                && !ends
            {
                let known = self.diagnostics.len();
                self.pays_again_and_again(condition);
                if self.diagnostics.len() == known {
                    self.pays_for_standing(condition.span, (checked, place), setters);
                    self.pays_for_lasting(condition.span, (checked, place), setters);
                }
            }
            if let Some(run) = &run {
                self.pays_for_others(here, run, &cases);
            }
            self.chooses_what_is_so(&line.value, (checked, place));
            if before.len() < MOST {
                before.extend(cases.into_iter().map(|cases| (here, cases)));
            }
        }
    }

    /// Warns of `on dead or not dead`, which is paid in every tick. Of a name that always holds it is told where that is declared.
    fn pays_whatever_happens(&mut self, paid: &Paid, (checked, place): (&Task, usize)) -> bool {
        let Paid::On(condition) = paid else {
            return false;
        };
        let members = checked.written.reward.iter().zip(&checked.reward);
        let mut members = members.filter(|(of, _)| **of == place).peekable();
        let named = plain_ref(condition).is_some() || is_nameless(condition);
        let always = members.peek().is_some()
            && members.all(|(_, line)| of_expr(&self.program, line.event, false).is_never());
        if named || !always {
            return false;
        }
        self.warning(
            Code::W0519,
            condition.span,
            "this always holds: it is paid in every tick",
        )
        .label("whatever happens in the world")
        .help("a price for all of the time is written `per 1 s: …`");
        true
    }

    /// The behaviours that end where a task is learned: those of its policies, and of other robots. `None` if nobody learns it.
    pub(super) fn run_in_learning(&self, id: Id<Task>) -> Option<BTreeSet<Id<Behavior>>> {
        let learners = self.program.learners.values();
        let mut learners = learners.filter(|learner| learner.task == id).peekable();
        learners.peek()?;
        let mut run = self.run_by_others();
        run.extend(&self.program.tasks[id].choose);
        run.extend(learners.filter_map(|learner| learner.unseen));
        Some(run)
    }

    /// Warns of a line that waits for the end of a behaviour which what is learned does not run.
    fn pays_for_others(&mut self, here: Span, run: &BTreeSet<Id<Behavior>>, cases: &[Cases]) {
        let Some(behavior) = waits_for_others(&self.program, run, cases) else {
            return;
        };
        let name = self.program.behaviors[behavior].name.clone();
        self.warning(Code::W0509, here, "what is learned never gets this reward")
            .label(format!(
                "it waits for `{name}`, which `choose` does not list"
            ))
            .help(format!("add `{name}` to `choose`"));
    }

    /// Two lines for the same time are added up: whoever writes the same one twice hardly means that.
    fn prices_twice(&mut self, lines: &'a [RewardLine]) {
        let mut first = BTreeMap::new();
        for line in lines {
            let Paid::Per { during, time } = &line.paid else {
                continue;
            };
            let during = during.as_ref().map(print::expr);
            let (written, value) = ((during, print::expr(time)), print::expr(&line.value));
            let (earlier, other) = first
                .entry(written)
                .or_insert((line.span, value.clone()))
                .clone();
            if earlier == line.span {
                continue;
            }
            let message = match other == value {
                true => "this price is given twice",
                false => "a second price for the same time",
            };
            self.warning(Code::W0303, line.span, message)
                .label("both are paid")
                .also(earlier, "the first time");
        }
    }

    /// A price of 0 adds nothing. A line with `on` may pay 0, so that no later line pays for its event.
    fn prices_of_nothing(&mut self, lines: &'a [RewardLine]) {
        for line in lines {
            let is_zero =
                matches!(&line.value.kind, ExprKind::Number(number) if number.value == 0.0);
            if is_zero && matches!(line.paid, Paid::Per { .. }) {
                self.warning(Code::W0510, line.value.span, "this price is 0")
                    .label("it adds nothing to any reward");
            }
        }
    }

    /// When expressions hold.
    fn cases_of<'e>(&self, asked: impl IntoIterator<Item = &'e ExprId>) -> Vec<Cases> {
        let cases = |id: &ExprId| of_expr(&self.program, *id, true);
        asked.into_iter().map(cases).collect()
    }

    /// `on battery_low: -1`: what holds for a while is paid in every tick of it.
    fn pays_again_and_again(&mut self, condition: &ast::Expr) {
        let name = print::expr(condition);
        if self.stands(condition) {
            let message = format!(
                "`{name}` asks only where the robot is: this is paid in every tick that it stays"
            );
            self.warning(Code::W0519, condition.span, message)
                .label("so long as it holds")
                .help("what happens once is an event, such as the success of a behaviour");
            return;
        }
        if !self.lasts(condition) {
            return;
        }
        let message = match plain_ref(condition) {
            Some(_) => {
                format!("`{name}` is a predicate: this is paid in every tick in which it holds")
            }
            None => "predicates alone are no event: this is paid in every tick in which they hold"
                .to_owned(),
        };
        self.warning(Code::W0519, condition.span, message)
            .label("an event happens, a predicate lasts")
            .help(format!(
                "a price for the time is written `while {name}, per 1 s: …`"
            ))
            .help("what happens once is an event, such as the success of a behaviour");
    }

    /// Whether a condition is an event that asks nothing but where the robot is.
    fn stands(&self, condition: &ast::Expr) -> bool {
        let called = plain_ref(condition).map(|asked| Name::word(&asked.name.name));
        let event = called.and_then(|name| self.program.events.named(&name));
        event.is_some_and(|event| {
            let when = self.program.events[event].when;
            let waits = self.program.pool.constant(when).is_none();
            waits && repaid::lasts(&self.program, when)
        })
    }

    /// Whether a condition asks nothing but predicates.
    fn lasts(&self, condition: &ast::Expr) -> bool {
        match &condition.kind {
            ExprKind::Paren(inner) => self.lasts(inner),
            ExprKind::Unary { operand, .. } => self.lasts(operand),
            ExprKind::Binary { op, left, right } => {
                matches!(op.node, BinaryOp::And | BinaryOp::Or)
                    && self.lasts(left)
                    && self.lasts(right)
            }
            ExprKind::Ref(asked) => {
                let name = Name::word(&asked.name.name);
                self.program.predicates.named(&name).is_some()
            }
            _ => false,
        }
    }

    /// Whether what a line of `reward` waits for is an event, whose own condition is told.
    fn waits_for_an_event(&self, checked: &Task, place: usize, happen: &BTreeSet<String>) -> bool {
        let lines = checked.written.reward.iter().zip(&checked.reward);
        let mut own = lines.filter(|(of, _)| **of == place);
        own.all(|(_, line)| self.is_told_of(line.event, happen))
    }

    /// Whether an expression asks for an event that is not one of a family, or for one of a family that never happens.
    fn is_told_of(&self, id: ExprId, happen: &BTreeSet<String>) -> bool {
        match self.program.pool.get(id) {
            Expr::Event(event) => {
                let name = &self.program.events[event].name;
                name.arguments.is_empty() || !happen.contains(&name.family)
            }
            _ => false,
        }
    }

    /// The families of events of which one may happen.
    fn families_that_happen(&self) -> BTreeSet<String> {
        let events = self.program.events.values();
        let families = events.filter(|event| !event.name.arguments.is_empty());
        let happen = families.filter(|event| !of_expr(&self.program, event.when, true).is_never());
        happen.map(|event| event.name.family.clone()).collect()
    }

    /// A line of `end on`, by its place among them; `paid` says when the lines of `reward` pay.
    fn end_without_value(
        &mut self,
        event: &'a ast::Expr,
        place: usize,
        checked: &Task,
        (paid, happen): (&[Cases], &BTreeSet<String>),
    ) {
        let members = checked.written.end_on.iter().zip(&checked.end_on);
        let members = members.filter(|(of, _)| **of == place);
        let ends: Vec<Cases> = members
            .map(|(_, end)| of_expr(&self.program, *end, true))
            .collect();
        if ends.is_empty() {
            return;
        }
        if ends.iter().all(Cases::is_never) {
            let all = checked.end_on.iter().zip(&checked.written.end_on);
            let own = all.filter(|(_, of)| **of == place).map(|(end, _)| *end);
            let own: Vec<ExprId> = own.collect();
            if !own.iter().all(|end| self.is_told_of(*end, happen)) {
                self.never_happens(event.span, "no episode ends on this", &own);
            }
            return;
        }
        if paid.len() > MOST {
            return;
        }
        let tells = |end: &Cases, paid: &Cases| {
            !end.and(paid).is_never() && (end.implies(paid) || paid.implies(end))
        };
        let rewarded = (paid.iter()).any(|paid| ends.iter().any(|end| tells(end, paid)));
        if !rewarded {
            self.warning(Code::W0511, event.span, "this end is neither good nor bad")
                .label("no line of `reward` says what it is worth")
                .help("reward it, or make it cost something, such as `on EVENT: -5`");
        }
    }

    /// Warns of what waits for something that never happens.
    fn never_happens(&mut self, at: Span, message: &str, asked: &[ExprId]) {
        let cause = self.cause(asked, &|program| {
            let mut asked = asked.iter();
            asked.all(|id| of_expr(program, *id, true).is_never())
        });
        if !self.has_told(cause, at, "never happens") {
            self.warning(Code::W0509, at, message)
                .label("this never happens");
            self.tells(cause);
        }
    }
}

/// The behaviour, which is not among those that are `run`, for whose end each of these cases waits.
pub(super) fn waits_for_others(
    program: &Program,
    run: &BTreeSet<Id<Behavior>>,
    cases: &[Cases],
) -> Option<Id<Behavior>> {
    let missing = |case: &Case| {
        case.iter().find_map(|(about, says)| match about {
            About::Truth(asked) if *says == Says::Is(true) => match program.pool.get(*asked) {
                Expr::Ended(behavior, _) if !run.contains(&behavior) => Some(behavior),
                _ => None,
            },
            About::Ended(behavior) if says.is_an_end() => {
                (!run.contains(behavior)).then_some(*behavior)
            }
            _ => None,
        })
    };
    let cases = cases.iter().map(|cases| match cases {
        Cases::Some(cases) => cases.iter().map(missing).collect(),
        Cases::Unknown => None,
    });
    let missing: Option<Vec<Vec<Id<Behavior>>>> = cases.collect();
    missing.into_iter().flatten().flatten().next()
}

/// What lines of `reward` wait for the absence of.
fn denied(task: &ast::Task) -> BTreeSet<String> {
    let rewards = task.aspects.iter().filter_map(|aspect| match &aspect.kind {
        AspectKind::Reward { lines, .. } => Some(lines),
        _ => None,
    });
    let absent = rewards.flatten().filter_map(|line| match &line.paid {
        Paid::On(ast::Expr {
            kind: ExprKind::Unary { op, operand },
            ..
        }) if op.node == UnaryOp::Not => Some(print::expr(operand)),
        _ => None,
    });
    absent.collect()
}
