//! The search through the product automaton of both sides and an environment that a table gives, shortest paths first.

use super::environment::{Follow, Place, TableEnvironment};
use super::moment::Moment;
use super::oracle::Oracle;
use super::side::Automaton;
use super::{Explored, MayEnd, Onward, Parted, Side, Trace, TraceTick, Unknown, Verdict};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::logic::Bits;
use crate::policy::{Minterm, Policy};
use rustc_hash::FxHashSet;
use std::collections::BTreeSet;

/// Ticks after which the search gives up, besides some for each row of the table.
const PATIENCE: usize = 2_000_000;

/// Ticks that each row of the table adds to that.
const PATIENCE_PER_ROW: usize = 200;

/// Both memories and the environment.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct State {
    memories: [Box<[u64]>; 2],
    /// `None` before the first tick.
    place: Option<Place>,
}

/// A state with the tick that led to it.
struct Reached {
    state: State,
    from: Option<(usize, TraceTick)>,
}

/// Compares two sides along what a table records, or wherever the history window lets it go.
pub(super) fn explore(
    [left, right]: [Side; 2],
    table: &Policy,
    follow: Follow,
    may_end: MayEnd,
) -> Result<(Verdict, Onward), Unknown> {
    let environment = TableEnvironment::new(table, follow);
    let sides = [
        Automaton::new(left, &environment)?,
        Automaton::new(right, &environment)?,
    ];
    let product = Product {
        sides,
        reached: Vec::new(),
        known: FxHashSet::default(),
        minterms: Bits::empty(environment.minterms.len()),
        transitions: BTreeSet::new(),
        open: BTreeSet::new(),
        explored: Explored::default(),
        may_end,
        onward: None,
        environment: &environment,
    };
    Ok(product.search())
}

/// The product automaton, as far as it is explored.
struct Product<'a> {
    sides: [Automaton; 2],
    environment: &'a TableEnvironment<'a>,
    reached: Vec<Reached>,
    known: FxHashSet<State>,
    minterms: Bits,
    transitions: BTreeSet<usize>,
    open: BTreeSet<(usize, Option<Id<Behavior>>)>,
    explored: Explored,
    may_end: MayEnd<'a>,
    /// The first tick in which the sides go on differently after what they select.
    onward: Option<Parted>,
}

impl Product<'_> {
    fn search(mut self) -> (Verdict, Onward) {
        self.reach(None, None);
        let patience = PATIENCE + PATIENCE_PER_ROW * self.environment.minterms.len();
        let mut next = 0;
        while let Some(state) = self.reached.get(next).map(|reached| reached.state.clone()) {
            let mut oracle = Oracle::default();
            loop {
                if let Some(trace) = self.tick(next, &state, &mut oracle) {
                    return (Verdict::Differ(trace), Onward::Undecided);
                }
                self.explored.ticks += 1;
                if self.explored.ticks > patience {
                    return (Verdict::Undecided(self.summary()), Onward::Undecided);
                }
                if !oracle.advance() {
                    break;
                }
            }
            next += 1;
        }
        let onward = self.onward.take().map_or(Onward::Alike, Onward::Differ);
        (Verdict::Equal(self.summary()), onward)
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

    /// The sides have come here.
    fn reach(&mut self, place: Option<Place>, from: Option<(usize, TraceTick)>) {
        let state = State {
            memories: self.sides.each_ref().map(Automaton::memory),
            place,
        };
        if self.known.insert(state.clone()) {
            self.reached.push(Reached { state, from });
        }
    }

    /// One tick of both sides with the answers of the oracle; a trace if they part.
    fn tick(&mut self, at: usize, state: &State, oracle: &mut Oracle) -> Option<Trace> {
        let mut moment = Moment::new(self.environment, state.place.as_ref(), oracle)?;
        let minterm = moment.minterm;
        self.minterms.insert(minterm);
        let [left, right] = &mut self.sides;
        let [left_memory, right_memory] = &state.memories;
        let left = left.tick(left_memory, &mut moment);
        let right = right.tick(right_memory, &mut moment);
        let valuation = moment.valuation();
        let ticked = left.or(right);
        let consequence = moment.consequence(ticked.and_then(|ticked| ticked.selected));
        let (Some(left), Some(right)) = (left, right) else {
            // Where the table has no row, nothing is asked of the other side.
            self.open.insert((minterm, None));
            return None;
        };
        if left.selected != right.selected {
            return Some(self.trace(at, valuation, [left.selected, right.selected]));
        }
        let behavior = left.selected;
        if self.onward.is_none()
            && left.then != right.then
            && let Some(behavior) = behavior
            && (self.may_end)(behavior, consequence.status)
        {
            let trace = self.trace(at, valuation.clone(), [left.then, right.then]);
            self.onward = Some(Parted {
                ended: vec![(behavior, consequence.status)],
                trace,
            });
        }
        if consequence.open {
            self.open.insert((minterm, behavior));
        }
        self.transitions.extend(consequence.transition);
        if consequence.status == Status::Failure && consequence.transition.is_some() {
            let after = self.explored.after_failure.entry(valuation.clone());
            after.or_default().insert(left.then);
        }
        if let Some(place) = consequence.next {
            let tick = TraceTick {
                valuation,
                behavior,
                status: consequence.status,
            };
            self.reach(Some(place), Some((at, tick)));
        }
        None
    }

    /// The way to the state in which the sides select these.
    fn trace(
        &self,
        mut at: usize,
        valuation: Minterm,
        [left, right]: [Option<Id<Behavior>>; 2],
    ) -> Trace {
        let mut ticks = Vec::new();
        while let Some((before, tick)) = self.reached.get(at).and_then(|r| r.from.as_ref()) {
            ticks.push(tick.clone());
            at = *before;
        }
        ticks.reverse();
        Trace {
            atoms: self.environment.atoms.to_vec(),
            steps: ticks,
            valuation,
            left,
            right,
        }
    }
}
