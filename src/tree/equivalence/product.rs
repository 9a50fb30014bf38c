//! The search through the product automaton of both memories and a table, shortest paths first.

use super::choices::Choices;
use super::environment::{Care, Follow, Outcome, Place, World, any_status, in_window};
use super::oracle::Oracle;
use super::{Explored, Side, Step, Trace, Unknown, Verdict};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Status};
use crate::logic::Bits;
use crate::policy::{Minterm, Policy};
use crate::tree::atoms::atoms;
use crate::tree::tick::{Runner, Surroundings};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;

/// Ticks after which the search gives up, besides some for each row of the table.
const PATIENCE: usize = 2_000_000;

/// Ticks that each row of the table adds to that.
const PATIENCE_PER_ROW: usize = 200;

/// Both memories and the environment.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct State {
    left: Box<[u64]>,
    right: Box<[u64]>,
    place: Place,
}

/// A state with the tick that led to it.
struct Reached {
    state: State,
    from: Option<(usize, Step)>,
}

/// Compares two sides along what a table records, or wherever the history window lets it go.
pub(super) fn explore(
    left: Side,
    right: Side,
    table: &Policy,
    follow: Follow,
) -> Result<Verdict, Unknown> {
    let world = World::new(table, follow);
    let mut sides = [Player::new(left, &world)?, Player::new(right, &world)?];
    let [left, right] = &mut sides;
    Ok(Search::new(&world).run(left, right))
}

/// A side that can be ticked.
enum Player {
    Tree(Runner),
    /// What it decides in each minterm of the world.
    Policy(Vec<Option<Id<Behavior>>>),
}

impl Player {
    fn new(side: Side, world: &World) -> Result<Self, Unknown> {
        match side {
            Side::Policy(policy) => {
                let choices = Choices::new(policy);
                let minterms = world.minterms.iter();
                let choices = minterms.map(|care| choices.choice(care));
                Ok(Player::Policy(choices.collect()))
            }
            Side::Tree(root) => {
                // What the window does not remember never holds: its bit stands behind those of the minterm.
                let mut known = world.atoms.to_vec();
                for atom in atoms(root) {
                    let history = !matches!(atom, Atom::Predicate(_));
                    if history && !world.remembers(atom) && !known.contains(&atom) {
                        known.push(atom);
                    }
                }
                Runner::new(root, &known).map(Player::Tree).map_err(Unknown)
            }
        }
    }

    fn memory(&self) -> Box<[u64]> {
        match self {
            Player::Tree(runner) => runner.memory().into(),
            Player::Policy(_) => Box::default(),
        }
    }
}

struct Search<'a> {
    world: &'a World<'a>,
    reached: Vec<Reached>,
    known: FxHashSet<State>,
    minterms: Bits,
    transitions: BTreeSet<usize>,
    open: BTreeSet<(usize, Option<Id<Behavior>>)>,
    explored: Explored,
}

impl<'a> Search<'a> {
    fn new(world: &'a World<'a>) -> Self {
        Self {
            world,
            reached: Vec::new(),
            known: FxHashSet::default(),
            minterms: Bits::empty(world.minterms.len()),
            transitions: BTreeSet::new(),
            open: BTreeSet::new(),
            explored: Explored::default(),
        }
    }

    fn run(mut self, left: &mut Player, right: &mut Player) -> Verdict {
        self.reach(
            State {
                left: left.memory(),
                right: right.memory(),
                place: Place::Start,
            },
            None,
        );
        let patience = PATIENCE + PATIENCE_PER_ROW * self.world.minterms.len();
        let mut next = 0;
        while let Some(state) = self.reached.get(next).map(|reached| reached.state.clone()) {
            let mut oracle = Oracle::default();
            loop {
                if let Some(trace) = self.tick(next, &state, left, right, &mut oracle) {
                    return Verdict::Differ(trace);
                }
                self.explored.ticks += 1;
                if self.explored.ticks > patience {
                    return Verdict::Undecided(self.summary());
                }
                if !oracle.advance() {
                    break;
                }
            }
            next += 1;
        }
        Verdict::Equal(self.summary())
    }

    fn summary(self) -> Explored {
        Explored {
            // The state before the first tick is none of its own.
            states: self.reached.len().saturating_sub(1),
            minterms: self.minterms.count(),
            transitions: self.transitions.len(),
            open: self.open.len(),
            ..self.explored
        }
    }

    fn reach(&mut self, state: State, from: Option<(usize, Step)>) {
        if self.known.insert(state.clone()) {
            self.reached.push(Reached { state, from });
        }
    }

    /// One tick of both sides with the answers of the oracle; a trace if they part.
    fn tick(
        &mut self,
        at: usize,
        state: &State,
        left: &mut Player,
        right: &mut Player,
        oracle: &mut Oracle,
    ) -> Option<Trace> {
        let (minterm, place) = self.world.find(&state.place, oracle)?;
        let care = self.world.minterms.get(minterm)?;
        self.minterms.insert(minterm);
        let mut scene = Scene {
            world: self.world,
            minterm,
            care,
            place: &place,
            asked: Vec::new(),
            oracle,
            first: None,
            outcome: None,
            statuses: Vec::new(),
            remembers: false,
            then: Vec::new(),
        };
        let chosen_left = scene.play(left, &state.left);
        let then = std::mem::take(&mut scene.then);
        let chosen_right = scene.play(right, &state.right);
        let valuation = scene.valuation();
        let outcome = scene.outcome(chosen_left.or(chosen_right));
        let (Some(chosen_left), Some(chosen_right)) = (chosen_left, chosen_right) else {
            // Where the table has no row, nothing is asked of the other side.
            self.open.insert((minterm, None));
            return None;
        };
        if chosen_left != chosen_right {
            return Some(self.trace(at, valuation, chosen_left, chosen_right));
        }
        if outcome.open {
            self.open.insert((minterm, chosen_left));
        }
        self.transitions.extend(outcome.transition);
        if outcome.status == Status::Failure && outcome.transition.is_some() {
            let next = self
                .explored
                .after_failure
                .entry(valuation.clone())
                .or_default();
            next.insert(then.first().copied());
        }
        if let Some(place) = outcome.next {
            let state = State {
                left: left.memory(),
                right: right.memory(),
                place,
            };
            let step = Step {
                valuation,
                behavior: chosen_left,
                status: outcome.status,
            };
            self.reach(state, Some((at, step)));
        }
        None
    }

    fn trace(
        &self,
        at: usize,
        valuation: Minterm,
        left: Option<Id<Behavior>>,
        right: Option<Id<Behavior>>,
    ) -> Trace {
        let mut steps = Vec::new();
        let mut at = at;
        while let Some((before, step)) = self.reached.get(at).and_then(|r| r.from.as_ref()) {
            steps.push(step.clone());
            at = *before;
        }
        steps.reverse();
        Trace {
            atoms: self.world.atoms.to_vec(),
            steps,
            valuation,
            left,
            right,
        }
    }
}

/// One tick: both sides see the same values, and the same status of every behaviour that they tick. Nothing has moved in
/// between, so a behaviour answers alike wherever it is ticked.
struct Scene<'a> {
    world: &'a World<'a>,
    minterm: usize,
    care: &'a Care<'a>,
    place: &'a Place,
    /// The values of the free atoms that were asked: known, value.
    asked: Vec<(u64, u64)>,
    oracle: &'a mut Oracle,
    /// What the side that is being ticked has selected.
    first: Option<Id<Behavior>>,
    /// What happens in this tick, with the behaviour that it happens to.
    outcome: Option<(Option<Id<Behavior>>, Outcome)>,
    /// What further behaviours have answered.
    statuses: Vec<(Id<Behavior>, Status)>,
    /// Whether the side that is being ticked has memory.
    remembers: bool,
    /// What it has ticked after that.
    then: Vec<Id<Behavior>>,
}

impl Scene<'_> {
    /// What a side selects; `None` if it may select anything.
    fn play(&mut self, side: &mut Player, memory: &[u64]) -> Option<Option<Id<Behavior>>> {
        self.first = None;
        self.then.clear();
        match side {
            Player::Policy(choices) => choices.get(self.minterm).copied().flatten().map(Some),
            Player::Tree(runner) => {
                runner.resume(memory);
                self.remembers = !memory.is_empty();
                runner.tick_in(self);
                Some(self.first)
            }
        }
    }

    /// The outcome of what was selected, chosen once a tick.
    fn outcome(&mut self, selected: Option<Option<Id<Behavior>>>) -> Outcome {
        match self.outcome.take() {
            Some((_, outcome)) => outcome,
            None => self
                .world
                .outcome(self.place, selected.flatten(), self.oracle),
        }
    }

    /// The values of this tick, false where nobody asked.
    fn valuation(&self) -> Minterm {
        if self.care.free.is_none() {
            return self.care.minterm.clone();
        }
        let atoms = self.world.atoms.iter().enumerate();
        Minterm::new(atoms.map(|(i, atom)| {
            let (_, value) = self.asked.get(i / 64).copied().unwrap_or_default();
            self.care.minterm.get(i) || self.in_history(*atom) || value >> (i % 64) & 1 == 1
        }))
    }

    /// Whether the window holds what an atom asks.
    fn in_history(&self, atom: Atom) -> bool {
        matches!(self.place, Place::Window(window) if in_window(window, atom))
    }

    /// The value of an atom that the row leaves free.
    fn ask(&mut self, bit: usize) -> bool {
        if let Some(atom) = self.world.atoms.get(bit)
            && self.world.remembers(*atom)
        {
            return self.in_history(*atom);
        }
        let (word, mask) = (bit / 64, 1u64 << (bit % 64));
        if self.asked.len() <= word {
            self.asked.resize(word + 1, (0, 0));
        }
        let Some((known, value)) = self.asked.get_mut(word) else {
            return false;
        };
        if *known & mask == 0 {
            *known |= mask;
            if self.oracle.choose(2) == 1 {
                *value |= mask;
            }
        }
        *value & mask != 0
    }

    /// The status of a behaviour that is ticked after the one that was selected.
    fn further(&mut self, behavior: Id<Behavior>) -> Status {
        let known = self.statuses.iter().find(|(b, _)| *b == behavior);
        if let Some((_, status)) = known {
            return *status;
        }
        let status = any_status(self.oracle);
        self.statuses.push((behavior, status));
        status
    }
}

impl Surroundings for Scene<'_> {
    fn matches(&mut self, word: usize, mask: u64, value: u64) -> bool {
        let of = |minterm: &Minterm| minterm.words().get(word).copied().unwrap_or(0);
        let free = self.care.free.map_or(0, of) & mask;
        of(self.care.minterm) & mask & !free == value & !free
            && (0..64)
                .filter(|bit| free >> bit & 1 == 1)
                .all(|bit| self.ask(word * 64 + bit) == (value >> bit & 1 == 1))
    }

    fn behavior(&mut self, behavior: Id<Behavior>) -> Status {
        if let Some(first) = self.first {
            self.then.push(behavior);
            // Without memory, what comes of further behaviours leaves no trace.
            return match &self.outcome {
                _ if !self.remembers => Status::Running,
                Some((_, outcome)) if behavior == first => outcome.status,
                _ => self.further(behavior),
            };
        }
        self.first = Some(behavior);
        if let Some((selected, outcome)) = &self.outcome
            && *selected == Some(behavior)
        {
            return outcome.status;
        }
        // The first side decides what happens; another choice of the second parts them, whatever it comes to.
        let outcome = self.world.outcome(self.place, Some(behavior), self.oracle);
        let status = outcome.status;
        self.outcome.get_or_insert((Some(behavior), outcome));
        status
    }
}
