//! Guards to circuits and back.

use super::sat::Solver;
use super::{Circuit, Gate, Signal, truth};
use crate::ir::tree::{Atom, Guard};
use crate::tree::guard::{and, not, or};
use std::collections::BTreeMap;

/// With at most this many atoms a truth table is quicker than the solver.
const TABLE: usize = 12;

/// The decisions that the solver may take for one circuit.
const DECISIONS: u64 = 2_000_000;

/// A circuit whose inputs are atoms.
pub(in crate::tree) struct Guards {
    pub(in crate::tree) circuit: Circuit,
    inputs: BTreeMap<Atom, Signal>,
    /// The atoms in the order in which they were asked for.
    atoms: Vec<Atom>,
    solver: Solver,
}

impl Guards {
    pub(in crate::tree) fn new() -> Self {
        Self {
            circuit: Circuit::new(),
            inputs: BTreeMap::new(),
            atoms: Vec::new(),
            solver: Solver::new(DECISIONS),
        }
    }

    /// When an atom holds.
    pub(in crate::tree) fn atom(&mut self, atom: Atom) -> Signal {
        let (circuit, atoms) = (&mut self.circuit, &mut self.atoms);
        *self.inputs.entry(atom).or_insert_with(|| {
            atoms.push(atom);
            circuit.input()
        })
    }

    /// When a guard holds.
    pub(in crate::tree) fn signal(&mut self, guard: &Guard) -> Signal {
        match guard {
            Guard::Const(value) => Signal::constant(*value),
            Guard::Atom(atom) => self.atom(*atom),
            Guard::Not(guard) => !self.signal(guard),
            Guard::And(guards) => {
                let parts: Vec<Signal> = guards.iter().map(|guard| self.signal(guard)).collect();
                self.circuit.all(parts)
            }
            Guard::Or(guards) => {
                let parts: Vec<Signal> = guards.iter().map(|guard| self.signal(guard)).collect();
                self.circuit.any(parts)
            }
        }
    }

    /// The atoms on which any of the signals depends, in the order in which they were asked for, with their inputs.
    pub(in crate::tree) fn support(&self, signals: &[Signal]) -> Vec<(Atom, Signal)> {
        let cone = self.circuit.cone(signals);
        let inputs = self
            .atoms
            .iter()
            .filter_map(|atom| Some((*atom, *self.inputs.get(atom)?)));
        let reads = |(_, input): &(Atom, Signal)| cone.binary_search(&input.gate()).is_ok();
        inputs.filter(reads).collect()
    }

    /// Whether the signal holds nowhere; false where the solver cannot tell.
    pub(in crate::tree) fn is_never(&mut self, signal: Signal) -> bool {
        if signal == Signal::FALSE || signal == Signal::TRUE {
            return signal == Signal::FALSE;
        }
        let support = self.support(&[signal]);
        if support.len() <= TABLE {
            let inputs: Vec<Signal> = support.into_iter().map(|(_, input)| input).collect();
            return truth::least(&self.circuit, signal, &inputs).is_none();
        }
        self.solver.can_hold(&self.circuit, &[signal]) == Ok(false)
    }

    /// The signal as a guard of at most `most` literals.
    pub(in crate::tree) fn guard(&self, signal: Signal, most: usize) -> Option<Guard> {
        let names: BTreeMap<usize, Atom> = self
            .inputs
            .iter()
            .map(|(atom, input)| (input.gate(), *atom))
            .collect();
        let mut left = most;
        self.written(signal, &names, &mut left)
    }

    fn written(
        &self,
        signal: Signal,
        names: &BTreeMap<usize, Atom>,
        left: &mut usize,
    ) -> Option<Guard> {
        let negated = signal.is_negated();
        match self.circuit.gate(signal) {
            Gate::False => Some(Guard::Const(negated)),
            Gate::Input => {
                *left = left.checked_sub(1)?;
                let atom = Guard::Atom(*names.get(&signal.gate())?);
                Some(if negated { not(atom) } else { atom })
            }
            Gate::And(..) => {
                let parts: Option<Vec<Guard>> = self
                    .conjuncts(signal.gate())
                    .into_iter()
                    .map(|part| self.written(part.negated_if(negated), names, left))
                    .collect();
                parts.map(|parts| if negated { or(parts) } else { and(parts) })
            }
        }
    }

    /// What a gate is the conjunction of, inputs first, without those that are conjunctions themselves.
    fn conjuncts(&self, gate: usize) -> Vec<Signal> {
        let mut open = vec![gate];
        let mut parts = Vec::new();
        let mut seen = vec![gate];
        while let Some(gate) = open.pop() {
            let Some(Gate::And(a, b)) = self.circuit.gates.get(gate) else {
                continue;
            };
            for part in [*a, *b] {
                let inner = !part.is_negated() && matches!(self.circuit.gate(part), Gate::And(..));
                if !inner {
                    parts.push(part);
                } else if !seen.contains(&part.gate()) {
                    seen.push(part.gate());
                    open.push(part.gate());
                }
            }
        }
        parts.sort_unstable();
        parts.dedup();
        parts
    }
}
