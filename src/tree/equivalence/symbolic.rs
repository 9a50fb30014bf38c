//! Two trees where anything may happen that is consistent with the history window.
//!
//! What both trees select is a circuit over the atoms. Without memory one question settles it: is there a valuation in
//! which the selections differ? With memory the same question is asked in every pair of memories and every window that
//! can be reached, shortest paths first; valuations and statuses are never enumerated, only the states that they lead to.

mod onward;
mod pairs;
#[cfg(test)]
mod proved;

use super::window::{Termination, Window, enter};
use super::{ANSWERS, Explored, MayEnd, Means, Onward, Trace, TraceTick, Unknown, Verdict};
use crate::ir::task::History;
use crate::ir::tree::{Atom, Exclusion, Node};
use crate::tree::atoms::{atoms, behaviors};
use crate::tree::circuit::sat::{Exhausted, Solver};
use crate::tree::circuit::{Signal, truth};
use crate::tree::compiled::CompiledTree;
use pairs::{Memories, Pairs};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;

/// Up to this many atoms, a truth table is quicker than a solver.
const TABLE: usize = 20;

/// The work after which the solver gives up, in decisions over few clauses.
const DECISIONS: u64 = 1_000_000;

/// Up to this many inputs, atoms and statuses of behaviours, the solver decides them alone.
const FEW: usize = 16;

/// States after which the search gives up.
const STATES: usize = 100_000;

pub(super) fn explore(
    (left, right): (&Node, &Node),
    (history, excluded): (History, &[Exclusion]),
    may_end: MayEnd,
) -> Result<(Verdict, Onward), Unknown> {
    let mut search = SymbolicSearch::new((left, right), (history, excluded))?;
    Ok(match search.run() {
        Ok(Some(trace)) => (Verdict::Differ(trace), Onward::Undecided),
        Ok(None) if !may_go_on(left, may_end) => (Verdict::Equal(search.explored), Onward::Alike),
        Ok(None) => {
            let explored = search.explored.clone();
            let onward = match search.onward(may_end) {
                Ok(parted) => parted.map_or(Onward::Alike, Onward::Differ),
                Err(Exhausted) => Onward::Undecided,
            };
            (Verdict::Equal(explored), onward)
        }
        Err(Exhausted) => (Verdict::Undecided(search.explored), Onward::Undecided),
    })
}

/// Whether a tick may go on after a behaviour of this tree.
fn may_go_on(tree: &Node, may_end: MayEnd) -> bool {
    let mut behaviors = behaviors(tree).into_iter();
    behaviors.any(|behavior| ANSWERS.iter().any(|answer| may_end(behavior, *answer)))
}

/// Both memories and the window.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct State {
    memories: Memories,
    window: Window,
}

/// A state with the one that led to it, and with what had to hold there.
struct Reached {
    state: State,
    from: Option<(usize, Signal)>,
}

struct SymbolicSearch {
    pairs: Pairs,
    solver: Solver,
    reached: Vec<Reached>,
    known: FxHashSet<State>,
    explored: Explored,
}

impl SymbolicSearch {
    fn new(
        (left, right): (&Node, &Node),
        (history, excluded): (History, &[Exclusion]),
    ) -> Result<Self, Unknown> {
        let mut asked = atoms(left);
        asked.extend(atoms(right));
        let asked: Vec<Atom> = asked.into_iter().collect();
        let tree = |root| CompiledTree::new(root, &asked).map_err(Unknown);
        let trees = [tree(left)?, tree(right)?];
        let ticked: BTreeSet<_> = [left, right].into_iter().flat_map(behaviors).collect();
        let solver = match asked.len() + 2 * ticked.len() {
            0..=FEW => Solver::new(DECISIONS).deciding_inputs(),
            _ => Solver::new(DECISIONS),
        };
        Ok(Self {
            pairs: Pairs::new(asked, trees, history, excluded),
            solver,
            reached: Vec::new(),
            known: FxHashSet::default(),
            explored: Explored::default(),
        })
    }

    /// The shortest trace on which the trees part.
    fn run(&mut self) -> Result<Option<Trace>, Exhausted> {
        let fresh = self.pairs.fresh();
        let first = self.pairs.pair(&fresh);
        if let Some(valuation) = self.at_once(first.differ, Pairs::atoms)? {
            let trace = self.pairs.parted(Vec::new(), &first.sides, &valuation);
            return Ok(Some(trace));
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

    /// The least values of these inputs with which this holds before anything has happened, whatever the window holds.
    fn at_once(
        &mut self,
        holds: Signal,
        inputs: fn(&Pairs) -> Vec<Signal>,
    ) -> Result<Option<Vec<bool>>, Exhausted> {
        let too_many = self.pairs.too_many();
        let inputs = inputs(&self.pairs);
        let circuit = &mut self.pairs.inputs.circuit;
        let goal = circuit.all([holds, !too_many, self.pairs.possible]);
        let asked = circuit.support(goal, &inputs);
        if asked <= TABLE {
            self.explored.means = Means::Table { atoms: asked };
            return Ok(truth::least(circuit, goal, &inputs));
        }
        self.explored.means = Means::Solver { atoms: asked };
        self.solver.least(circuit, &[goal], &inputs)
    }

    /// Every window that may be there before the first tick, the emptiest first.
    fn windows(&self) -> Result<Vec<Window>, Exhausted> {
        let kinds: Vec<Termination> = std::iter::once(None).chain(self.pairs.kinds()).collect();
        let mut windows = vec![Window::new()];
        for _ in 0..self.pairs.window() {
            if windows.len() * kinds.len() > STATES {
                return Err(Exhausted);
            }
            let longer = windows.iter().flat_map(|window| {
                let with = |kind: &Termination| window.iter().copied().chain([*kind]).collect();
                kinds.iter().map(with)
            });
            windows = longer.collect();
        }
        Ok(windows)
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
        let pair = self.pairs.pair(&state.memories);
        let mut open = self.pairs.shows(&state.window);
        open.push(pair.differ);
        if self.solver.can_hold(&self.pairs.inputs.circuit, &open)? {
            let (steps, values) = self.way(at, pair.differ)?;
            let trace = self.pairs.parted(steps, &pair.sides, &values);
            return Ok(Some(trace));
        }
        open.pop();
        let [left, right] = &pair.sides;
        let leaves = left.leaves.iter().chain(&right.leaves);
        let entering = pair.enters.iter().map(|(_, when)| *when);
        let outcomes: Vec<Signal> = leaves.map(|(_, when)| *when).chain(entering).collect();
        self.solver.learn(&self.pairs.inputs.circuit, &outcomes)?;
        // Each answer is a way on; asked again without it, the solver gives another until there is none.
        while self.solver.can_hold(&self.pairs.inputs.circuit, &open)? {
            self.explored.ticks += 1;
            let holds = |when: &Signal| self.solver.value(*when);
            let (Some((a, left)), Some((b, right)), Some((entry, enters))) = (
                left.leaves.iter().find(|(_, when)| holds(when)),
                right.leaves.iter().find(|(_, when)| holds(when)),
                pair.enters.iter().find(|(_, when)| holds(when)),
            ) else {
                return Err(Exhausted);
            };
            let mut window = state.window.clone();
            if let Some(termination) = entry {
                enter(&mut window, *termination);
            }
            let circuit = &mut self.pairs.inputs.circuit;
            let moves = circuit.all([*left, *right, *enters]);
            let memories = [a.clone(), b.clone()];
            self.reach(State { memories, window }, Some((at, moves)))?;
            open.push(!moves);
        }
        Ok(None)
    }

    /// The steps to a state, and values of all inputs with which the trees part there by `differ`; all as small as they can be.
    fn way(&mut self, at: usize, differ: Signal) -> Result<(Vec<TraceTick>, Vec<bool>), Exhausted> {
        let mut path = Vec::new();
        let mut next = Some((at, None));
        while let Some((at, moves)) = next {
            let reached = self.reached.get(at).ok_or(Exhausted)?;
            path.push((reached.state.clone(), moves));
            next = reached.from.map(|(before, moves)| (before, Some(moves)));
        }
        let inputs = self.pairs.all_inputs();
        let mut steps = Vec::new();
        for (state, moves) in path.into_iter().rev() {
            let pair = self.pairs.pair(&state.memories);
            let mut question = self.pairs.shows(&state.window);
            question.push(moves.unwrap_or(differ));
            let circuit = &self.pairs.inputs.circuit;
            let least = self.solver.least(circuit, &question, &inputs)?;
            let values = least.ok_or(Exhausted)?;
            match moves {
                Some(_) => steps.push(self.pairs.step(&pair, &inputs, &values)),
                None => return Ok((steps, values)),
            }
        }
        Err(Exhausted)
    }
}
