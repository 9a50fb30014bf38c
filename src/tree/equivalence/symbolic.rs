//! Two trees where anything may happen that is consistent with the history window.
//!
//! What both trees select is a circuit over the atoms. Without memory one question settles it: is there a valuation in
//! which the selections differ? With memory the same question is asked in every pair of memories and every window that
//! can be reached, shortest paths first; valuations and statuses are never enumerated, only the states that they lead to.

use super::environment::{Termination, Window, in_window, remembers, termination};
use super::unfold::{Inputs, Unfolded, unfold};
use super::{Explored, Means, Step, Trace, Unknown, Verdict};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Node, Status};
use crate::policy::Minterm;
use crate::tree::atoms::atoms;
use crate::tree::circuit::sat::{Exhausted, Solver};
use crate::tree::circuit::{Circuit, Signal, truth};
use crate::tree::program::Program;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Up to so many atoms a truth table is quicker than a solver.
const TABLE: usize = 20;

/// Decisions after which the solver gives up.
const DECISIONS: u64 = 20_000_000;

/// States after which the search gives up.
const STATES: usize = 100_000;

pub(super) fn explore(left: &Node, right: &Node, history: History) -> Result<Verdict, Unknown> {
    let mut asked = atoms(left);
    asked.extend(atoms(right));
    let asked: Vec<Atom> = asked.into_iter().collect();
    let program = |root| Program::new(root, &asked).map_err(Unknown);
    let programs = [program(left)?, program(right)?];
    let mut search = Search::new(asked, programs, history);
    Ok(match search.run() {
        Ok(Some(trace)) => Verdict::Differ(trace),
        Ok(None) => Verdict::Equal(search.explored),
        Err(Exhausted) => Verdict::Undecided(search.explored),
    })
}

/// Both memories and the window, which is full: what no atom asks of fills it up.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct State {
    memories: [Box<[u64]>; 2],
    window: Window,
}

/// A state with the one that led to it, and with what had to hold there.
struct Reached {
    state: State,
    from: Option<(usize, Signal)>,
}

/// A tick of both trees from a pair of memories.
struct Pair {
    sides: [Rc<Unfolded>; 2],
    /// When they select differently.
    differ: Signal,
    /// When which termination enters the window.
    enters: Vec<(Option<Termination>, Signal)>,
}

struct Search {
    atoms: Vec<Atom>,
    programs: [Program; 2],
    history: History,
    /// The terminations that the window remembers, and the signals of the atoms that ask for them.
    remembered: Vec<((Id<Behavior>, Status), Signal)>,
    inputs: Inputs,
    solver: Solver,
    unfolded: [FxHashMap<Box<[u64]>, Rc<Unfolded>>; 2],
    pairs: FxHashMap<[Box<[u64]>; 2], Rc<Pair>>,
    reached: Vec<Reached>,
    known: FxHashSet<State>,
    explored: Explored,
}

impl Search {
    fn new(atoms: Vec<Atom>, programs: [Program; 2], history: History) -> Self {
        let mut circuit = Circuit::new();
        let mut remembered = Vec::new();
        let mut signals = Vec::new();
        for atom in &atoms {
            let termination = termination(*atom).filter(|_| remembers(history, *atom));
            // What the window does not remember never holds.
            let signal = match (atom, termination) {
                (Atom::Done(_) | Atom::Failed(_), None) => Signal::FALSE,
                _ => circuit.input(),
            };
            remembered.extend(termination.map(|termination| (termination, signal)));
            signals.push(signal);
        }
        Self {
            atoms,
            programs,
            history,
            remembered,
            inputs: Inputs {
                circuit,
                atoms: signals,
                behaviors: BTreeMap::new(),
            },
            solver: Solver::new(DECISIONS),
            unfolded: Default::default(),
            pairs: FxHashMap::default(),
            reached: Vec::new(),
            known: FxHashSet::default(),
            explored: Explored::default(),
        }
    }

    /// The shortest trace on which the trees part.
    fn run(&mut self) -> Result<Option<Trace>, Exhausted> {
        let fresh = [0, 1].map(|side| self.fresh(side));
        let first = self.pair(&fresh);
        if let Some(valuation) = self.parts_at_once(first.differ)? {
            return Ok(Some(self.parted(Vec::new(), &first, valuation)));
        }
        if fresh.iter().all(|memory| memory.is_empty()) {
            return Ok(None);
        }
        self.explored.means = Means::Paths;
        for window in self.windows()? {
            let memories = fresh.clone();
            self.reach(State { memories, window }, None)?;
        }
        let mut next = 0;
        while let Some(state) = self.reached.get(next).map(|reached| reached.state.clone()) {
            if let Some(trace) = self.leave(next, &state)? {
                return Ok(Some(trace));
            }
            next += 1;
        }
        Ok(None)
    }

    fn fresh(&self, side: usize) -> Box<[u64]> {
        let slots = self.programs.get(side).map_or(0, |program| program.slots);
        vec![0; slots].into()
    }

    /// The least valuation in which the trees part before anything has happened, whatever the window holds.
    fn parts_at_once(&mut self, differ: Signal) -> Result<Option<Vec<bool>>, Exhausted> {
        let held: Vec<Signal> = self.remembered.iter().map(|(_, signal)| *signal).collect();
        let circuit = &mut self.inputs.circuit;
        let too_many = circuit.at_least(self.history.window + 1, &held);
        let goal = circuit.and(differ, !too_many);
        let asked = circuit.support(goal, &self.inputs.atoms);
        if asked <= TABLE {
            self.explored.means = Means::Table { atoms: asked };
            return Ok(truth::least(circuit, goal, &self.inputs.atoms));
        }
        self.explored.means = Means::Solver { atoms: asked };
        self.solver.least(circuit, &[goal], &self.inputs.atoms)
    }

    /// Every window that may be there before the first tick, the emptiest first.
    fn windows(&self) -> Result<Vec<Window>, Exhausted> {
        let mut windows = vec![Window::new()];
        for _ in 0..self.length() {
            let kinds = || {
                let kinds = self.remembered.iter().map(|(kind, _)| Some(*kind));
                std::iter::once(None).chain(kinds)
            };
            if windows.len() * (self.remembered.len() + 1) > STATES {
                return Err(Exhausted);
            }
            let longer = windows.iter().flat_map(|window| {
                kinds().map(|kind| window.iter().copied().chain([kind]).collect())
            });
            windows = longer.collect();
        }
        Ok(windows)
    }

    /// The length of a window; without anything to remember it stays empty.
    fn length(&self) -> usize {
        match self.remembered.is_empty() {
            true => 0,
            false => self.history.window,
        }
    }

    fn reach(&mut self, state: State, from: Option<(usize, Signal)>) -> Result<(), Exhausted> {
        if self.known.insert(state.clone()) {
            self.reached.push(Reached { state, from });
            self.explored.states += 1;
        }
        match self.reached.len() > STATES {
            true => Err(Exhausted),
            false => Ok(()),
        }
    }

    /// Finds where a state leads; a trace if the trees part in it.
    fn leave(&mut self, at: usize, state: &State) -> Result<Option<Trace>, Exhausted> {
        let pair = self.pair(&state.memories);
        let window = self.shows(&state.window);
        let question: Vec<Signal> = window.iter().copied().chain([pair.differ]).collect();
        if self.solver.can_hold(&self.inputs.circuit, &question)? {
            return self.trace(at).map(Some);
        }
        let [left, right] = &pair.sides;
        let mut open = window;
        loop {
            let sides = left.leaves.iter().chain(&right.leaves);
            let entering = pair.enters.iter().map(|(_, when)| *when);
            let outcome: Vec<Signal> = sides.map(|(_, when)| *when).chain(entering).collect();
            self.solver.learn(&self.inputs.circuit, &outcome)?;
            if !self.solver.can_hold(&self.inputs.circuit, &open)? {
                return Ok(None);
            }
            self.explored.ticks += 1;
            let (Some(a), Some(b), Some((entry, when))) = (
                holding(&self.solver, &left.leaves),
                holding(&self.solver, &right.leaves),
                pair.enters
                    .iter()
                    .find(|(_, when)| self.solver.value(*when)),
            ) else {
                return Err(Exhausted);
            };
            let mut window = state.window.clone();
            if let Some(termination) = entry {
                window.push(*termination);
                window.drain(..window.len().saturating_sub(self.length()));
            }
            let moves = self.inputs.circuit.all([a.1, b.1, *when]);
            let memories = [a.0.clone(), b.0.clone()];
            self.reach(State { memories, window }, Some((at, moves)))?;
            open.push(!moves);
        }
    }

    /// What the atoms are where the window holds this.
    fn shows(&self, window: &[Termination]) -> Vec<Signal> {
        let shown = self.remembered.iter().map(|((behavior, status), signal)| {
            let atom = match status {
                Status::Failure => Atom::Failed(*behavior),
                _ => Atom::Done(*behavior),
            };
            signal.negated_if(!in_window(window, atom))
        });
        shown.collect()
    }

    fn pair(&mut self, memories: &[Box<[u64]>; 2]) -> Rc<Pair> {
        if let Some(pair) = self.pairs.get(memories) {
            return Rc::clone(pair);
        }
        let [left, right] = memories;
        let sides = [self.unfold(0, left), self.unfold(1, right)];
        let [left, right] = &sides;
        let circuit = &mut self.inputs.circuit;
        let behaviors: BTreeSet<_> = left.selects.keys().chain(right.selects.keys()).collect();
        let selects = |side: &Unfolded, behavior| {
            let when = side.selects.get(behavior).copied();
            when.unwrap_or(Signal::FALSE)
        };
        let mut differ = Signal::FALSE;
        for behavior in behaviors {
            let parts = circuit.xor(selects(left, behavior), selects(right, behavior));
            differ = circuit.or(differ, parts);
        }
        let enters = self.enters(&left.selects);
        let pair = Rc::new(Pair {
            differ,
            enters,
            sides,
        });
        self.pairs.insert(memories.clone(), Rc::clone(&pair));
        pair
    }

    fn unfold(&mut self, side: usize, memory: &[u64]) -> Rc<Unfolded> {
        let (Some(program), Some(known)) = (self.programs.get(side), self.unfolded.get_mut(side))
        else {
            return Rc::default();
        };
        let entry = known.entry(memory.into());
        Rc::clone(entry.or_insert_with(|| Rc::new(unfold(program, memory, &mut self.inputs))))
    }

    /// What enters the window when these behaviours are selected.
    fn enters(
        &mut self,
        selects: &BTreeMap<Id<Behavior>, Signal>,
    ) -> Vec<(Option<Termination>, Signal)> {
        let mut entries: BTreeMap<Termination, Signal> = BTreeMap::new();
        let remembers = self.length() > 0;
        let kept: Vec<Status> = [
            (Status::Success, self.history.success),
            (Status::Failure, self.history.failure),
        ]
        .into_iter()
        .filter(|(_, kept)| *kept && remembers)
        .map(|(status, _)| status)
        .collect();
        let mut some = Signal::FALSE;
        for (behavior, selected) in selects {
            for status in &kept {
                let termination = Some((*behavior, *status));
                let asked = self
                    .remembered
                    .iter()
                    .any(|(kind, _)| Some(*kind) == termination);
                let ends = self.inputs.status(*behavior, *status);
                let circuit = &mut self.inputs.circuit;
                let when = circuit.and(*selected, ends);
                let entry = entries.entry(termination.filter(|_| asked));
                let before = entry.or_insert(Signal::FALSE);
                *before = circuit.or(*before, when);
                some = circuit.or(some, when);
            }
        }
        let entries = entries.into_iter().map(|(kind, when)| (Some(kind), when));
        std::iter::once((None, !some)).chain(entries).collect()
    }

    /// The way to a state in which the trees part, its valuations as small as they can be.
    fn trace(&mut self, at: usize) -> Result<Trace, Exhausted> {
        let mut path = Vec::new();
        let mut next = Some((at, None));
        while let Some((at, moves)) = next {
            let Some(reached) = self.reached.get(at) else {
                break;
            };
            path.push((reached.state.clone(), moves));
            next = reached.from.map(|(before, moves)| (before, Some(moves)));
        }
        let mut steps = Vec::new();
        let mut statuses = Vec::new();
        for both in self.inputs.behaviors.values() {
            statuses.extend(both);
        }
        let inputs: Vec<Signal> = self.inputs.atoms.iter().copied().chain(statuses).collect();
        for (state, moves) in path.into_iter().rev() {
            let pair = self.pair(&state.memories);
            let mut question = self.shows(&state.window);
            question.push(moves.unwrap_or(pair.differ));
            let circuit = &self.inputs.circuit;
            let least = self.solver.least(circuit, &question, &inputs)?;
            let values = least.ok_or(Exhausted)?;
            if moves.is_none() {
                return Ok(self.parted(steps, &pair, values));
            }
            let [left, _] = &pair.sides;
            let behavior = self.selected(left, &inputs, &values);
            let status = behavior.map_or(Status::Running, |behavior| {
                let has = |status: &Status| {
                    let when = self.inputs.status(behavior, *status);
                    self.inputs.circuit.holds(when, &inputs, &values)
                };
                let ended = [Status::Success, Status::Failure].into_iter().find(has);
                ended.unwrap_or(Status::Running)
            });
            steps.push(Step {
                valuation: self.minterm(&values),
                behavior,
                status,
            });
        }
        Err(Exhausted)
    }

    /// The trace whose last tick has these values of the atoms.
    fn parted(&self, steps: Vec<Step>, pair: &Pair, values: Vec<bool>) -> Trace {
        let [left, right] = &pair.sides;
        let atoms = &self.inputs.atoms;
        Trace {
            atoms: self.atoms.clone(),
            steps,
            left: self.selected(left, atoms, &values),
            right: self.selected(right, atoms, &values),
            valuation: self.minterm(&values),
        }
    }

    fn minterm(&self, values: &[bool]) -> Minterm {
        Minterm::new(values.iter().copied().take(self.atoms.len()))
    }

    fn selected(
        &self,
        side: &Unfolded,
        inputs: &[Signal],
        values: &[bool],
    ) -> Option<Id<Behavior>> {
        let circuit = &self.inputs.circuit;
        let mut selects = side.selects.iter();
        selects
            .find(|(_, when)| circuit.holds(**when, inputs, values))
            .map(|(behavior, _)| *behavior)
    }
}

/// The memory that the solver's answer leads to.
fn holding<'a>(
    solver: &Solver,
    leaves: &'a [(Box<[u64]>, Signal)],
) -> Option<&'a (Box<[u64]>, Signal)> {
    leaves.iter().find(|(_, when)| solver.value(*when))
}
