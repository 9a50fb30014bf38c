//! Episodes that end as they start.

use super::cases::of_expr;
use super::interval::Interval;
use super::stays::{Set, set_in_ticks};
use super::view::View;
use crate::check::Checker;
use crate::check::names::learned_name;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::ExprId;
use crate::ir::task::{StartLine, Task};
use crate::ir::world::World;
use crate::ir::{Id, Name};
use crate::spelling::spelled;
use crate::syntax::ast::{self, AspectKind, Ident, Item, ItemKind, LearnEntry};
use std::collections::BTreeMap;

/// The most starts of states that are looked at.
const MOST: usize = 20_000;

/// How many standard deviations of noise the speed of a robot is off, at most.
const NOISE: f64 = 6.0;

/// The starts that a task or a learner declares.
pub(super) fn starts(item: &Item) -> Vec<&ast::Start> {
    match &item.kind {
        ItemKind::Task(task) => {
            let starts = task.aspects.iter().filter_map(|aspect| match &aspect.kind {
                AspectKind::Start(start) => Some(start),
                _ => None,
            });
            starts.collect()
        }
        ItemKind::Learn(learn) => {
            let starts = learn.entries.iter().filter_map(|entry| match entry {
                LearnEntry::Start(start) => Some(start),
                _ => None,
            });
            starts.collect()
        }
        _ => Vec::new(),
    }
}

impl<'a> Checker<'a> {
    /// Warns of ends that hold in the first tick of every episode, of a task or of training alone.
    pub fn ends_at_starts(&mut self, items: impl Iterator<Item = &'a Item>) {
        if self.program.tasks.len() * self.program.states.len() > MOST {
            return;
        }
        let changed = set_in_ticks(&self.program);
        for item in items {
            match &item.kind {
                ItemKind::Task(task) => self.task_ends_at_start(task, &changed),
                ItemKind::Learn(learn) => self.training_ends_at_start(learn, &changed),
                _ => {}
            }
        }
    }

    fn task_ends_at_start(&mut self, task: &'a ast::Task, changed: &Set) {
        let Some(id) = self.program.tasks.named(&Name::word(&task.name.name)) else {
            return;
        };
        let start = self.program.tasks[id].start.clone();
        let held = self.held_at_starts((id, &start), changed);
        let ends = task.aspects.iter().filter_map(|aspect| match &aspect.kind {
            AspectKind::EndOn(event) => Some(event),
            _ => None,
        });
        let written = &self.program.tasks[id].written.end_on;
        let ends = ends.enumerate().filter(|(place, _)| {
            let mut members = written.iter().zip(&held);
            members.any(|(of, held)| of == place && *held)
        });
        let ends: Vec<_> = ends.map(|(_, event)| event.span).collect();
        for at in ends {
            // So have an event that is waited for wrongly, and a condition that holds always.
            let told = |found: &Diagnostic| found.span() == at || found.code == Code::W0601;
            if self.diagnostics.iter().any(told) {
                continue;
            }
            self.warning(Code::W0522, at, "every episode ends in its first tick")
                .label("this holds wherever an episode starts")
                .help("let it wait for something that is yet to happen, or let episodes start otherwise");
        }
    }

    /// Warns of a learner whose own start lets an end hold in the first tick that does not hold at the start of the task.
    fn training_ends_at_start(&mut self, learn: &'a ast::Learn, changed: &Set) {
        let own = learn.entries.iter().find_map(|entry| match entry {
            LearnEntry::Start(start) => Some(start),
            _ => None,
        });
        let named = Name::word(learned_name(learn));
        let learner = self.program.learners.named(&named);
        let Some((own, learner)) = own.zip(learner) else {
            return;
        };
        let learner = &self.program.learners[learner];
        let (task, start) = (learner.task, learner.start.clone());
        let of_task = self.program.tasks[task].start.clone();
        let in_training = self.held_at_starts((task, &start), changed);
        let at_work = self.held_at_starts((task, &of_task), changed);
        let mut ends = in_training.iter().zip(&at_work);
        if ends.any(|(in_training, at_work)| *in_training && !at_work) {
            let message = "every episode of training ends in its first tick";
            self.warning(Code::W0522, own.span, message)
                .label("an end of the task holds wherever one starts");
        }
    }

    /// Warns of lines of a `start` that read a state which a later line sets: they run in their order.
    pub fn read_before_set(&mut self, items: impl Iterator<Item = &'a Item>) {
        for start in items.flat_map(starts) {
            let lines = start.lines.iter().enumerate();
            let set = lines.clone().map(|(at, line)| {
                let name = &line.target.name;
                (name.name.as_str(), (at, name))
            });
            let set: BTreeMap<&str, (usize, &Ident)> = set.collect();
            for (at, line) in lines {
                let read = self.read_by(&line.value).into_iter();
                let later = read
                    .filter_map(|name| set.get(name))
                    .filter(|(set, _)| *set > at);
                let Some((_, set)) = later.min_by_key(|(set, _)| *set) else {
                    continue;
                };
                let name = spelled(&set.name);
                let name = name.trim_matches('`');
                let message = format!("this reads `{name}` before its line sets it");
                self.warning(Code::W0309, line.value.span, message)
                    .label(format!("`{name}` is here as it is declared"))
                    .also(set.span, "set here, afterwards")
                    .help(
                        "the lines of a `start` run in their order: put this one behind the other",
                    );
            }
        }
    }

    /// Of each end of a task, whether it holds after the first tick of an episode that begins so, whatever the robot does.
    /// What holds always has been told already.
    fn held_at_starts(
        &mut self,
        (id, start): (Id<Task>, &[StartLine]),
        changed: &Set,
    ) -> Vec<bool> {
        let task = self.program.tasks[id].clone();
        let near = self.near_the_start(start);
        let holds = |checker: &Self, end: ExprId, near| {
            let view = View {
                near,
                ..View::from(&checker.program)
            };
            of_expr(view, end, false).is_never()
        };
        let always = task.end_on.iter().map(|end| holds(self, *end, None));
        let always: Vec<bool> = always.collect();
        let kept = self.starts_with(start, changed);
        let ends = task.end_on.iter().zip(always);
        let held = ends.map(|(end, always)| !always && holds(self, *end, near));
        let held = held.collect();
        for (state, stays) in kept {
            self.program.states[state].stays = stays;
        }
        held
    }

    /// Where the robot is after the first tick of an episode; `None` if it may be anywhere.
    fn near_the_start(&self, start: &[StartLine]) -> Option<[Interval; 2]> {
        let pool = &self.program.pool;
        let world = self.program.world.as_ref()?;
        let mut bounds = None;
        for line in start {
            match line {
                StartLine::Anywhere(place) => {
                    let place = place.and_then(|place| pool.constant(place));
                    let mut places = world.places.values();
                    let place = place.and_then(|number| places.nth(number as usize));
                    bounds = place.map(|place| place.shape.bounds());
                }
                StartLine::Position(x, y) => {
                    let at = pool.constant(*x).zip(pool.constant(*y));
                    bounds = at.map(|(x, y)| ([x, y], [x, y]));
                }
                _ => {}
            }
        }
        let ([left, bottom], [right, top]) = bounds?;
        let drive = &world.robot_of(World::acting()).drive;
        let step = (drive.max_speed + NOISE * drive.speed_noise) * world.tick;
        Some([
            Interval::between(left - step, right + step),
            Interval::between(bottom - step, top + step),
        ])
    }
}
