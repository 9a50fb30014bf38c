//! Learners: the settings for learning a task.

use crate::check::Checker;
use crate::check::context::{Context, Region};
use crate::check::expr::grouped;
use crate::check::names::learned_name;
use crate::check::types::Type;
use crate::diagnostic::{Applicability, Code, suggest};
use crate::ir::expr::{Binary, Expr};
use crate::ir::law::Behavior;
use crate::ir::task::{Discount, Learner, Method, Objective, Task};
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::ast::{self, AspectKind, ExprKind, LearnEntry, Link, Ref, Setting};
use crate::syntax::print;
use crate::syntax::words::{LEARNER, home};
use std::collections::{BTreeMap, BTreeSet};

/// The methods, by name.
const METHODS: [(&str, Method); 3] = [
    ("q_learning", Method::QLearning),
    ("double_q", Method::DoubleQ),
    ("model", Method::Model),
];

/// The names of the methods.
pub fn methods() -> impl Iterator<Item = &'static str> {
    METHODS.iter().map(|(name, _)| *name)
}

/// The method that a value names.
fn method_of(value: &ast::Expr) -> Option<&'static (&'static str, Method)> {
    let ExprKind::Ref(Ref {
        name, args: None, ..
    }) = &value.kind
    else {
        return None;
    };
    METHODS.iter().find(|(known, _)| *known == name.name)
}

impl<'a> Checker<'a> {
    /// `learn name for task { … }`
    pub fn learn(&mut self, learn: &'a ast::Learn) {
        self.context = Context::new(Region::Schedule);
        let task = match self.lacks_its_task(learn) {
            true => None,
            false => self.task_of(&learn.task),
        };
        let pool = &mut self.program.pool;
        // The defaults: steps of visits^-0.7, exploration from 30 % to 5 %.
        let visits = pool.leaf(Expr::Visits);
        let exponent = pool.num(-0.7);
        let rate = pool.binary(Binary::Pow, visits, exponent);
        let (from, to) = (pool.num(0.3), pool.num(0.05));
        let explore = self.ramp(from, to);
        let mut built = Learner {
            name: Name::word(learned_name(learn)),
            task: task.unwrap_or(Id::new(0)),
            method: Method::QLearning,
            episodes: 0,
            episode_ticks: task.map_or(0, |task| self.program.tasks[task].end_after),
            rate,
            explore,
            objective: Objective::Discounted(Discount::PerDecision(0.95)),
            initial: 0.0,
            unseen: None,
            seed: 1,
            dwell: 0,
            start: task.map_or(Vec::new(), |task| self.program.tasks[task].start.clone()),
        };
        let history = task.map(|task| &self.program.tasks[task]);
        let history = history.map(|task| (task.name.clone(), task.history));
        let mut seen: BTreeMap<&str, Span> = BTreeMap::new();
        for entry in &learn.entries {
            match entry {
                LearnEntry::Start(start) => {
                    for line in self.start(start, history.clone()) {
                        // The last one is what counts in the task.
                        let mut lines = built.start.iter_mut().rev();
                        match lines.find(|old| old.replaced_by(&line)) {
                            Some(old) => *old = line,
                            None => built.start.push(line),
                        }
                    }
                }
                LearnEntry::Setting(setting) => {
                    let name = &setting.name;
                    let first = *seen.entry(&name.name).or_insert(name.span);
                    if first != name.span {
                        self.said_twice(&name.name, name.span, first);
                        continue;
                    }
                    self.context = Context::new(Region::Schedule);
                    self.setting(setting, &mut built);
                }
                LearnEntry::Error(_) => {}
            }
        }
        self.chosen_if_unseen(learn, &built, task);
        if let (Method::Model, Some(rate)) = (built.method, seen.get("rate")) {
            self.warning(Code::W0501, *rate, "the method `model` takes no steps")
                .label("this has no effect here");
        }
        if let (Objective::Average(_), Some(at)) = (built.objective, seen.get("objective")) {
            // A line that was not understood may be the one that names the method.
            let lost = |entry: &LearnEntry| match entry {
                LearnEntry::Error(_) => true,
                LearnEntry::Setting(setting) => {
                    setting.name.name == "method" && method_of(&setting.value).is_none()
                }
                _ => false,
            };
            let lost = learn.entries.iter().any(lost) || self.names.is_lost("method");
            if built.method != Method::Model && !lost {
                let help = "say `method = model`, or give a `discount`";
                self.error(
                    Code::E0501,
                    *at,
                    "only the method `model` learns an average",
                )
                .label("an average of the reward is to be great")
                .help(help);
            } else if let Some(discount) = seen.get("discount") {
                self.warning(Code::W0501, *discount, "an average has no discount")
                    .label("this has no effect here");
            }
        }
        if !seen.contains_key("episodes") {
            let example = "episodes = 4_000";
            self.missing(
                Code::E0502,
                learn.task.span,
                "the learner",
                "episodes",
                example,
            );
        }
        if task.is_some() {
            self.program.learners.push(built);
        }
    }

    /// Reports what is to be done in unseen minterms and is none of the choices of the task.
    fn chosen_if_unseen(&mut self, learn: &'a ast::Learn, built: &Learner, task: Option<Id<Task>>) {
        let mut settings = learn.entries.iter().filter_map(|entry| match entry {
            LearnEntry::Setting(setting) => Some(setting),
            _ => None,
        });
        let setting = settings.rfind(|setting| setting.name.name == "unseen");
        let (Some(setting), Some(unseen), Some(task)) = (setting, built.unseen, task) else {
            return;
        };
        let known = &self.program.tasks[task];
        let choices = &known.choose;
        if choices.is_empty() || choices.contains(&unseen) {
            return;
        }
        // Of a choice that was not understood nobody knows what it is.
        let tasks = self.names.tasks.get(learn.task.name.as_str()).into_iter();
        let mut aspects = tasks.flat_map(|task| &task.aspects);
        let listed = aspects.find_map(|aspect| match &aspect.kind {
            AspectKind::Choose(list) => Some(list.len()),
            _ => None,
        });
        let understood: BTreeSet<usize> = known.written.choose.iter().copied().collect();
        if listed.is_some_and(|listed| understood.len() < listed) {
            return;
        }
        let message = format!("`{}` does not choose this", self.program.tasks[task].name);
        self.error(Code::E0501, setting.value.span, message)
            .label("what is done in unseen minterms is one of its choices")
            .help("list it after `choose`, or name one that is there");
    }

    /// Reports `learn NAME { … }`, which says no task, where one is known.
    fn lacks_its_task(&mut self, learn: &ast::Learn) -> bool {
        let name = &learn.task;
        let mut tasks = self.names.tasks.keys();
        let (Some(only), None) = (tasks.next().copied(), tasks.next()) else {
            return false;
        };
        let known = name.name == only || self.names.is_lost(&name.name);
        let another = self.names.value(&name.name, false).is_some();
        let like = suggest::nearest(&name.name, [only]).is_some();
        if learn.name.is_some() || known || another || like {
            return false;
        }
        let right = format!(" for {}", spelled(only));
        let message = format!("`{}` is not declared", name.name);
        self.error(Code::E0202, name.span, message)
            .label("no task has this name")
            .fix(
                format!(
                    "if the learner is called so, say its task: `{}{right}`",
                    name.name
                ),
                name.span.after(),
                right,
                Applicability::Unsafe,
            );
        true
    }

    fn setting(&mut self, setting: &'a Setting, learner: &mut Learner) {
        let name = setting.name.name.as_str();
        let allowed: &[Link] = match name {
            "episodes" => &[Link::Of],
            "discount" | "objective" => &[Link::Per],
            "rate" | "explore" => &[Link::Arrow],
            _ => &[],
        };
        if let Some((link, tail)) = &setting.tail
            && !allowed.contains(&link.node)
            && LEARNER.contains(&name)
        {
            let word = match link.node {
                Link::Of => "of",
                Link::Per => "per",
                Link::Arrow => "->",
            };
            self.error(
                Code::E0501,
                link.span.to(tail.span),
                format!("`{name}` takes no `{word}`"),
            )
            .label("this has no effect here");
            return;
        }
        let tail = setting.tail.as_ref().map(|(_, tail)| tail);
        let value = &setting.value;
        match name {
            "method" => learner.method = self.method(value).unwrap_or(learner.method),
            "episodes" => {
                let episodes = self.whole(value, "`episodes`", 1.0);
                learner.episodes = episodes.unwrap_or(learner.episodes);
                let ticks = tail.and_then(|tail| self.ticks(tail, "the length of an episode"));
                learner.episode_ticks = ticks.unwrap_or(learner.episode_ticks);
            }
            "rate" => {
                let rate = self.schedule(value, tail, "`rate`");
                learner.rate = rate.unwrap_or(learner.rate);
            }
            "explore" => {
                let explore = self.schedule(value, tail, "`explore`");
                learner.explore = explore.unwrap_or(learner.explore);
            }
            "initial" => {
                let initial = self.constant(value, &Type::NUMBER, "`initial`");
                learner.initial = initial.unwrap_or(learner.initial);
            }
            "discount" => {
                let average = matches!(learner.objective, Objective::Average(_));
                if let (Some(discount), false) = (self.discount(value, tail), average) {
                    learner.objective = Objective::Discounted(discount);
                }
            }
            "objective" => {
                let objective = self.objective(value, tail);
                learner.objective = objective.unwrap_or(learner.objective);
            }
            "unseen" => learner.unseen = self.unseen(value),
            "dwell" => learner.dwell = self.ticks(value, "`dwell`").unwrap_or(learner.dwell),
            "seed" => learner.seed = self.whole(value, "`seed`", 0.0).unwrap_or(learner.seed),
            _ => {
                let (owner, name) = ("a learner", &setting.name);
                let home = home(&name.name)
                    .map(|(whole, example)| format!("this stands in {whole}: `{example}`"));
                let foreign = match name.name.as_str() {
                    "max_episode_steps" | "max_steps" | "horizon" | "time_limit" => {
                        Some("how long an episode lasts: `episodes = 1_000 of 5 min`".to_owned())
                    }
                    _ => home,
                };
                // What is missing was likely meant by what is unknown.
                if foreign.is_none() {
                    self.names.lose("episodes");
                }
                self.unknown_to(owner, Code::E0501, name, "setting", &LEARNER)
                    .help_if(foreign);
            }
        }
    }

    fn method(&mut self, value: &'a ast::Expr) -> Option<Method> {
        if value.kind == ExprKind::Error {
            return None;
        }
        let found = method_of(value);
        if found.is_none() {
            // `q-learning` is a difference.
            let written = print::expr(value).replace(" - ", "-").replace('-', "_");
            let likely = suggest::nearest(&written, methods());
            let message = "no method of learning has this name";
            let draft = self.error(Code::E0501, value.span, message);
            match likely {
                Some(likely) => draft.label(format!("did you mean `{likely}`?")).fix(
                    format!("write `{likely}`"),
                    value.span,
                    likely,
                    Applicability::Unsafe,
                ),
                None => draft.label("unknown"),
            }
            .help("there are: q_learning, double_q, model");
        }
        found.map(|(_, method)| *method)
    }

    /// The behaviour that is chosen where nothing has been learned.
    fn unseen(&mut self, value: &'a ast::Expr) -> Option<Id<Behavior>> {
        match &value.kind {
            ExprKind::Ref(reference) => {
                self.context.region = Region::Tree;
                self.behavior_ref(reference)
            }
            ExprKind::Error => None,
            _ => self
                .error(Code::E0203, value.span, "`unseen` names a behaviour")
                .label("this is an expression")
                .none(),
        }
    }

    /// A whole number that is not less than `least`.
    fn whole(&mut self, value: &'a ast::Expr, role: &str, least: f64) -> Option<u64> {
        let number = self.constant(value, &Type::NUMBER, role)?;
        let literal = match &value.kind {
            ExprKind::Number(literal) => Some(literal),
            _ => None,
        };
        if number.fract() == 0.0 && (least..=9e15).contains(&number) {
            if let Some(literal) = literal {
                self.point_in_count(literal, value.span);
            }
            return Some(number as u64);
        }
        let label = if number < least {
            "this is too small"
        } else if number.fract() == 0.0 {
            "this is too large"
        } else {
            "this is not a whole number"
        };
        let draft = self.out_of_range(
            value.span,
            format!("{role} is a whole number from {least} up"),
            label,
        );
        match literal.and_then(grouped) {
            Some(grouped) => draft.help(format!("digits are grouped by `_`: `{grouped}`")),
            None => draft,
        }
        .none()
    }

    /// `average per 1 s`
    fn objective(
        &mut self,
        value: &'a ast::Expr,
        tail: Option<&'a ast::Expr>,
    ) -> Option<Objective> {
        match (&value.kind, tail) {
            (
                ExprKind::Ref(Ref {
                    name, args: None, ..
                }),
                Some(tail),
            ) if name.name == "average" => {
                let seconds = self.constant(tail, &Type::TIME, "the time of an average")?;
                if seconds > 0.0 {
                    return Some(Objective::Average(seconds));
                }
                self.out_of_range(
                    tail.span,
                    "the time of an average is above zero",
                    "no time passes in this",
                )
                .none()
            }
            (ExprKind::Error, _) => None,
            _ => self
                .error(
                    Code::E0501,
                    value.span,
                    "an objective is `average per` a time",
                )
                .label("this is something else")
                .help("say `objective = average per 1 s`, or a `discount` for a discounted sum")
                .none(),
        }
    }

    /// `d per decision`, `d per 1 s`
    fn discount(&mut self, value: &'a ast::Expr, tail: Option<&'a ast::Expr>) -> Option<Discount> {
        // `0.8 / 5 s`
        if let (ExprKind::Binary { op, left, right }, None) = (&value.kind, tail)
            && op.node == ast::BinaryOp::Div
            && matches!(right.kind, ExprKind::Number(_))
        {
            let (time, _) = self.captured(|checker| checker.expr(right));
            if time.ty == Type::TIME {
                let right = format!("{} per {}", print::expr(left), print::expr(right));
                return self
                    .error(
                        Code::E0501,
                        value.span,
                        "the time of a discount follows `per`",
                    )
                    .write(value.span, right, Applicability::Unsafe)
                    .none();
            }
        }
        let factor = self.constant(value, &Type::NUMBER, "`discount`")?;
        if !(0.0..=1.0).contains(&factor) {
            let label = if factor > 1.0 {
                "later rewards would count for more than earlier ones"
            } else {
                "later rewards would count against themselves"
            };
            return self
                .out_of_range(value.span, "a discount goes from 0 to 1", label)
                .none();
        }
        let Some(tail) = tail else {
            return self
                .error(
                    Code::E0501,
                    value.span,
                    "a discount says what it is counted by",
                )
                .label("by decisions, or by time?")
                .fix(
                    "count it by decisions",
                    value.span.after(),
                    " per decision",
                    Applicability::Unsafe,
                )
                .help("or by time: `per 1 s`")
                .none();
        };
        if is_word(tail, &["decision"]) {
            return Some(Discount::PerDecision(factor));
        }
        if is_word(tail, &["decisions", "step", "steps", "action", "choice"]) {
            return self
                .error(
                    Code::E0501,
                    tail.span,
                    "a discount is counted by decisions, or by time",
                )
                .write(tail.span, "decision", Applicability::Unsafe)
                .none();
        }
        let seconds = self.constant(tail, &Type::TIME, "the time of a discount")?;
        if seconds > 0.0 {
            return Some(Discount::PerTime(factor, seconds));
        }
        self.out_of_range(
            tail.span,
            "the time of a discount is above zero",
            "no time passes in this",
        )
        .none()
    }
}

/// Whether an expression is one of some words.
fn is_word(expr: &ast::Expr, words: &[&str]) -> bool {
    matches!(&expr.kind, ExprKind::Ref(Ref { name, args: None, .. }) if words.contains(&name.name.as_str()))
}
