//! Predicates that say nothing, or nothing new, to the task that observes them.

use super::apart::because;
use super::cases::of_expr;
use super::view::View;
use crate::check::Checker;
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::diagnostic::Code;
use crate::ir::expr::ExprId;
use crate::ir::program::Predicate;
use crate::ir::world::Robot;
use crate::ir::{Id, Name, Program};
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::ast::{
    AspectKind, BehaviorBody, ClauseKind, Expr, Ident, Item, ItemKind, Ref, Task,
};
use crate::syntax::print;
use std::collections::{BTreeMap, BTreeSet};

impl<'a> Checker<'a> {
    /// Warns of predicates that always or never hold, of pairs that say the same, and of what a behaviour requires and
    /// the task does not observe.
    pub fn predicates_without_effect(&mut self, items: impl Iterator<Item = &'a Item> + Clone) {
        let mut told = BTreeSet::new();
        for item in items.clone() {
            match &item.kind {
                ItemKind::Predicate(predicate) => {
                    if let Some(value) = &predicate.value
                        && self.constant.contains(&predicate.name.name)
                    {
                        self.constant_predicate(&predicate.name.name, value);
                    }
                }
                ItemKind::Task(task) => {
                    self.predicates_alike(task, &mut told);
                    self.unobserved(task, items.clone());
                }
                _ => {}
            }
        }
        self.declared_alike(items, &told);
    }

    /// Warns of predicates, and of events, that ask the same under two names; of those predicates it has been `told` as they
    /// are observed.
    fn declared_alike(
        &mut self,
        items: impl Iterator<Item = &'a Item>,
        told: &BTreeSet<Id<Predicate>>,
    ) {
        let program = &self.program;
        let asks = |item: &'a Item| match &item.kind {
            ItemKind::Predicate(predicate) if predicate.params.is_none() => {
                let id = program
                    .predicates
                    .named(&Name::word(&predicate.name.name))?;
                let when = program.predicates[id]
                    .when
                    .filter(|_| !told.contains(&id))?;
                Some((
                    "predicate",
                    &predicate.name,
                    predicate.value.as_ref()?,
                    when,
                ))
            }
            ItemKind::Event(event) if event.params.is_none() => {
                let id = program.events.named(&Name::word(&event.name.name))?;
                Some(("event", &event.name, &event.value, program.events[id].when))
            }
            _ => None,
        };
        let mut seen: BTreeMap<(&str, ExprId), (&'a Ident, Span)> = BTreeMap::new();
        let mut found = Vec::new();
        for (what, name, value, when) in items.filter_map(asks) {
            // Whoever names a name once more does that on purpose.
            if plain_ref(value).is_some() || program.pool.constant(when).is_some() {
                continue;
            }
            let (first, at) = *seen.entry((what, when)).or_insert((name, value.span));
            if at != value.span && at.file == value.span.file {
                found.push((what, value.span, &first.name, at));
            }
        }
        for (what, here, first, at) in found {
            let message = format!("this {what} is `{first}` under another name");
            self.warning(Code::W0513, here, message)
                .label(format!("it asks what `{first}` asks"))
                .also(at, "asked here already");
        }
    }

    /// Warns of a predicate that is constant for every robot that reads it.
    fn constant_predicate(&mut self, name: &str, value: &Expr) {
        let program = &self.program;
        let read = program.predicates.values();
        let read = read.filter(|predicate| predicate.name.family == name);
        let read = read.filter_map(|it| Some((View::of_predicate(program, &it.name), it.when?)));
        let read: Vec<(View, ExprId)> = read.collect();
        let Some(&(view, when)) = read.first() else {
            return;
        };
        if self.says_one_thing_twice(value.span) {
            return;
        }
        let why = because(view, when);
        let read: Vec<(Id<Robot>, bool, ExprId)> = read
            .iter()
            .map(|(view, when)| (view.robot, view.open, *when))
            .collect();
        let never = |program: &Program, wanted| {
            read.iter().all(|(robot, open, when)| {
                let view = View {
                    robot: *robot,
                    open: *open,
                    ..View::from(program)
                };
                of_expr(view, *when, wanted).is_never()
            })
        };
        let (says, wanted) = match [true, false].map(|wanted| never(&self.program, wanted)) {
            [true, _] => ("never", true),
            [_, true] => ("always", false),
            _ => return,
        };
        let asked: Vec<ExprId> = read.iter().map(|(.., when)| *when).collect();
        let cause = self.cause(&asked, &|program| never(program, wanted));
        if self.has_told(cause, value.span, &format!("{says} holds")) {
            return;
        }
        let message = format!("the predicate `{name}` {says} holds");
        self.warning(Code::W0601, value.span, message)
            .label("whatever happens in the world")
            .note_if(why);
        self.tells(cause);
    }

    /// Finds the predicates that always or never hold, whoever reads them, and whichever of a family it is: that is told where they
    /// are defined.
    pub fn find_constant_predicates(&mut self) {
        let program = &self.program;
        let mut families: BTreeMap<&str, [bool; 2]> = BTreeMap::new();
        for predicate in program.predicates.values() {
            let Some(when) = predicate.when else {
                continue;
            };
            let view = View::of_predicate(program, &predicate.name);
            // What an argument makes constant depends on the argument.
            let open = predicate.name.arguments.is_empty() || program.pool.constant(when).is_none();
            let family = families.entry(&predicate.name.family).or_insert([true; 2]);
            for (never, wanted) in family.iter_mut().zip([true, false]) {
                *never = *never && open && of_expr(view, when, wanted).is_never();
            }
        }
        let constant = families
            .into_iter()
            .filter(|(_, never)| never.contains(&true));
        self.constant = constant.map(|(family, _)| family.to_owned()).collect();
    }

    /// What those predicates ask.
    pub fn constant_predicates(&self) -> BTreeSet<ExprId> {
        let program = &self.program;
        let told = program.predicates.values();
        let told = told.filter(|it| self.constant.contains(&it.name.family));
        let asked = told.filter_map(|it| it.when);
        asked
            .filter(|when| program.pool.constant(*when).is_none())
            .collect()
    }

    /// The references of a list of the task, each with the predicate that it observes.
    pub(super) fn observed_by(&self, task: &'a Task) -> Vec<(&'a Ref, Id<Predicate>)> {
        let name = Name::word(&task.name.name);
        let Some(id) = self.program.tasks.named(&name) else {
            return Vec::new();
        };
        let list = task.aspects.iter().find_map(|aspect| match &aspect.kind {
            AspectKind::Observe(list) => Some(list),
            _ => None,
        });
        let task = &self.program.tasks[id];
        let observed = task.written.observe.iter().zip(&task.observe);
        let written = |(place, id): (&usize, &Id<Predicate>)| {
            let reference = list.and_then(|list| list.get(*place)).and_then(plain_ref)?;
            Some((reference, *id))
        };
        observed.filter_map(written).collect()
    }

    /// Of two observed predicates that are equal, or opposites, the second tells nothing. Two members of one family stand
    /// and fall together. Adds the predicates of which that is told.
    fn predicates_alike(&mut self, task: &'a Task, told: &mut BTreeSet<Id<Predicate>>) {
        let observed = self.observed_by(task);
        for (at, &(reference, id)) in observed.iter().enumerate() {
            let before = observed.iter().take(at);
            for &(first, other) in before.filter(|(first, _)| first.span != reference.span) {
                let (Some(one), Some(two)) = (
                    self.program.predicates[other].when,
                    self.program.predicates[id].when,
                ) else {
                    continue;
                };
                // Of what always or never holds that is told.
                let constant = |id| {
                    let name = &self.program.predicates[id].name;
                    self.constant.contains(&name.family)
                };
                if constant(id) && constant(other) {
                    continue;
                }
                let cases = |id, wanted| of_expr(&self.program, id, wanted);
                let same = |wanted| {
                    let (one, two) = (cases(one, true), cases(two, wanted));
                    !one.is_never() && one.implies(&two) && two.implies(&one)
                };
                let what = if one == two || same(true) {
                    "says the same as"
                } else if same(false) {
                    "is the opposite of"
                } else {
                    continue;
                };
                // Of a family that does not read its parameter, that is told.
                if let Some((Decl::Predicate(family), _)) =
                    self.names.value(&reference.name.name, false)
                    && let Some(params) = &family.params
                    && params
                        .params
                        .iter()
                        .any(|it| self.unread.contains(&it.name.span))
                {
                    break;
                }
                let names = [id, other].map(|id| self.program.predicates[id].name.to_string());
                let [name, of] = names.map(|name| name.trim_matches('`').to_owned());
                told.insert(id);
                let message = format!("`{name}` {what} `{of}`");
                self.warning(Code::W0513, reference.span, message)
                    .label("observing this as well tells the robot nothing")
                    .also(first.span, "observed already");
                break;
            }
        }
    }

    /// A behaviour of the user that requires a predicate which the task does not observe fails for no reason that the
    /// policy could learn.
    fn unobserved(&mut self, task: &'a Task, items: impl Iterator<Item = &'a Item> + Clone) {
        let observed = self.observed_by(task);
        if observed.is_empty() {
            return;
        }
        let families: Vec<&str> = observed
            .iter()
            .map(|(reference, _)| reference.name.name.as_str())
            .collect();
        let told = observed
            .iter()
            .flat_map(|(reference, _)| self.read_of(reference));
        let told: BTreeSet<&str> = told.collect();
        let lists = task.aspects.iter().filter_map(|aspect| match &aspect.kind {
            AspectKind::Choose(list) => Some(list),
            _ => None,
        });
        for chosen in lists.flatten().filter_map(plain_ref) {
            let behavior = items.clone().find_map(|item| match &item.kind {
                ItemKind::Behavior(behavior) if behavior.name.name == chosen.name.name => {
                    Some(behavior)
                }
                _ => None,
            });
            let Some(BehaviorBody::Clauses(clauses)) = behavior.map(|behavior| &behavior.body)
            else {
                continue;
            };
            for clause in clauses {
                let ClauseKind::Requires(test) = &clause.kind else {
                    continue;
                };
                if let Some(part) = self.unread_part(task, test, &told) {
                    let message = format!(
                        "the task `{}` observes nothing of `{}`, which `{}` requires",
                        task.name.name,
                        print::expr(part),
                        chosen.name.name
                    );
                    self.warning(Code::W0514, chosen.span, message)
                        .label("where it does not hold, this fails, and the policy cannot tell why")
                        .also(part.span, "required here");
                    continue;
                }
                for reference in test.conjuncts().into_iter().filter_map(plain_ref) {
                    let name = reference.name.name.as_str();
                    let is_predicate =
                        matches!(self.names.value(name, false), Some((Decl::Predicate(_), _)));
                    if !is_predicate || families.contains(&name) || self.is_told(name, &observed) {
                        continue;
                    }
                    let name = spelled(name).trim_matches('`').to_owned();
                    let message = format!(
                        "the task `{}` does not observe `{name}`, which `{}` requires",
                        task.name.name, chosen.name.name
                    );
                    self.warning(Code::W0514, chosen.span, message)
                        .label("where it does not hold, this fails, and the policy cannot tell why")
                        .also(reference.span, "required here");
                }
            }
        }
    }

    /// The part of a requirement that names no predicate, and reads states or places that are not among those of which the task is
    /// told. Where the robot has been, its history tells.
    fn unread_part(&self, task: &Task, test: &'a Expr, told: &BTreeSet<&str>) -> Option<&'a Expr> {
        let id = self.program.tasks.named(&Name::word(&task.name.name))?;
        let remembers = self.program.tasks[id].history.window > 0;
        let unread = |part: &&'a Expr| {
            let read = self.read_by(part);
            let state =
                |name: &&str| matches!(self.names.value(name, false), Some((Decl::State(_), _)));
            let tells = !remembers || read.iter().any(state);
            let named = plain_ref(part).is_some_and(|reference| {
                let name = reference.name.name.as_str();
                matches!(self.names.value(name, false), Some((Decl::Predicate(_), _)))
            });
            !named && !read.is_empty() && tells && read.is_disjoint(told)
        };
        test.conjuncts().into_iter().find(unread)
    }

    /// Whether another predicate of the list says what the one of this name does.
    fn is_told(&self, name: &str, observed: &[(&'a Ref, Id<Predicate>)]) -> bool {
        let mut predicates = self.program.predicates.values();
        let named = predicates.find(|predicate| predicate.name.family == name);
        let Some(when) = named.and_then(|predicate| predicate.when) else {
            // One that no task and no tree asks has no instance to compare.
            return false;
        };
        let mut observed = observed
            .iter()
            .map(|(_, id)| self.program.predicates[*id].when);
        observed.any(|other| other == Some(when))
    }
}
