//! The search through the product automaton, shortest paths first.

use super::environment::{Environment, Outcome, Place, World, any_status, in_window};
use super::oracle::Oracle;
use super::{Explored, Side, Step, Trace, Unknown, Verdict};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Status};
use crate::policy::{Minterm, Policy};
use crate::tree::atoms::atoms;
use crate::tree::tick::{Runner, Surroundings};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;

/// Ticks after which the search gives up.
const PATIENCE: usize = 2_000_000;

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

pub(super) fn explore(
    left: Side,
    right: Side,
    environment: Environment,
) -> Result<Verdict, Unknown> {
    let mut asked = BTreeSet::new();
    for side in [left, right] {
        match side {
            Side::Tree(root) => asked.extend(atoms(root)),
            Side::Policy(policy) => asked.extend(policy.atoms.iter().copied()),
        }
    }
    let asked: Vec<Atom> = asked.into_iter().collect();
    // A table decides on its own minterms only.
    let environment = match (environment, left, right) {
        (Environment::Any(_), Side::Policy(policy), _)
        | (Environment::Any(_), _, Side::Policy(policy)) => Environment::Observed(policy),
        (environment, ..) => environment,
    };
    let world = World::new(environment, &asked);
    let mut sides = [
        Player::new(left, &world, &asked)?,
        Player::new(right, &world, &asked)?,
    ];
    let [left, right] = &mut sides;
    Ok(Search::new(&world).run(left, right))
}

/// A side that can be ticked.
enum Player<'a> {
    Tree(Runner),
    Policy(&'a Policy),
}

impl<'a> Player<'a> {
    fn new(side: Side<'a>, world: &World, asked: &[Atom]) -> Result<Self, Unknown> {
        match side {
            Side::Policy(policy) => Ok(Player::Policy(policy)),
            Side::Tree(root) => {
                // What the window does not remember never holds: its bit stands behind those of the minterm.
                let mut known = world.atoms.clone();
                for atom in asked {
                    let history = !matches!(atom, Atom::Predicate(_));
                    if history && !world.remembers(*atom) && !known.contains(atom) {
                        known.push(*atom);
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
    minterms: BTreeSet<usize>,
    transitions: BTreeSet<usize>,
    open: BTreeSet<(Option<usize>, Option<Id<Behavior>>)>,
    explored: Explored,
}

impl<'a> Search<'a> {
    fn new(world: &'a World<'a>) -> Self {
        Self {
            world,
            reached: Vec::new(),
            known: FxHashSet::default(),
            minterms: BTreeSet::new(),
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
        let mut next = 0;
        while let Some(state) = self.reached.get(next).map(|reached| reached.state.clone()) {
            let mut oracle = Oracle::default();
            loop {
                if let Some(trace) = self.tick(next, &state, left, right, &mut oracle) {
                    return Verdict::Differ(trace);
                }
                self.explored.ticks += 1;
                if self.explored.ticks > PATIENCE {
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
            minterms: self.minterms.len(),
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
        let known = minterm.and_then(|i| self.world.minterms.get(i));
        self.minterms.extend(minterm);
        let mut scene = Scene {
            world: self.world,
            known,
            place: &place,
            asked: Vec::new(),
            oracle,
            first: None,
            outcome: None,
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
            atoms: self.world.atoms.clone(),
            steps,
            valuation,
            left,
            right,
        }
    }
}

/// One tick: both sides see the same values and the same status of the behaviour that they select.
struct Scene<'a> {
    world: &'a World<'a>,
    /// The minterm; `None` where every predicate that is asked may have either value.
    known: Option<&'a Minterm>,
    place: &'a Place,
    /// The values of the atoms that were asked: word, mask, value.
    asked: Vec<(u64, u64)>,
    oracle: &'a mut Oracle,
    /// What the side that is being ticked has selected.
    first: Option<Id<Behavior>>,
    /// What happens in this tick, with the behaviour that it happens to.
    outcome: Option<(Option<Id<Behavior>>, Outcome)>,
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
            Player::Policy(policy) => {
                let choice = self.known.and_then(|minterm| policy.choice(minterm));
                choice.map(Some)
            }
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
        match self.known {
            Some(minterm) => minterm.clone(),
            None => Minterm::new(self.world.atoms.iter().enumerate().map(|(i, atom)| {
                self.in_history(*atom).unwrap_or_else(|| {
                    self.asked
                        .get(i / 64)
                        .is_some_and(|(mask, value)| mask & value & 1 << (i % 64) != 0)
                })
            })),
        }
    }

    /// The value of an atom if the window tells it.
    fn in_history(&self, atom: Atom) -> Option<bool> {
        match (atom, self.place) {
            (Atom::Done(_) | Atom::Failed(_), Place::Window(window)) => {
                Some(in_window(window, atom))
            }
            (Atom::Done(_) | Atom::Failed(_), _) => Some(false),
            (Atom::Predicate(_), _) => None,
        }
    }

    /// The value of an atom that has no minterm to tell it.
    fn ask(&mut self, bit: usize) -> bool {
        if let Some(value) = self
            .world
            .atoms
            .get(bit)
            .and_then(|atom| self.in_history(*atom))
        {
            return value;
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
}

impl Surroundings for Scene<'_> {
    fn matches(&mut self, word: usize, mask: u64, value: u64) -> bool {
        match self.known {
            Some(minterm) => minterm.words().get(word).copied().unwrap_or(0) & mask == value,
            None => (0..64)
                .filter(|bit| mask >> bit & 1 == 1)
                .all(|bit| self.ask(word * 64 + bit) == (value >> bit & 1 == 1)),
        }
    }

    fn behavior(&mut self, behavior: Id<Behavior>) -> Status {
        if self.first.is_some() {
            self.then.push(behavior);
            // Without memory, what comes of further behaviours leaves no trace.
            return match self.remembers {
                true => any_status(self.oracle),
                false => Status::Running,
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
