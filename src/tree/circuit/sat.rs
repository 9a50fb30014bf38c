//! Circuits as clauses (Tseitin 1968) for BatSat, a SAT solver of the MiniSat family.

#[cfg(test)]
use super::rup::Proof;
use super::{Circuit, Gate, Signal};
use batsat::{Callbacks, SolverInterface, lbool};
use rustsat::solvers::{Solve, SolveIncremental, SolverResult};
use rustsat::types::{Clause, Lit, TernaryVal};
use std::cell::Cell;
#[cfg(test)]
use std::cell::RefCell;
use std::rc::Rc;

/// The solver has spent what it was given without an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tree) struct Exhausted;

/// A solver that knows the gates that it was asked for. What it has learned serves later questions.
pub(in crate::tree) struct Solver {
    solver: rustsat_batsat::Solver<Calls>,
    /// Which gates it knows.
    known: Vec<bool>,
    /// Whether it decides inputs alone.
    inputs_alone: bool,
    /// The work that it may still do.
    left: Rc<Cell<u64>>,
    /// The clauses that it has.
    clauses: Rc<Cell<u64>>,
    /// Why its answers are no.
    #[cfg(test)]
    proof: Rc<RefCell<Proof>>,
}

/// What BatSat calls on its way.
#[derive(Default)]
struct Calls {
    left: Rc<Cell<u64>>,
    clauses: Rc<Cell<u64>>,
    #[cfg(test)]
    proof: Rc<RefCell<Proof>>,
}

impl Callbacks for Calls {
    /// Called at every decision: effort is counted, not timed.
    fn stop(&self) -> bool {
        let cost = 1 + self.clauses.get() / CLAUSES;
        self.left.set(self.left.get().saturating_sub(cost));
        self.left.get() == 0
    }

    #[cfg(test)]
    fn on_new_clause(&mut self, clause: &[batsat::Lit], _: batsat::ClauseKind) {
        let positive = |literal: &batsat::Lit| *literal == batsat::Lit::new(literal.var(), true);
        let literal = |literal: &batsat::Lit| Lit::new(literal.var().idx(), !positive(literal));
        let clause = clause.iter().map(literal).collect();
        self.proof.borrow_mut().learned(clause);
    }
}

/// Clauses that are looked at in the time of one decision, about.
const CLAUSES: u64 = 500;

impl Solver {
    /// A solver that may take `budget` decisions, in all questions together; where there are many clauses, one counts for
    /// several.
    pub(in crate::tree) fn new(budget: u64) -> Self {
        let mut solver = rustsat_batsat::Solver::<Calls>::default();
        let calls = solver.batsat_mut().cb_mut();
        calls.left.set(budget);
        let (left, clauses) = (Rc::clone(&calls.left), Rc::clone(&calls.clauses));
        #[cfg(test)]
        let proof = Rc::clone(&calls.proof);
        Self {
            solver,
            known: Vec::new(),
            inputs_alone: false,
            left,
            clauses,
            #[cfg(test)]
            proof,
        }
    }

    /// The same, deciding inputs alone, from which the values of all gates follow. An answer takes no more decisions than
    /// there are valuations, however large the circuit is; over many inputs it is better to decide gates, too.
    pub(in crate::tree) fn deciding_inputs(mut self) -> Self {
        self.inputs_alone = true;
        self
    }

    /// How many of the clauses that it has learned were checked.
    #[cfg(test)]
    pub(in crate::tree) fn checked(&self) -> usize {
        self.proof.borrow().checked
    }

    /// Whether all of the signals can hold together.
    ///
    /// # Errors
    /// The budget is spent.
    pub(in crate::tree) fn can_hold(
        &mut self,
        circuit: &Circuit,
        signals: &[Signal],
    ) -> Result<bool, Exhausted> {
        self.learn(circuit, signals)?;
        if self.left.get() == 0 {
            return Err(Exhausted);
        }
        let literals: Vec<Lit> = signals.iter().map(|signal| literal(*signal)).collect();
        match self.solver.solve_assumps(&literals) {
            Ok(SolverResult::Sat) => Ok(true),
            Ok(SolverResult::Unsat) => {
                #[cfg(test)]
                self.proof.borrow_mut().refutes(&literals);
                Ok(false)
            }
            _ => Err(Exhausted),
        }
    }

    /// The value of a signal in the answer to the last question if that was yes; what it has not heard of is false.
    pub(in crate::tree) fn value(&self, signal: Signal) -> bool {
        let known = self.known.get(signal.gate()).copied().unwrap_or(false);
        let output = literal(signal.negated_if(signal.is_negated()));
        let holds = known && matches!(self.solver.lit_val(output), Ok(TernaryVal::True));
        holds != signal.is_negated()
    }

    /// The least valuation of `inputs` in which all of the signals hold, as [`truth::least`](super::truth::least) has it.
    ///
    /// # Errors
    /// The budget is spent.
    pub(in crate::tree) fn least(
        &mut self,
        circuit: &Circuit,
        signals: &[Signal],
        inputs: &[Signal],
    ) -> Result<Option<Vec<bool>>, Exhausted> {
        if !self.can_hold(circuit, signals)? {
            return Ok(None);
        }
        let mut model: Vec<bool> = inputs.iter().map(|input| self.value(*input)).collect();
        let mut fixed = signals.to_vec();
        for (i, input) in inputs.iter().enumerate() {
            let held = model.get(i).copied().unwrap_or(false);
            fixed.push(!*input);
            if held {
                if self.can_hold(circuit, &fixed)? {
                    model = inputs.iter().map(|input| self.value(*input)).collect();
                } else {
                    fixed.pop();
                    fixed.push(*input);
                }
            }
        }
        Ok(Some(model))
    }

    /// Adds the clauses of the gates that the signals depend on.
    ///
    /// # Errors
    /// The solver does not take them.
    pub(in crate::tree) fn learn(
        &mut self,
        circuit: &Circuit,
        signals: &[Signal],
    ) -> Result<(), Exhausted> {
        self.known.resize(circuit.gates.len(), false);
        let variables = self.solver.batsat_ref().num_vars() as usize;
        for gate in circuit.gates.iter().skip(variables) {
            let decided = !self.inputs_alone || matches!(gate, Gate::Input);
            self.solver.batsat_mut().new_var(lbool::UNDEF, decided);
        }
        let mut open: Vec<usize> = signals.iter().map(|signal| signal.gate()).collect();
        while let Some(gate) = open.pop() {
            match self.known.get_mut(gate) {
                Some(known) if !*known => *known = true,
                _ => continue,
            }
            let output = literal(Signal((gate as u32) << 1));
            match circuit.gates.get(gate) {
                Some(Gate::And(a, b)) => {
                    open.extend([a.gate(), b.gate()]);
                    let (a, b) = (literal(*a), literal(*b));
                    self.clause([!output, a])?;
                    self.clause([!output, b])?;
                    self.clause([output, !a, !b])?;
                }
                Some(Gate::False) => self.clause([!output])?,
                Some(Gate::Input) | None => {}
            }
        }
        Ok(())
    }

    fn clause<const N: usize>(&mut self, literals: [Lit; N]) -> Result<(), Exhausted> {
        self.clauses.set(self.clauses.get() + 1);
        #[cfg(test)]
        self.proof.borrow_mut().given(&literals);
        let clause: Clause = literals.into_iter().collect();
        self.solver.add_clause(clause).map_err(|_| Exhausted)
    }
}

fn literal(signal: Signal) -> Lit {
    Lit::new(signal.0 >> 1, signal.is_negated())
}
