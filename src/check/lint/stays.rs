//! Which values states may have: what they start with, and what anything sets them to.

use super::cases::of_expr;
use super::view::View;
use super::widening::{one_of_these, settle};
use crate::check::Checker;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Expr, ExprId};
use crate::ir::law::{Block, Stmt};
use crate::ir::program::{State, Stays, ValueKind};
use crate::ir::task::StartLine;
use crate::ir::world::{Robot, World};
use crate::ir::{Id, Program};
use crate::syntax::ast::{Ident, Item, ItemKind};
use std::collections::{BTreeMap, BTreeSet};

/// What sets a state: the robot that reads it, and the value.
type Setting = (Id<Robot>, ExprId);

/// What sets each state.
pub type Set = BTreeMap<Id<State>, Vec<Setting>>;

/// What is told of a state that has one value for good.
pub(super) fn unchanging(name: &str) -> String {
    format!("the state `{name}` never changes")
}

impl<'a> Checker<'a> {
    /// Finds out which values the states of the program may have.
    ///
    /// Of a state that nothing sets, or that is set to itself, nothing is found out: that is told where it stands. Nor is
    /// anything where a value may be another one than it says.
    ///
    /// An effect counts where what it waits for can happen, by the values that are found; and where it cannot whatever the
    /// values are: that is told of what it waits for, and nothing else is to follow from it.
    ///
    /// Gives the states that never change, as is told of them.
    pub fn values_of_states(&mut self, items: impl Iterator<Item = &'a Item>) -> Vec<Id<State>> {
        if self.values_are_unsure() {
            return Vec::new();
        }
        let begins = begins(&self.program);
        let mut always = set_in_ticks(&self.program);
        set_at_starts(&self.program, &mut always);
        let mut all = always.clone();
        let effects = self.program.effects.iter().map(|effect| {
            let mut set = Set::new();
            of_block(&effect.block, World::acting(), &mut set);
            add(&mut all, &set);
            (effect.on, set)
        });
        let waiting: Vec<(ExprId, Set)> = effects.collect();
        let to_itself =
            |state, (_, value): &Setting| self.program.pool.get(*value) == Expr::State(state);
        all.retain(|state, settings| !settings.iter().any(|it| to_itself(*state, it)));
        let mut set = always;
        let (never, may) = waiting
            .into_iter()
            .partition(|(on, _)| of_expr(&self.program, *on, true).is_never());
        let (never, mut waiting): (Vec<(ExprId, Set)>, Vec<_>) = (never, may);
        never.iter().for_each(|(_, more)| add(&mut set, more));
        for round in 0.. {
            self.stay_by(&begins, &all, &set);
            let (happen, wait) = waiting.into_iter().partition(|(on, _)| {
                round >= ROUNDS || !of_expr(&self.program, *on, true).is_never()
            });
            waiting = wait;
            let happen: Vec<(ExprId, Set)> = happen;
            if happen.is_empty() {
                break;
            }
            happen.iter().for_each(|(_, more)| add(&mut set, more));
        }
        let stay = self.states_that_stay(items, &all, &waiting);
        if !waiting.is_empty() {
            // From what never happens nothing else is to follow.
            self.stay_by(&begins, &all, &all);
            for state in &stay {
                self.program.states[*state].stays = Stays::ANY;
            }
        }
        stay
    }

    /// Whether a value may be another one than it says.
    pub fn values_are_unsure(&self) -> bool {
        let unsure = |found: &Diagnostic| matches!(found.code, Code::W0204 | Code::W0301);
        self.diagnostics.iter().any(unsure)
    }

    /// Finds out which values the states that `all` sets may have, where only `set` does, and `begins` is what they begin with.
    fn stay_by(&mut self, begins: &Set, all: &Set, set: &Set) {
        for state in all.keys() {
            self.program.states[*state].stays = Stays::ANY;
        }
        // What a state is set to may read one that comes after it.
        for _ in 0..PASSES {
            let mut changed = false;
            for state in all.keys() {
                let settings = set.get(state).map_or(&[][..], Vec::as_slice);
                let before = self.program.states[*state].stays.clone();
                let first = begins.get(state).map_or(&[][..], Vec::as_slice);
                let stays = self.stays_of(*state, first, settings);
                changed |= stays != before;
                self.program.states[*state].stays = stays;
            }
            if !changed {
                break;
            }
        }
    }

    /// The values that these settings give a state, and what it begins with, `first`.
    fn stays_of(&mut self, state: Id<State>, first: &[Setting], settings: &[Setting]) -> Stays {
        match self.program.states[state].kind {
            ValueKind::Quantity => self.numbers_of(state, first, settings),
            ValueKind::Bool | ValueKind::Enum(_) => {
                self.one_of_these(state, &[settings, first].concat())
            }
        }
    }

    /// Warns of states that keep the value of their declaration, though there are effects that set them; those that are
    /// `waiting` never happen. Of what follows from that, nothing is said. Gives the states.
    fn states_that_stay(
        &mut self,
        items: impl Iterator<Item = &'a Item>,
        all: &Set,
        waiting: &[(ExprId, Set)],
    ) -> Vec<Id<State>> {
        let mut found: Vec<Staying> = Vec::new();
        let mut families: BTreeMap<String, Vec<Id<State>>> = BTreeMap::new();
        for (id, state) in self.program.states.iter() {
            families
                .entry(state.name.family.clone())
                .or_default()
                .push(id);
        }
        for item in items {
            let ItemKind::State(declared) = &item.kind else {
                continue;
            };
            let own = families.remove(&declared.name.name).unwrap_or_default();
            let stays = |id: &Id<State>| {
                let is_set = all.get(id).is_some_and(|settings| !settings.is_empty());
                is_set && self.program.states[*id].stays.is_one()
            };
            if own.is_empty() || !own.iter().all(stays) || declared.name.name.starts_with('_') {
                continue;
            }
            let name = &declared.name;
            let same = own.iter().filter_map(|id| all.get(id)).flatten();
            let is_same = |(_, value): &Setting| {
                let pool = &self.program.pool;
                let initial = own
                    .first()
                    .map(|id| pool.get(self.program.states[*id].initial));
                Some(pool.get(*value)) == initial
            };
            found.push(Staying {
                name,
                same: same.clone().all(is_same),
                own,
            });
        }
        // The others wait for one that holds itself back.
        let holds_back = |checker: &mut Self, it: &Staying| it.same || checker.frees(it, waiting);
        let causes: Vec<bool> = found.iter().map(|it| holds_back(self, it)).collect();
        let stay: Vec<Id<State>> = found.iter().flat_map(|it| it.own.clone()).collect();
        for state in &stay {
            self.program.states[*state].stays = Stays::ANY;
        }
        let told = self.waits_in_vain(waiting);
        let any = told || causes.contains(&true);
        for (at, (it, cause)) in found.iter().zip(causes).enumerate() {
            if !cause && (any || at > 0) {
                continue;
            }
            let why = match it.same {
                true => "whatever sets it sets it to this value",
                false => "what sets it to another value never happens",
            };
            self.warning(Code::W0205, it.name.span, unchanging(&it.name.name))
                .label("it stays as it is declared here")
                .note(why);
        }
        stay
    }

    /// Tells of what effects wait for and never happens.
    fn waits_in_vain(&mut self, waiting: &[(ExprId, Set)]) -> bool {
        let never = waiting.iter().map(|(on, _)| *on);
        let never = never.filter(|on| of_expr(&self.program, *on, true).is_never());
        let mut asked: BTreeSet<ExprId> = never.collect();
        let events = asked
            .iter()
            .filter_map(|on| match self.program.pool.get(*on) {
                Expr::Event(event) => Some(self.program.events[event].when),
                _ => None,
            });
        let events: Vec<ExprId> = events.collect();
        asked.extend(events);
        self.conditions_of(&asked)
    }

    /// Whether something that sets a state could happen if the state had any value.
    fn frees(&mut self, staying: &Staying, waiting: &[(ExprId, Set)]) -> bool {
        let states = staying.own.iter();
        let kept = states.map(|id| {
            let stays = &mut self.program.states[*id].stays;
            (*id, std::mem::replace(stays, Stays::ANY))
        });
        let kept: Vec<_> = kept.collect();
        let mut effects = waiting.iter();
        let frees = effects.any(|(on, set)| {
            let sets = staying.own.iter().any(|id| set.contains_key(id));
            sets && !of_expr(&self.program, *on, true).is_never()
        });
        for (id, stays) in kept {
            self.program.states[id].stays = stays;
        }
        frees
    }

    /// Lets states have the values that they have in the first tick of an episode, and gives back those that they may have at
    /// any time.
    ///
    /// What is done where something happens is left out of account: `changed` is what sets states [in every
    /// tick](set_in_ticks).
    pub fn starts_with(&mut self, start: &[StartLine], changed: &Set) -> Vec<(Id<State>, Stays)> {
        let kept = self.program.states.iter();
        let kept: Vec<_> = kept.map(|(id, state)| (id, state.stays.clone())).collect();
        let mut given = Set::new();
        of_start(start, &mut given);
        let sure = set_by(start);
        for (id, stays) in &kept {
            let mut given = given.remove(id).unwrap_or_default();
            if !sure.contains(id) {
                given.push((World::acting(), self.program.states[*id].initial));
            }
            let first = self.one_of_these(*id, &given);
            // More than a few changes in a tick may come to anything.
            self.program.states[*id].stays = match changed.get(id).map_or(0, Vec::len) {
                0..=CHANGES => first,
                _ => stays.clone(),
            };
        }
        for _ in 0..CHANGES {
            let next = changed.iter().map(|(id, settings)| {
                let now = self.program.states[*id].stays.clone();
                (*id, now.or(&self.one_of_these(*id, settings)))
            });
            let next: Vec<_> = next.collect();
            for (id, stays) in next {
                self.program.states[id].stays = stays;
            }
        }
        kept
    }

    /// The values of these settings.
    pub fn one_of_these(&self, state: Id<State>, settings: &[Setting]) -> Stays {
        let by_bits = match self.program.states[state].kind {
            ValueKind::Quantity => false,
            ValueKind::Bool | ValueKind::Enum(_) => true,
        };
        let settings = settings.iter().map(|(robot, value)| {
            let view = View {
                robot: *robot,
                ..View::from(&self.program)
            };
            (view, *value)
        });
        one_of_these(&self.program.pool, Expr::State(state), by_bits, settings)
    }

    /// The numbers from the least to the greatest that a state comes to.
    fn numbers_of(&mut self, state: Id<State>, first: &[Setting], settings: &[Setting]) -> Stays {
        let first = self.one_of_these(state, first);
        settle(&first, settings.len(), &mut |stays, which| {
            self.program.states[state].stays = stays.clone();
            self.one_of_these(state, settings.get(which).unwrap_or_default())
        })
    }
}

/// A declared state that keeps its value.
struct Staying<'a> {
    name: &'a Ident,
    /// Whether it is only ever set to this value.
    same: bool,
    /// The state, or each of the family.
    own: Vec<Id<State>>,
}

/// Adds to what sets each state.
fn add(set: &mut Set, more: &Set) {
    for (state, settings) in more {
        set.entry(*state).or_default().extend(settings);
    }
}

/// How often what may happen is reckoned anew, before all of it is taken to happen.
const ROUNDS: usize = 8;

/// How often the states are gone through at most.
const PASSES: usize = 3;

/// The most changes of a state in a tick that are followed.
const CHANGES: usize = 4;

/// What sets each state, whenever that is.
pub fn all_settings(program: &Program) -> Set {
    let mut all = set_in_ticks(program);
    set_at_starts(program, &mut all);
    for effect in program.effects.iter() {
        of_block(&effect.block, World::acting(), &mut all);
    }
    all
}

/// What sets each state as an episode starts.
pub fn set_at_starts(program: &Program, found: &mut Set) {
    let tasks = program.tasks.values().map(|task| &task.start);
    let learners = program.learners.values().map(|learner| &learner.start);
    tasks
        .chain(learners)
        .for_each(|start| of_start(start, found));
}

/// The states that a `start` sets, whatever is drawn.
fn set_by(start: &[StartLine]) -> BTreeSet<Id<State>> {
    let states = start.iter().flat_map(|line| match line {
        StartLine::State(values) => values.as_slice(),
        _ => &[],
    });
    states.map(|(state, _)| *state).collect()
}

/// What each state begins an episode with: what `start` sets it to, and its declaration unless every task sets it.
pub fn begins(program: &Program) -> Set {
    let mut begins = Set::new();
    set_at_starts(program, &mut begins);
    let mut times: BTreeMap<Id<State>, usize> = BTreeMap::new();
    for task in program.tasks.values() {
        for state in set_by(&task.start) {
            *times.entry(state).or_default() += 1;
        }
    }
    for (id, state) in program.states.iter() {
        if program.tasks.is_empty() || times.get(&id) != Some(&program.tasks.len()) {
            let settings = begins.entry(id).or_default();
            settings.push((World::acting(), state.initial));
        }
    }
    begins
}

/// What sets each state in a tick, whether or not anything happens in it.
pub fn set_in_ticks(program: &Program) -> Set {
    let mut found = Set::new();
    of_block(&program.each_tick, World::acting(), &mut found);
    for behavior in program.behaviors.values() {
        if let Some(law) = &behavior.law {
            let robot = View::of(program, &behavior.name).robot;
            of_block(&law.control, robot, &mut found);
        }
    }
    found
}

fn of_start(start: &[StartLine], found: &mut Set) {
    for line in start {
        match line {
            StartLine::State(values) => {
                for (state, value) in values {
                    let settings = found.entry(*state).or_default();
                    settings.push((World::acting(), *value));
                }
            }
            StartLine::Member(_, block) => of_block(block, World::acting(), found),
            _ => {}
        }
    }
}

/// What sets each state in a block.
pub fn of_block(block: &Block, robot: Id<Robot>, found: &mut Set) {
    for statement in &block.0 {
        match statement {
            Stmt::SetState(state, value) => {
                found.entry(*state).or_default().push((robot, *value));
            }
            Stmt::If(_, then, otherwise) => {
                of_block(then, robot, found);
                of_block(otherwise, robot, found);
            }
            Stmt::Let(..) | Stmt::SetLocal(..) | Stmt::Drive { .. } => {}
        }
    }
}
