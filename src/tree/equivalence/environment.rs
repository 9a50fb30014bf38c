//! What may happen next.

use super::oracle::Oracle;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Status};
use crate::policy::{Minterm, Policy};
use std::collections::BTreeMap;

/// Where valuations and statuses come from.
#[derive(Clone, Copy, Debug)]
pub enum Environment<'a> {
    /// The greedy transitions of a policy, from its start minterms. A behaviour that runs on without a change of the
    /// minterm is a step as well.
    Greedy(&'a Policy),
    /// Any observed minterm of a table that is consistent with the history window, from its start minterms or, where
    /// it has none, from any.
    Observed(&'a Policy),
    /// Any valuation that is consistent with the history window.
    Any(History),
}

/// A behaviour with how it ended; `None` is one that no atom asks for.
pub(super) type Termination = Option<(Id<Behavior>, Status)>;

/// The last terminations, the newest last.
pub(super) type Window = Vec<Termination>;

/// Where the environment stands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Place {
    /// In a minterm of the table.
    At(usize),
    /// Where the window holds these terminations.
    Window(Window),
    /// Before the first tick.
    Start,
}

/// An environment made ready: its atoms, its minterms, what it may do.
pub(super) struct World<'a> {
    environment: Environment<'a>,
    pub(super) atoms: Vec<Atom>,
    pub(super) minterms: Vec<Minterm>,
    numbers: BTreeMap<&'a Minterm, usize>,
    /// The transitions from each minterm: behaviour, status, next minterm, position in the table.
    recorded: BTreeMap<usize, Vec<Record>>,
    starts: Vec<usize>,
}

type Record = (Id<Behavior>, Status, Option<usize>, usize);

/// What a behaviour comes to.
pub(super) struct Outcome {
    pub(super) status: Status,
    /// Where the environment stands then; `None` if nothing follows.
    pub(super) next: Option<Place>,
    /// The transition that was taken.
    pub(super) transition: Option<usize>,
    /// The environment says nothing of what follows.
    pub(super) open: bool,
}

impl<'a> World<'a> {
    /// The environment for trees that ask `asked`.
    pub(super) fn new(environment: Environment<'a>, asked: &[Atom]) -> Self {
        let mut world = Self {
            environment,
            atoms: asked.to_vec(),
            minterms: Vec::new(),
            numbers: BTreeMap::new(),
            recorded: BTreeMap::new(),
            starts: Vec::new(),
        };
        let (Environment::Greedy(policy) | Environment::Observed(policy)) = environment else {
            return world;
        };
        world.atoms.clone_from(&policy.atoms);
        for row in &policy.rows {
            world.number(&row.minterm);
        }
        for (minterm, _) in &policy.starts {
            let start = world.number(minterm);
            world.starts.push(start);
        }
        if let Environment::Greedy(_) = environment {
            for (i, t) in policy.transitions.iter().enumerate() {
                let from = world.number(&t.from);
                let to = t.to.as_ref().map(|to| world.number(to));
                let record = (t.behavior, t.status, to, i);
                world.recorded.entry(from).or_default().push(record);
            }
        } else if world.starts.is_empty() {
            world.starts = (0..world.minterms.len()).collect();
        }
        world
    }

    fn number(&mut self, minterm: &'a Minterm) -> usize {
        let next = self.minterms.len();
        let number = *self.numbers.entry(minterm).or_insert(next);
        if number == next {
            self.minterms.push(minterm.clone());
        }
        number
    }

    /// The window that the environment keeps.
    fn history(&self) -> History {
        match self.environment {
            Environment::Greedy(policy) | Environment::Observed(policy) => policy.history,
            Environment::Any(history) => history,
        }
    }

    /// Whether the window would remember what this atom asks.
    pub(super) fn remembers(&self, atom: Atom) -> bool {
        let history = self.history();
        match atom {
            Atom::Predicate(_) => false,
            Atom::Done(_) => history.window > 0 && history.success,
            Atom::Failed(_) => history.window > 0 && history.failure,
        }
    }

    /// The minterm in which a tick finds the environment, where it has minterms; and where it stands then.
    pub(super) fn find(
        &self,
        place: &Place,
        oracle: &mut Oracle,
    ) -> Option<(Option<usize>, Place)> {
        match (self.environment, place) {
            (_, Place::At(minterm)) => Some((Some(*minterm), place.clone())),
            (Environment::Greedy(_), _) => {
                let start = self.pick(&self.starts, oracle)?;
                Some((Some(start), Place::At(start)))
            }
            (Environment::Observed(_), Place::Start) => {
                let start = self.pick(&self.starts, oracle)?;
                let window = self.window(|window| self.shows(window, start), oracle)?;
                Some((Some(start), Place::Window(window)))
            }
            (Environment::Observed(policy), Place::Window(window)) => {
                let consistent: Vec<usize> = (0..policy.rows.len())
                    .filter(|minterm| self.shows(window, *minterm))
                    .collect();
                let minterm = self.pick(&consistent, oracle)?;
                Some((Some(minterm), place.clone()))
            }
            (Environment::Any(_), Place::Start) => {
                Some((None, Place::Window(self.window(|_| true, oracle)?)))
            }
            (Environment::Any(_), Place::Window(_)) => Some((None, place.clone())),
        }
    }

    fn pick(&self, among: &[usize], oracle: &mut Oracle) -> Option<usize> {
        let length = among.len();
        (length > 0)
            .then(|| oracle.choose(length))
            .and_then(|i| among.get(i).copied())
    }

    /// What the selected behaviour may come to.
    pub(super) fn outcome(
        &self,
        place: &Place,
        behavior: Option<Id<Behavior>>,
        oracle: &mut Oracle,
    ) -> Outcome {
        match place {
            Place::At(minterm) => self.recorded_outcome(*minterm, behavior, oracle),
            Place::Window(window) => {
                let status = match behavior {
                    Some(_) => any_status(oracle),
                    None => Status::Running,
                };
                let mut window = window.clone();
                if let Some(behavior) = behavior {
                    self.remember(&mut window, behavior, status);
                }
                Outcome {
                    status,
                    next: Some(Place::Window(window)),
                    transition: None,
                    open: false,
                }
            }
            Place::Start => Outcome {
                status: Status::Running,
                next: None,
                transition: None,
                open: false,
            },
        }
    }

    fn recorded_outcome(
        &self,
        minterm: usize,
        behavior: Option<Id<Behavior>>,
        oracle: &mut Oracle,
    ) -> Outcome {
        let records: Vec<&Record> = self
            .recorded
            .get(&minterm)
            .into_iter()
            .flatten()
            .filter(|record| Some(record.0) == behavior)
            .collect();
        let stays = Outcome {
            status: Status::Running,
            next: Some(Place::At(minterm)),
            transition: None,
            open: records.is_empty(),
        };
        let choice = oracle.choose(records.len() + 1);
        match choice.checked_sub(1).and_then(|i| records.get(i)) {
            None => stays,
            Some((_, status, next, transition)) => Outcome {
                status: *status,
                next: next.map(Place::At),
                transition: Some(*transition),
                open: false,
            },
        }
    }

    /// A termination enters the window, and the oldest leaves it.
    fn remember(&self, window: &mut Window, behavior: Id<Behavior>, status: Status) {
        let history = self.history();
        let atom = match status {
            Status::Success if history.success => Atom::Done(behavior),
            Status::Failure if history.failure => Atom::Failed(behavior),
            _ => return,
        };
        window.push(self.atoms.contains(&atom).then_some((behavior, status)));
        let over = window.len().saturating_sub(history.window);
        window.drain(..over);
    }

    /// Any window that passes.
    fn window(
        &self,
        passes: impl Fn(&[Termination]) -> bool,
        oracle: &mut Oracle,
    ) -> Option<Window> {
        let mut kinds = vec![None];
        for atom in self.atoms.iter().filter(|atom| self.remembers(**atom)) {
            match atom {
                Atom::Done(behavior) => kinds.push(Some((*behavior, Status::Success))),
                Atom::Failed(behavior) => kinds.push(Some((*behavior, Status::Failure))),
                Atom::Predicate(_) => {}
            }
        }
        let mut window = Window::new();
        if kinds.len() > 1 {
            for _ in 0..self.history().window {
                // The first answer leaves the rest of the window empty.
                match oracle
                    .choose(kinds.len() + 1)
                    .checked_sub(1)
                    .and_then(|k| kinds.get(k))
                {
                    Some(kind) => window.push(*kind),
                    None => break,
                }
            }
        }
        passes(&window).then_some(window)
    }

    /// Whether the history atoms of a minterm are those of a window.
    fn shows(&self, window: &[Termination], minterm: usize) -> bool {
        self.minterms.get(minterm).is_some_and(|minterm| {
            self.atoms
                .iter()
                .zip(minterm.values())
                .all(|(atom, value)| !self.remembers(*atom) || in_window(window, *atom) == value)
        })
    }
}

/// Whether a window makes a history atom true.
pub(super) fn in_window(window: &[Termination], atom: Atom) -> bool {
    window.iter().flatten().any(|(behavior, status)| {
        atom == match status {
            Status::Failure => Atom::Failed(*behavior),
            _ => Atom::Done(*behavior),
        }
    })
}

/// Any of the three.
pub(super) fn any_status(oracle: &mut Oracle) -> Status {
    match oracle.choose(3) {
        0 => Status::Running,
        1 => Status::Success,
        _ => Status::Failure,
    }
}
