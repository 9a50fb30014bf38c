//! What states come to while an episode lasts: one that changes by so much in each tick is bounded by the ticks there are.
//!
//! That holds of episodes alone, so the warnings know it, and no proof does: a robot may run for longer.

use super::ranges::range;
use super::stays::{Set, all_settings};
use super::view::View;
use crate::check::Checker;
use crate::ir::Id;
use crate::ir::expr::{Binary, Expr, ExprId};
use crate::ir::program::{State, Stays, ValueKind};

/// How many values a setting may choose among.
const MOST: usize = 32;

/// An end that would come in an episode so many times as long is a precaution.
const TIMES: f64 = 5.0;

/// From where to where something may go.
#[derive(Clone, Copy)]
struct Reach {
    low: f64,
    high: f64,
}

impl Reach {
    const NONE: Self = Self {
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
    };

    const NOTHING: Self = Self {
        low: 0.0,
        high: 0.0,
    };

    fn or(self, other: Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
        }
    }
}

/// What settings make of a state: the values that they give it, and by how much they change it.
struct Settings {
    values: Reach,
    change: Reach,
}

impl Checker<'_> {
    /// The ticks of the longest episode, if there is any task.
    pub(super) fn longest_episode(&self) -> Option<u64> {
        let tasks = self.program.tasks.values().map(|task| task.end_after);
        let learners = self.program.learners.values();
        let learners = learners.map(|learner| learner.episode_ticks);
        tasks.chain(learners).max()
    }

    /// Bounds the states that change by amounts by what an episode leaves time for, but for those of which it is told that they
    /// `stay` as they are; gives what was known of them before.
    pub fn bound_by_episodes(&mut self, stay: &[Id<State>]) -> Vec<(Id<State>, Stays)> {
        let (Some(ticks), false) = (self.longest_episode(), self.values_are_unsure()) else {
            return Vec::new();
        };
        let settings: Set = all_settings(&self.program);
        let mut bounded = Vec::new();
        for (id, state) in self.program.states.iter() {
            let (ValueKind::Quantity, Stays::Within(ends)) = (&state.kind, &state.stays) else {
                continue;
            };
            if stay.contains(&id) {
                continue;
            }
            let initial = range(View::from(&self.program), state.initial).ends();
            let mut all = Settings {
                values: Reach {
                    low: initial.0,
                    high: initial.1,
                },
                change: Reach::NOTHING,
            };
            let known = settings
                .get(&id)
                .into_iter()
                .flatten()
                .all(|(robot, value)| {
                    let view = View {
                        robot: *robot,
                        ..View::from(&self.program)
                    };
                    let Some(own) = setting(view, id, *value) else {
                        return false;
                    };
                    all.values = all.values.or(own.values);
                    // Each may happen once in a tick.
                    all.change.low += own.change.low.min(0.0);
                    all.change.high += own.change.high.max(0.0);
                    true
                });
            let counts = all.change.low < 0.0 || all.change.high > 0.0;
            if !known || !counts {
                continue;
            }
            let ticks = TIMES * (ticks + 1) as f64;
            let low = (all.values.low + ticks * all.change.low).max(*ends.start());
            let high = (all.values.high + ticks * all.change.high).min(*ends.end());
            if low > *ends.start() || high < *ends.end() {
                bounded.push((id, Stays::Within(low..=high)));
            }
        }
        let kept = bounded.into_iter().map(|(id, stays)| {
            let before = std::mem::replace(&mut self.program.states[id].stays, stays);
            (id, before)
        });
        kept.collect()
    }
}

/// What a setting makes of a state; `None` where that is not known.
fn setting(view: View, state: Id<State>, value: ExprId) -> Option<Settings> {
    let pool = &view.program.pool;
    let mut found = Settings {
        values: Reach::NONE,
        change: Reach::NONE,
    };
    let mut open = vec![value];
    let mut looked = 0;
    while let Some(id) = open.pop() {
        looked += 1;
        if looked > MOST {
            return None;
        }
        let reads = |id: ExprId| pool.any(id, &mut |part| part == Expr::State(state));
        let is_state = |id: ExprId| pool.get(id) == Expr::State(state);
        if !reads(id) {
            let (low, high) = range(view, id).ends();
            found.values = found.values.or(Reach { low, high });
            continue;
        }
        match pool.get(id) {
            Expr::State(_) => {}
            Expr::Select(_, a, b) => open.extend([a, b]),
            Expr::Binary(op @ (Binary::Min | Binary::Max), a, b) => {
                for part in [a, b] {
                    match reads(part) {
                        true => open.push(part),
                        false => {
                            let bound = bound(op, range(view, part).ends());
                            found.values = found.values.or(bound);
                        }
                    }
                }
            }
            Expr::Binary(Binary::Add, a, b) if is_state(a) && !reads(b) => {
                let (low, high) = range(view, b).ends();
                found.change = found.change.or(Reach { low, high });
            }
            Expr::Binary(Binary::Add, a, b) if is_state(b) && !reads(a) => {
                let (low, high) = range(view, a).ends();
                found.change = found.change.or(Reach { low, high });
            }
            Expr::Binary(Binary::Sub, a, b) if is_state(a) && !reads(b) => {
                let (low, high) = range(view, b).ends();
                found.change = found.change.or(Reach {
                    low: -high,
                    high: -low,
                });
            }
            // A part of what it is lies between that and nothing.
            Expr::Binary(Binary::Mul, a, b) if is_state(a) && is_part(view, b) => {
                found.values = found.values.or(Reach::NOTHING);
            }
            Expr::Binary(Binary::Mul, a, b) if is_state(b) && is_part(view, a) => {
                found.values = found.values.or(Reach::NOTHING);
            }
            _ => return None,
        }
    }
    Some(found)
}

/// Whether this is from 0 to 1, whatever happens.
fn is_part(view: View, id: ExprId) -> bool {
    let (low, high) = range(view, id).ends();
    0.0 <= low && high <= 1.0
}

/// What `min` or `max` may make of a state that it bounds by these values: it holds the state back on one side, and only a state that
/// is beyond them comes to them.
fn bound(op: Binary, (low, high): (f64, f64)) -> Reach {
    match op {
        Binary::Min => Reach { low, ..Reach::NONE },
        _ => Reach {
            high,
            ..Reach::NONE
        },
    }
}
