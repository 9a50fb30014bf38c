//! What a recorded environment may do next.

use super::oracle::Oracle;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Status};
use crate::policy::{Minterm, Policy};
use rustc_hash::FxHashMap;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

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

/// Which transitions a table allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Follow {
    /// Those that it records.
    Recorded,
    /// Those to any of its minterms that the history window allows.
    Consistent,
}

/// A behaviour with how it ended; `None` is one that no atom asks for.
pub(super) type Termination = Option<(Id<Behavior>, Status)>;

/// The last terminations, the newest last. A window is full: what no atom asks for fills it up. It is empty where
/// nothing is remembered.
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

/// A minterm of the table, or a cube of it.
#[derive(Clone, Debug)]
pub(super) struct Care<'a> {
    pub(super) minterm: &'a Minterm,
    /// The atoms that may have either value.
    pub(super) free: Option<&'a Minterm>,
}

/// A table made ready: its atoms, its minterms, what may follow.
pub(super) struct World<'a> {
    follow: Follow,
    history: History,
    pub(super) atoms: &'a [Atom],
    /// The rows of the table, then what else it mentions.
    pub(super) minterms: Vec<Care<'a>>,
    rows: usize,
    /// The transitions from each minterm: behaviour, status, next minterm, position in the table.
    recorded: BTreeMap<usize, Vec<Record>>,
    starts: Vec<usize>,
    /// The terminations that the window remembers.
    kinds: Vec<(Id<Behavior>, Status)>,
    /// What was looked up before.
    showing: RefCell<Showing>,
}

/// Minterms by what their history atoms show, either all or only the starts.
type Showing = FxHashMap<(bool, Minterm), Rc<[usize]>>;

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
    pub(super) fn new(policy: &'a Policy, follow: Follow) -> Self {
        let mut minterms: Vec<Care> = Vec::new();
        let mut numbers: BTreeMap<&Minterm, usize> = BTreeMap::new();
        for row in &policy.rows {
            if row.free.is_none() {
                numbers.insert(&row.minterm, minterms.len());
            }
            minterms.push(Care {
                minterm: &row.minterm,
                free: row.free.as_ref(),
            });
        }
        let mut number = |minterm: &'a Minterm| {
            *numbers.entry(minterm).or_insert_with(|| {
                minterms.push(Care {
                    minterm,
                    free: None,
                });
                minterms.len() - 1
            })
        };
        let mut starts: Vec<usize> = policy.starts.iter().map(|(m, _)| number(m)).collect();
        let mut recorded: BTreeMap<usize, Vec<Record>> = BTreeMap::new();
        match follow {
            Follow::Recorded => {
                for (i, t) in policy.transitions.iter().enumerate() {
                    let from = number(&t.from);
                    let to = t.to.as_ref().map(&mut number);
                    let record = (t.behavior, t.status, to, i);
                    recorded.entry(from).or_default().push(record);
                }
            }
            Follow::Consistent if starts.is_empty() => starts = (0..policy.rows.len()).collect(),
            Follow::Consistent => {}
        }
        let mut world = Self {
            follow,
            history: policy.history,
            atoms: &policy.atoms,
            rows: policy.rows.len(),
            minterms,
            recorded,
            starts,
            kinds: Vec::new(),
            showing: RefCell::default(),
        };
        let kinds = policy.atoms.iter().filter(|atom| world.remembers(**atom));
        world.kinds = kinds.filter_map(|atom| termination(*atom)).collect();
        world
    }

    /// Whether the window would remember what this atom asks.
    pub(super) fn remembers(&self, atom: Atom) -> bool {
        remembers(self.history, atom)
    }

    /// The minterm in which a tick finds the environment, and where it stands then.
    pub(super) fn find(&self, place: &Place, oracle: &mut Oracle) -> Option<(usize, Place)> {
        match (self.follow, place) {
            (_, Place::At(minterm)) => Some((*minterm, place.clone())),
            (_, Place::Window(window)) => {
                let minterm = pick(&self.showing(window, false), oracle)?;
                Some((minterm, place.clone()))
            }
            (Follow::Recorded, Place::Start) => {
                let start = pick(&self.starts, oracle)?;
                Some((start, Place::At(start)))
            }
            (Follow::Consistent, Place::Start) => {
                let window = self.any_window(oracle);
                let start = pick(&self.showing(&window, true), oracle)?;
                Some((start, Place::Window(window)))
            }
        }
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
        let kept = match status {
            Status::Success => self.history.success,
            Status::Failure => self.history.failure,
            Status::Running => false,
        };
        if kept && !window.is_empty() {
            window.remove(0);
            let termination = (behavior, status);
            window.push(self.kinds.contains(&termination).then_some(termination));
        }
    }

    fn any_window(&self, oracle: &mut Oracle) -> Window {
        let length = match self.kinds.is_empty() {
            true => 0,
            false => self.history.window,
        };
        let mut any = || oracle.choose(self.kinds.len() + 1).checked_sub(1);
        (0..length)
            .map(|_| any().and_then(|kind| self.kinds.get(kind).copied()))
            .collect()
    }

    /// The minterms, or only the starts, whose history atoms are those of a window.
    fn showing(&self, window: &[Termination], starts: bool) -> Rc<[usize]> {
        let shown = |atom: &Atom| self.remembers(*atom) && in_window(window, *atom);
        let key = (starts, Minterm::new(self.atoms.iter().map(shown)));
        let mut showing = self.showing.borrow_mut();
        if let Some(found) = showing.get(&key) {
            return Rc::clone(found);
        }
        let remembered = Minterm::new(self.atoms.iter().map(|atom| self.remembers(*atom)));
        let shows = |minterm: &usize| {
            let care = self.minterms.get(*minterm);
            care.is_some_and(|care| care.agrees(&key.1, &remembered))
        };
        let found: Rc<[usize]> = match starts {
            true => self.starts.iter().copied().filter(shows).collect(),
            false => (0..self.rows).filter(shows).collect(),
        };
        showing.insert(key, Rc::clone(&found));
        found
    }
}

impl Care<'_> {
    /// Whether it has the values of `other` in the atoms of `among`.
    fn agrees(&self, other: &Minterm, among: &Minterm) -> bool {
        let pairs = self.minterm.words().iter().zip(other.words());
        pairs
            .zip(among.words())
            .enumerate()
            .all(|(i, ((a, b), among))| {
                let free = self.free.and_then(|free| free.words().get(i));
                (a ^ b) & among & !free.copied().unwrap_or(0) == 0
            })
    }
}

/// The termination that a history atom asks for.
pub(super) fn termination(atom: Atom) -> Termination {
    match atom {
        Atom::Predicate(_) => None,
        Atom::Done(behavior) => Some((behavior, Status::Success)),
        Atom::Failed(behavior) => Some((behavior, Status::Failure)),
    }
}

/// Whether a window remembers what an atom asks.
pub(super) fn remembers(history: History, atom: Atom) -> bool {
    match atom {
        Atom::Predicate(_) => false,
        Atom::Done(_) => history.window > 0 && history.success,
        Atom::Failed(_) => history.window > 0 && history.failure,
    }
}

/// Whether a window makes a history atom true.
pub(super) fn in_window(window: &[Termination], atom: Atom) -> bool {
    let asked = termination(atom);
    asked.is_some() && window.contains(&asked)
}

/// Any of the three.
pub(super) fn any_status(oracle: &mut Oracle) -> Status {
    match oracle.choose(3) {
        0 => Status::Running,
        1 => Status::Success,
        _ => Status::Failure,
    }
}

fn pick(among: &[usize], oracle: &mut Oracle) -> Option<usize> {
    let length = among.len();
    (length > 0)
        .then(|| oracle.choose(length))
        .and_then(|i| among.get(i).copied())
}
