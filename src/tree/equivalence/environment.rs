//! What a recorded environment may do next.

use super::oracle::Oracle;
use super::window::{Termination, Window, enter, shows};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Exclusion, Status};
use crate::logic::minterm::agree;
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
    /// Any valuation that is consistent with the history window and in which nothing holds together that is excluded.
    Possible(History, &'a [Exclusion]),
}

/// Which transitions a table allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Follow {
    /// Those that it records.
    Recorded,
    /// Those to any of its minterms that the history window allows.
    Consistent,
}

/// Where the environment stands.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Place {
    /// In a minterm of the table.
    At(usize),
    /// Where the window holds these terminations.
    Window(Window),
}

/// A minterm of the table, or a cube of it.
#[derive(Clone, Debug)]
pub(super) struct TableCube<'a> {
    pub(super) minterm: &'a Minterm,
    /// The atoms that may have either value.
    pub(super) free: Option<&'a Minterm>,
}

/// An environment that a table gives: its atoms, its minterms, what may follow.
pub(super) struct TableEnvironment<'a> {
    follow: Follow,
    history: History,
    pub(super) atoms: &'a [Atom],
    /// The rows of the table, then what else it mentions.
    pub(super) minterms: Vec<TableCube<'a>>,
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

/// What comes of a tick.
pub(super) struct Consequence {
    pub(super) status: Status,
    /// Where the environment stands then; `None` if nothing follows.
    pub(super) next: Option<Place>,
    /// The transition that was taken.
    pub(super) transition: Option<usize>,
    /// The environment says nothing of what follows.
    pub(super) open: bool,
}

impl<'a> TableEnvironment<'a> {
    pub(super) fn new(policy: &'a Policy, follow: Follow) -> Self {
        let mut minterms: Vec<TableCube> = Vec::new();
        let mut numbers: BTreeMap<&Minterm, usize> = BTreeMap::new();
        for row in &policy.rows {
            if row.free.is_none() {
                numbers.insert(&row.minterm, minterms.len());
            }
            minterms.push(TableCube {
                minterm: &row.minterm,
                free: row.free.as_ref(),
            });
        }
        let mut number = |minterm: &'a Minterm| {
            *numbers.entry(minterm).or_insert_with(|| {
                minterms.push(TableCube {
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
        let mut environment = Self {
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
        let kinds = policy
            .atoms
            .iter()
            .filter(|atom| environment.remembers(**atom));
        environment.kinds = kinds.filter_map(|atom| atom.termination()).collect();
        environment
    }

    /// Whether the window would remember what this atom asks.
    pub(super) fn remembers(&self, atom: Atom) -> bool {
        self.history.remembers(atom)
    }

    /// The minterm in which a tick finds the environment, and where it stands then; before the first tick it is nowhere.
    pub(super) fn find(
        &self,
        place: Option<&Place>,
        oracle: &mut Oracle,
    ) -> Option<(usize, Place)> {
        match (self.follow, place) {
            (_, Some(Place::At(minterm))) => Some((*minterm, Place::At(*minterm))),
            (_, Some(Place::Window(window))) => {
                let minterm = oracle.pick(&self.showing(window, false))?;
                Some((minterm, Place::Window(window.clone())))
            }
            (Follow::Recorded, None) => {
                let start = oracle.pick(&self.starts)?;
                Some((start, Place::At(start)))
            }
            (Follow::Consistent, None) => {
                let window = self.any_window(oracle);
                let start = oracle.pick(&self.showing(&window, true))?;
                Some((start, Place::Window(window)))
            }
        }
    }

    /// What may come of a tick in which this is selected.
    pub(super) fn consequence(
        &self,
        place: &Place,
        selected: Option<Id<Behavior>>,
        oracle: &mut Oracle,
    ) -> Consequence {
        match place {
            Place::At(minterm) => self.recorded(*minterm, selected, oracle),
            Place::Window(window) => {
                let mut window = window.clone();
                let mut status = Status::Running;
                if let Some(behavior) = selected {
                    status = oracle.status();
                    if self.history.keeps(status) {
                        let termination = (behavior, status);
                        let asked = self.kinds.contains(&termination);
                        enter(&mut window, asked.then_some(termination));
                    }
                }
                Consequence {
                    status,
                    next: Some(Place::Window(window)),
                    transition: None,
                    open: false,
                }
            }
        }
    }

    fn recorded(
        &self,
        minterm: usize,
        selected: Option<Id<Behavior>>,
        oracle: &mut Oracle,
    ) -> Consequence {
        let records: Vec<&Record> = self
            .recorded
            .get(&minterm)
            .into_iter()
            .flatten()
            .filter(|record| Some(record.0) == selected)
            .collect();
        let stays = Consequence {
            status: Status::Running,
            next: Some(Place::At(minterm)),
            transition: None,
            open: records.is_empty(),
        };
        let choice = oracle.choose(records.len() + 1);
        match choice.checked_sub(1).and_then(|i| records.get(i)) {
            None => stays,
            Some((_, status, next, transition)) => Consequence {
                status: *status,
                next: next.map(Place::At),
                transition: Some(*transition),
                open: false,
            },
        }
    }

    fn any_window(&self, oracle: &mut Oracle) -> Window {
        let mut any = || oracle.choose(self.kinds.len() + 1).checked_sub(1);
        (0..self.history.length(&self.kinds))
            .map(|_| any().and_then(|kind| self.kinds.get(kind).copied()))
            .collect()
    }

    /// The minterms, or only the starts, whose history atoms are those of a window.
    fn showing(&self, window: &[Termination], starts: bool) -> Rc<[usize]> {
        let shown = |atom: &Atom| self.remembers(*atom) && shows(window, *atom);
        let key = (starts, Minterm::new(self.atoms.iter().map(shown)));
        let mut showing = self.showing.borrow_mut();
        if let Some(found) = showing.get(&key) {
            return Rc::clone(found);
        }
        let remembered = Minterm::new(self.atoms.iter().map(|atom| self.remembers(*atom)));
        let shows = |minterm: &usize| {
            let cube = self.minterms.get(*minterm);
            cube.is_some_and(|cube| cube.agrees(&key.1, &remembered))
        };
        let found: Rc<[usize]> = match starts {
            true => self.starts.iter().copied().filter(shows).collect(),
            false => (0..self.rows).filter(shows).collect(),
        };
        showing.insert(key, Rc::clone(&found));
        found
    }
}

impl TableCube<'_> {
    /// Whether it has the values of `other` in the atoms of `among`.
    fn agrees(&self, other: &Minterm, among: &Minterm) -> bool {
        let free = self.free.into_iter().flat_map(Minterm::words).copied();
        let free = free.chain(std::iter::repeat(0));
        let ignored = among.words().iter().zip(free);
        let ignored = ignored.map(|(among, free)| !among | free);
        agree(self.minterm.words(), other.words(), ignored)
    }
}
