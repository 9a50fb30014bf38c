//! The units of a tree: when it selects each of its behaviours, as signals of a circuit.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Guard};
use crate::tree::circuit::Signal;
use crate::tree::circuit::guards::Guards;
use crate::tree::reading::{Answers, Approximation, Plan, Reading, Sets, read};
use std::convert::Infallible;

/// Exactly when a node answers at once.
impl Approximation for Guards {
    type When = Signal;
    const NEVER: Signal = Signal::FALSE;
    const ALWAYS: Signal = Signal::TRUE;

    fn guard(&mut self, guard: &Guard) -> Answers<Signal> {
        let holds = self.signal(guard);
        Answers {
            success: holds,
            failure: !holds,
        }
    }

    fn both(&mut self, a: Signal, b: Signal) -> Signal {
        self.circuit.and(a, b)
    }

    fn either(&mut self, a: Signal, b: Signal) -> Signal {
        self.circuit.or(a, b)
    }
}

/// When one of the atoms holds.
fn any(atoms: &[Atom], guards: &mut Guards) -> Signal {
    atoms.iter().fold(Signal::FALSE, |any, atom| {
        let holds = guards.atom(*atom);
        guards.circuit.or(any, holds)
    })
}

/// The units found so far, over the circuit in which they are made.
pub(super) struct Units<'g> {
    pub(super) guards: &'g mut Guards,
    /// When each behaviour is selected, by leaf, from the left.
    pub(super) found: Vec<(Id<Behavior>, Signal)>,
}

impl Sets for Units<'_> {
    type Set = Signal;
    type Open = Infallible;

    fn none(&self) -> Signal {
        Signal::FALSE
    }

    fn is_none(&self, set: &Signal) -> bool {
        *set == Signal::FALSE
    }

    fn both(&mut self, a: &Signal, b: &Signal) -> Signal {
        self.guards.circuit.and(*a, *b)
    }

    fn either(&mut self, a: Signal, b: &Signal) -> Signal {
        self.guards.circuit.or(a, *b)
    }

    fn minus(&mut self, a: Signal, b: &Signal) -> Signal {
        self.guards.circuit.and(a, !*b)
    }

    fn holds(&mut self, guard: &Guard, among: &Signal) -> Result<Signal, Infallible> {
        let holds = self.guards.signal(guard);
        Ok(self.both(among, &holds))
    }

    fn any(&mut self, atoms: &[Atom], among: &Signal) -> Result<Signal, Infallible> {
        let any = any(atoms, self.guards);
        Ok(self.both(among, &any))
    }

    fn select(&mut self, behavior: Id<Behavior>, among: Signal) {
        self.found.push((behavior, among));
    }

    /// A node is read as if it were always reached, and what comes of it is restricted then: so equal nodes come to equal
    /// gates, wherever they stand.
    fn reach(
        &mut self,
        plan: &Plan,
        by: Reading,
        among: Signal,
    ) -> Result<Answers<Signal>, Infallible> {
        if let Plan::Resuming(..) = plan {
            // In guards, the atoms of inner memory nodes stand before those of outer ones.
            plan.visit_ended(&mut |ended| {
                any(ended, self.guards);
            });
        }
        let first = self.found.len();
        let Ok(Answers { success, failure }) = read(plan, by, Signal::TRUE, self);
        let restricted = Answers {
            failure: self.both(&among, &failure),
            success: self.both(&among, &success),
        };
        for (_, when) in self.found.iter_mut().skip(first) {
            *when = self.guards.circuit.and(among, *when);
        }
        Ok(restricted)
    }
}
