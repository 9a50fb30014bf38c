//! Ticks of both trees at once.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Exclusion, Status};
use crate::policy::Minterm;
use crate::tree::circuit::{Circuit, Signal};
use crate::tree::compiled::CompiledTree;
use crate::tree::equivalence::unfold::{Given, Inputs, Unfolded, unfold};
use crate::tree::equivalence::window::{Termination, shows};
use crate::tree::equivalence::{Trace, TraceTick};
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::rc::Rc;

/// A memory of each tree.
pub(super) type Memories = [Box<[u64]>; 2];

/// A tick of a tree: from which memory, and how far it is followed.
type Ticked = (Box<[u64]>, Given);

/// A tick of both trees from a pair of memories.
pub(super) struct Pair {
    pub(super) sides: [Rc<Unfolded>; 2],
    /// When they select differently.
    pub(super) differ: Signal,
    /// When which termination enters the window, if any does.
    pub(super) enters: Vec<(Option<Termination>, Signal)>,
}

/// Two trees over the same atoms, with every tick that was asked for.
pub(super) struct Pairs {
    atoms: Vec<Atom>,
    trees: [CompiledTree; 2],
    history: History,
    /// The history atoms that the window remembers, with the terminations that they ask for.
    remembered: Vec<((Id<Behavior>, Status), Atom, Signal)>,
    pub(super) inputs: Inputs,
    /// Where nothing holds together that is excluded.
    pub(super) possible: Signal,
    unfolded: [FxHashMap<Ticked, Rc<Unfolded>>; 2],
    known: FxHashMap<Memories, Rc<Pair>>,
}

impl Pairs {
    pub(super) fn new(
        atoms: Vec<Atom>,
        trees: [CompiledTree; 2],
        history: History,
        excluded: &[Exclusion],
    ) -> Self {
        let mut circuit = Circuit::new();
        let mut remembered = Vec::new();
        let mut signals = Vec::new();
        for atom in &atoms {
            let asked = atom.termination();
            // What the window does not remember never holds.
            let signal = match asked.is_none() || history.remembers(*atom) {
                true => circuit.input(),
                false => Signal::FALSE,
            };
            let asked = asked.filter(|_| history.remembers(*atom));
            remembered.extend(asked.map(|termination| (termination, *atom, signal)));
            signals.push(signal);
        }
        let mut possible = Signal::TRUE;
        for literals in excluded {
            let together = literals.iter().map(|(atom, value)| {
                let at = atoms.iter().position(|known| known == atom);
                let signal = at.and_then(|at| signals.get(at)).copied();
                signal.map_or(Signal::FALSE, |signal| signal.negated_if(!value))
            });
            let together = circuit.all(together);
            possible = circuit.and(possible, !together);
        }
        Self {
            atoms,
            trees,
            history,
            remembered,
            possible,
            inputs: Inputs {
                circuit,
                atoms: signals,
                behaviors: BTreeMap::new(),
            },
            unfolded: Default::default(),
            known: FxHashMap::default(),
        }
    }

    /// Memories before the first tick; empty for a tree without memory.
    pub(super) fn fresh(&self) -> Memories {
        self.trees.each_ref().map(|tree| vec![0; tree.slots].into())
    }

    /// The terminations that a window can hold, besides those that no atom asks for.
    pub(super) fn kinds(&self) -> impl Iterator<Item = Termination> {
        self.remembered.iter().map(|(kind, ..)| Some(*kind))
    }

    /// How many terminations a window holds; none where there is nothing to remember.
    pub(super) fn window(&self) -> usize {
        self.history.length(&self.remembered)
    }

    /// Where no window is long enough for what the atoms say.
    pub(super) fn too_many(&mut self) -> Signal {
        let held = self.remembered.iter().map(|(.., signal)| *signal);
        let held: Vec<Signal> = held.collect();
        let circuit = &mut self.inputs.circuit;
        circuit.at_least(self.history.window.saturating_add(1), &held)
    }

    /// What holds of the atoms where the window is this one.
    pub(super) fn shows(&self, window: &[Termination]) -> Vec<Signal> {
        let shown = self.remembered.iter();
        let shown = shown.map(|(_, atom, signal)| signal.negated_if(!shows(window, *atom)));
        shown.chain([self.possible]).collect()
    }

    /// The tick of both trees from these memories.
    pub(super) fn pair(&mut self, memories: &Memories) -> Rc<Pair> {
        if let Some(pair) = self.known.get(memories) {
            return Rc::clone(pair);
        }
        let sides = self.both(memories, &Given::default());
        let differ = self.differ(&sides);
        let [selecting, _] = &sides;
        let enters = self.enters(&selecting.selects);
        let pair = Rc::new(Pair {
            differ,
            enters,
            sides,
        });
        self.known.insert(memories.clone(), Rc::clone(&pair));
        pair
    }

    /// When two ticks select different behaviours.
    pub(super) fn differ(&mut self, [left, right]: &[Rc<Unfolded>; 2]) -> Signal {
        self.inputs.differ([&left.selects, &right.selects])
    }

    /// The ticks of both trees from these memories.
    pub(super) fn both(&mut self, [left, right]: &Memories, given: &Given) -> [Rc<Unfolded>; 2] {
        [self.unfold(0, left, given), self.unfold(1, right, given)]
    }

    /// The tick of one tree from a memory.
    fn unfold(&mut self, side: usize, memory: &[u64], given: &Given) -> Rc<Unfolded> {
        let (Some(tree), Some(known)) = (self.trees.get(side), self.unfolded.get_mut(side)) else {
            return Rc::default();
        };
        let entry = known.entry((memory.into(), given.clone()));
        let unfolded = || Rc::new(unfold(tree, memory, &mut self.inputs, given));
        Rc::clone(entry.or_insert_with(unfolded))
    }

    /// What enters the window when these behaviours are selected.
    fn enters(
        &mut self,
        selects: &BTreeMap<Id<Behavior>, Signal>,
    ) -> Vec<(Option<Termination>, Signal)> {
        let mut kept = vec![Status::Success, Status::Failure];
        kept.retain(|status| !self.remembered.is_empty() && self.history.keeps(*status));
        let mut entries: BTreeMap<Termination, Signal> = BTreeMap::new();
        let mut some = Signal::FALSE;
        for (behavior, selected) in selects {
            for status in &kept {
                let termination = Some((*behavior, *status));
                let asked = self.kinds().any(|kind| kind == termination);
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

    /// The atoms.
    pub(super) fn atoms(&self) -> Vec<Signal> {
        self.inputs.atoms.clone()
    }

    /// The atoms, then the statuses of all behaviours.
    pub(super) fn all_inputs(&self) -> Vec<Signal> {
        let statuses = self.inputs.behaviors.values().flatten();
        self.inputs.atoms.iter().chain(statuses).copied().collect()
    }

    /// The step that both trees take where all inputs have these values.
    pub(super) fn step(&mut self, pair: &Pair, inputs: &[Signal], values: &[bool]) -> TraceTick {
        let [left, _] = &pair.sides;
        let behavior = self.selected(left, inputs, values);
        let status = behavior.and_then(|behavior| {
            let mut ended = [Status::Success, Status::Failure].into_iter();
            ended.find(|status| {
                let when = self.inputs.status(behavior, *status);
                self.inputs.circuit.holds(when, inputs, values)
            })
        });
        TraceTick {
            valuation: self.minterm(values),
            behavior,
            status: status.unwrap_or(Status::Running),
        }
    }

    /// The trace with these steps whose last tick has these values of the atoms.
    pub(super) fn parted(
        &self,
        steps: Vec<TraceTick>,
        [left, right]: &[Rc<Unfolded>; 2],
        values: &[bool],
    ) -> Trace {
        let atoms = &self.inputs.atoms;
        Trace {
            atoms: self.atoms.clone(),
            steps,
            left: self.selected(left, atoms, values),
            right: self.selected(right, atoms, values),
            valuation: self.minterm(values),
        }
    }

    fn minterm(&self, values: &[bool]) -> Minterm {
        Minterm::new(values.iter().copied().take(self.atoms.len()))
    }

    pub(super) fn selected(
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
