//! Rewards that are paid again in each tick, for a success that stands.

use super::cases::{comparison, conjuncts, of_expr};
use super::interval::Interval;
use super::ranges::range;
use super::stays::{Set, of_block, set_in_ticks, unchanging};
use super::tree::at_success;
use super::view::View;
use crate::check::Checker;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Expr, ExprId, Unary};
use crate::ir::law::Behavior;
use crate::ir::program::{State, Stays, ValueKind};
use crate::ir::task::Task;
use crate::ir::tree::Status;
use crate::ir::world::World;
use crate::ir::{Id, Program};
use crate::source::Span;
use std::collections::{BTreeMap, BTreeSet};

/// What sets each state: in every tick, and which effects do, by their places among those of the program.
pub struct Setters {
    ticks: Set,
    effects: BTreeMap<Id<State>, Vec<usize>>,
}

impl Setters {
    /// What the effects and ticks of a program set.
    pub fn of(program: &Program) -> Self {
        let mut effects: BTreeMap<Id<State>, Vec<usize>> = BTreeMap::new();
        for (at, effect) in program.effects.iter().enumerate() {
            let mut set = Set::new();
            of_block(&effect.block, World::acting(), &mut set);
            for state in set.into_keys() {
                effects.entry(state).or_default().push(at);
            }
        }
        Self {
            ticks: set_in_ticks(program),
            effects,
        }
    }
}

impl Checker<'_> {
    /// `on success(goto(job)): 1`: a robot that is there already succeeds at once, tick by tick. Told where the line of this
    /// number pays for nothing else, and pays well.
    pub fn pays_for_standing(
        &mut self,
        at: Span,
        (checked, place): (&Task, usize),
        setters: &Setters,
    ) {
        let lines = checked.written.reward.iter().zip(&checked.reward);
        let lines = lines.filter(|(of, _)| **of == place).map(|(_, line)| line);
        let (mut stands, mut kept) = (None, None);
        for line in lines {
            let pays = range(View::from(&self.program), line.value).ends().0 > 0.0;
            let happens = of_expr(&self.program, line.event, true)
                .and(&at_success(&self.program, line.event));
            if pays && !happens.is_never() {
                stands = self.standing(line.event, setters);
            }
            if let Some((_, states)) = &stands {
                kept = self.set_by(line.event, states, setters);
                break;
            }
        }
        let Some((behavior, states)) = stands else {
            return;
        };
        let asks_states = !states.is_empty();
        if self.is_told_unchanging(&states) {
            return;
        }
        // What the event is to change is set to what it is, and that is told.
        let mut told = self.diagnostics.iter();
        let is_idle = |found: &Diagnostic| matches!(found.code, Code::W0303 | Code::W0308);
        if asks_states && told.any(is_idle) {
            return;
        }
        let name = self.program.behaviors[behavior].name.bare();
        let message = "this is paid again in every tick that the robot stays".to_owned();
        self.warning(Code::W0519, at, message)
            .label(format!("where `{name}` has succeeded it succeeds again at once"))
            .help(match (asks_states, kept) {
                (false, _) => format!(
                    "pay for what changes: `success({name}) and STATE`, with a state that the event sets"
                ),
                (true, Some(state)) => format!(
                    "the event sets `{state}` to what it asks for again: let it set another value"
                ),
                (true, None) => "let the event change the state that it asks: `on EVENT { STATE = … }`"
                    .to_owned(),
            });
    }

    /// The name of one of these states that an effect of the event itself sets.
    fn set_by(
        &self,
        event: ExprId,
        states: &BTreeSet<Id<State>>,
        setters: &Setters,
    ) -> Option<String> {
        let program = &self.program;
        let of_event = |at: &usize| {
            let effect = program.effects.get(*at);
            effect.is_some_and(|effect| {
                effect.on == event || conjuncts(program, effect.on) == conjuncts(program, event)
            })
        };
        let set = |state: &&Id<State>| {
            let mut effects = setters.effects.get(*state).into_iter().flatten();
            effects.any(of_event)
        };
        let state = states.iter().find(set)?;
        Some(program.states[*state].name.to_string())
    }

    /// Whether it was told that one of these states never changes: what asks for another value never happens.
    fn is_told_unchanging(&self, states: &BTreeSet<Id<State>>) -> bool {
        let messages = states.iter().map(|state| {
            let name = &self.program.states[*state].name.family;
            unchanging(name)
        });
        let messages: BTreeSet<String> = messages.collect();
        let mut found = self.diagnostics.iter();
        found.any(|found| found.code == Code::W0205 && messages.contains(&found.message))
    }

    /// `on flat: -20`: an event that goes on to hold by itself is paid for in each tick of it.
    pub fn pays_for_lasting(
        &mut self,
        at: Span,
        (checked, place): (&Task, usize),
        setters: &Setters,
    ) {
        // Where an end never comes it is that which is missing.
        if self
            .diagnostics
            .iter()
            .any(|found| found.code == Code::W0509)
        {
            return;
        }
        let lines = checked.written.reward.iter().zip(&checked.reward);
        let lines = lines.filter(|(of, _)| **of == place).map(|(_, line)| line);
        for line in lines {
            let pays = self.program.pool.constant(line.value);
            if pays != Some(0.0) && self.goes_on(line.event, setters) {
                self.warning(Code::W0519, at, "this is paid in every tick in which it holds")
                    .label("once it holds, nothing that it brings about changes that")
                    .help("let it end the episode, `end on …`, or let it change what it asks, `on … { … }`");
                return;
            }
        }
    }

    /// The behaviour whose success is all that a condition waits for, if it stands once it has come, and whether the condition
    /// asks for states, too, which stay as they are: these.
    fn standing(
        &mut self,
        condition: ExprId,
        setters: &Setters,
    ) -> Option<(Id<Behavior>, BTreeSet<Id<State>>)> {
        let program = &self.program;
        let (mut found, mut states) = (None, Vec::new());
        for id in conjuncts(program, condition) {
            match program.pool.get(id) {
                Expr::Ended(behavior, Status::Success) if found.is_none() => {
                    // What another robot does next, its tree says.
                    if program.behaviors[behavior].name.robot().is_some() {
                        return None;
                    }
                    let law = program.behaviors[behavior].law.as_ref()?;
                    let waits = program.pool.constant(law.succeed).is_none();
                    let stays = lasts(program, law.requires) && lasts(program, law.succeed);
                    found = (waits && stays).then_some(behavior);
                    found?;
                }
                _ if lasts(program, id) => {}
                _ => states.push(id),
            }
        }
        let mut asked = BTreeSet::new();
        for id in &states {
            program.pool.any(*id, &mut |part| {
                if let Expr::State(state) = part {
                    asked.insert(state);
                }
                false
            });
        }
        let stay = states
            .into_iter()
            .all(|id| self.keeps(id, (condition, found), setters));
        found.filter(|_| stay).zip(Some(asked))
    }

    /// Whether a condition on states alone holds in the next tick wherever it holds in one, as far as no behaviour ends.
    fn goes_on(&mut self, condition: ExprId, setters: &Setters) -> bool {
        let parts = conjuncts(&self.program, condition);
        let waits = self.program.pool.constant(condition).is_none();
        let asks = parts.iter().any(|id| bound(&self.program, *id).is_some());
        let mut parts = parts.into_iter();
        waits && asks && parts.all(|id| self.keeps(id, (condition, None), setters))
    }

    /// Whether a condition on states that holds in a tick in which `event` happens still holds behind it: nothing sets what
    /// it reads, or what sets it keeps it within its bound. What a behaviour other than the one that stands brings about by its end
    /// does not count.
    fn keeps(
        &mut self,
        id: ExprId,
        (event, standing): (ExprId, Option<Id<Behavior>>),
        setters: &Setters,
    ) -> bool {
        let program = &self.program;
        let of_states = |part: &Expr| {
            matches!(
                part,
                Expr::Num(_) | Expr::Bool(_) | Expr::State(_) | Expr::Unary(..) | Expr::Binary(..)
            )
        };
        let mut read = BTreeSet::new();
        let other = program.pool.any(id, &mut |part| {
            if let Expr::State(state) = part {
                read.insert(state);
            }
            !of_states(&part)
        });
        if other {
            return false;
        }
        let happens = of_expr(program, event, true);
        let mut set = Set::new();
        for state in read {
            // Of what nothing sets at all, that is told.
            if !setters.ticks.contains_key(&state) && !setters.effects.contains_key(&state) {
                return false;
            }
            let in_ticks = setters.ticks.get(&state).into_iter().flatten();
            let mut all: Vec<_> = in_ticks.copied().collect();
            for at in setters.effects.get(&state).into_iter().flatten() {
                let Some(effect) = program.effects.get(*at) else {
                    continue;
                };
                let mut parts = conjuncts(program, effect.on).into_iter();
                let of_another = parts.any(|part| match program.pool.get(part) {
                    Expr::Ended(behavior, _) => standing != Some(behavior),
                    _ => false,
                });
                let done = of_expr(program, effect.on, true);
                // Of one that never happens, that is told.
                if done.is_never() {
                    return false;
                }
                if !of_another && !happens.and(&done).is_never() {
                    let mut own = Set::new();
                    of_block(&effect.block, World::acting(), &mut own);
                    all.extend(own.remove(&state).into_iter().flatten());
                }
            }
            if !all.is_empty() {
                set.insert(state, all);
            }
        }
        match bound(program, id) {
            _ if set.is_empty() => true,
            Some((state, Bound::Within(within))) => self.stays_within(state, within, &set),
            Some((state, Bound::Among(among))) => {
                let settings = set.get(&state).map_or(&[][..], Vec::as_slice);
                matches!(self.one_of_these(state, settings), Stays::Among(to) if to & !among == 0)
            }
            None => false,
        }
    }

    /// Whether a state that is within an interval is set to nothing that is not.
    fn stays_within(&mut self, state: Id<State>, within: Interval, set: &Set) -> bool {
        let Stays::Within(ends) = &self.program.states[state].stays else {
            return false;
        };
        let (low, high) = within.ends();
        let bounded = Stays::Within(low.max(*ends.start())..=high.min(*ends.end()));
        let before = std::mem::replace(&mut self.program.states[state].stays, bounded);
        let mut settings = set.get(&state).into_iter().flatten();
        let stays = settings.all(|(robot, value)| {
            let view = View {
                robot: *robot,
                ..View::from(&self.program)
            };
            within.covers(range(view, *value))
        });
        self.program.states[state].stays = before;
        stays
    }
}

/// What a condition asks a state to be.
enum Bound {
    /// A number within an interval.
    Within(Interval),
    /// One of the values with these bits.
    Among(u64),
}

/// A state that is asked by itself, or compared with a constant, and what it has to be.
fn bound(program: &Program, id: ExprId) -> Option<(Id<State>, Bound)> {
    let pool = &program.pool;
    match pool.get(id) {
        Expr::State(state) => Some((state, Bound::Among(0b10))),
        Expr::Unary(Unary::Not, of) => match bound(program, of)? {
            (state, Bound::Among(among)) => Some((state, Bound::Among(!among))),
            (_, Bound::Within(_)) => None,
        },
        Expr::Binary(op, a, b) => {
            let (of, within) = comparison(pool, op, a, b, true)?;
            let Expr::State(state) = pool.get(of) else {
                return None;
            };
            let holds = |value: f64| within.iter().flatten().any(|part| part.contains(value));
            match (&program.states[state].kind, within) {
                (ValueKind::Quantity, [Some(within), None]) => Some((state, Bound::Within(within))),
                (ValueKind::Enum(variants), _) if variants.len() <= u64::BITS as usize => {
                    let values = (0..variants.len()).filter(|index| holds(*index as f64));
                    let among = values.fold(0, |bits, index| bits | 1 << index);
                    Some((state, Bound::Among(among)))
                }
                _ => None,
            }
        }
        _ => None,
    }
}

/// Whether an expression keeps its value as long as the robot stands: it reads nothing but where that is.
pub(super) fn lasts(program: &Program, id: ExprId) -> bool {
    let mut changes = |part| {
        !matches!(
            part,
            Expr::Num(_)
                | Expr::Bool(_)
                | Expr::Pose(_)
                | Expr::Inside(_)
                | Expr::Visible(..)
                | Expr::Unary(..)
                | Expr::Binary(..)
                | Expr::Select(..)
        )
    };
    !program.pool.any(id, &mut changes)
}
