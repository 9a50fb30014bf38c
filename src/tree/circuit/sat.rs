//! Circuits as clauses (Tseitin 1968) for BatSat, a SAT solver of the MiniSat family.

use super::{Circuit, Gate, Signal};
use rustsat::solvers::{Solve, SolveIncremental, SolverResult};
use rustsat::types::{Clause, Lit, TernaryVal};
use rustsat_batsat::BasicSolver;
use std::cell::Cell;
use std::rc::Rc;

/// The solver has spent what it was given without an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tree) struct Exhausted;

/// A solver that knows the gates that it was asked for. What it has learned serves later questions.
pub(in crate::tree) struct Solver {
    solver: BasicSolver,
    /// Which gates it knows.
    known: Vec<bool>,
    /// The work that it may still do.
    left: Rc<Cell<u64>>,
    /// The clauses that it has.
    clauses: Rc<Cell<u64>>,
}

/// Clauses that are looked at in the time of one decision, about.
const CLAUSES: u64 = 500;

impl Solver {
    /// A solver that may take `budget` decisions, in all questions together; where there are many clauses, one counts for
    /// several.
    pub(in crate::tree) fn new(budget: u64) -> Self {
        let left = Rc::new(Cell::new(budget));
        let spent = Rc::clone(&left);
        let clauses = Rc::new(Cell::new(0));
        let many = Rc::clone(&clauses);
        let mut solver = BasicSolver::default();
        // Called at every decision: effort is counted, not timed.
        solver.batsat_mut().cb_mut().set_stop(move || {
            let cost = 1 + many.get() / CLAUSES;
            spent.set(spent.get().saturating_sub(cost));
            spent.get() == 0
        });
        Self {
            solver,
            known: Vec::new(),
            left,
            clauses,
        }
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
            Ok(SolverResult::Unsat) => Ok(false),
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
                // A variable that no clause has is not decided.
                Some(Gate::Input) | None => {
                    self.solver.reserve(output.var()).map_err(|_| Exhausted)?
                }
            }
        }
        Ok(())
    }

    fn clause<const N: usize>(&mut self, literals: [Lit; N]) -> Result<(), Exhausted> {
        self.clauses.set(self.clauses.get() + 1);
        let clause: Clause = literals.into_iter().collect();
        self.solver.add_clause(clause).map_err(|_| Exhausted)
    }
}

fn literal(signal: Signal) -> Lit {
    Lit::new(signal.0 >> 1, signal.is_negated())
}
