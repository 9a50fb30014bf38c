//! Episodes that end as they start.

use super::cases::of_expr;
use super::interval::Interval;
use super::stays::{Set, set_in_ticks};
use super::view::View;
use crate::check::Checker;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::ExprId;
use crate::ir::task::{StartLine, Task};
use crate::ir::world::World;
use crate::ir::{Id, Name};
use crate::syntax::ast::{AspectKind, Item, ItemKind};

/// The most starts of states that are looked at.
const MOST: usize = 20_000;

/// How many standard deviations of noise the speed of a robot is off, at most.
const NOISE: f64 = 6.0;

impl<'a> Checker<'a> {
    /// Warns of ends that hold in the first tick of every episode.
    pub fn ends_at_starts(&mut self, items: impl Iterator<Item = &'a Item>) {
        if self.program.tasks.len() * self.program.states.len() > MOST {
            return;
        }
        let changed = set_in_ticks(&self.program);
        for item in items {
            let ItemKind::Task(task) = &item.kind else {
                continue;
            };
            let Some(id) = self.program.tasks.named(&Name::word(&task.name.name)) else {
                continue;
            };
            let held = self.held_at_starts(id, &changed);
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
    }

    /// Of each end of a task, whether it holds after the first tick, whatever the robot does. What holds always has been
    /// told already.
    fn held_at_starts(&mut self, id: Id<Task>, changed: &Set) -> Vec<bool> {
        let task = self.program.tasks[id].clone();
        let near = self.near_the_start(&task.start);
        let holds = |checker: &Self, end: ExprId, near| {
            let view = View {
                near,
                ..View::from(&checker.program)
            };
            of_expr(view, end, false).is_never()
        };
        let always = task.end_on.iter().map(|end| holds(self, *end, None));
        let always: Vec<bool> = always.collect();
        let kept = self.starts_with(&task.start, changed);
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
