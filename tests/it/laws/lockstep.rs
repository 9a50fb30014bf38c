//! Two trees side by side: every state that they reach together, by plain enumeration.

use super::naive::{Memory, holds, tick};
use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::task::History;
use btc::ir::tree::{Atom, Node, Status};
use btc::policy::Minterm;
use btc::tree::atoms::{atoms, behaviors};
use btc::tree::equivalence::{Parted, Trace};
use std::collections::{BTreeMap, BTreeSet};

pub(crate) fn asked(left: &Node, right: &Node) -> Vec<Atom> {
    atoms(left).union(&atoms(right)).copied().collect()
}

/// What the window remembers.
fn kept(history: History, status: Status) -> bool {
    match status {
        Status::Success => history.success,
        Status::Failure => history.failure,
        Status::Running => false,
    }
}

/// The last terminations, full from the start; what nobody asks for is a termination of behaviour 99.
pub(crate) type Window = Vec<(usize, Status)>;

pub(crate) const NOBODY: (usize, Status) = (99, Status::Success);

fn windows(atoms: &[Atom], history: History) -> Vec<Window> {
    let kinds: Vec<(usize, Status)> = atoms
        .iter()
        .filter_map(|atom| match atom {
            Atom::Done(b) => Some((b.index(), Status::Success)),
            Atom::Failed(b) => Some((b.index(), Status::Failure)),
            Atom::Predicate(_) => None,
        })
        .filter(|(_, status)| kept(history, *status))
        .chain([NOBODY])
        .collect();
    let mut all = vec![Window::new()];
    for _ in 0..history.window {
        let longer = |window: &Window| -> Vec<Window> {
            let one = |kind: &(usize, Status)| [window.clone(), vec![*kind]].concat();
            kinds.iter().map(one).collect()
        };
        all = all.iter().flat_map(longer).collect();
    }
    all
}

/// The valuations that a window allows.
fn valuations(atoms: &[Atom], window: &Window) -> Vec<Minterm> {
    let predicates = atoms
        .iter()
        .filter(|a| matches!(a, Atom::Predicate(_)))
        .count();
    let of = |bits: usize| {
        let mut bit = predicates;
        Minterm::new(atoms.iter().map(|atom| match atom {
            Atom::Predicate(_) => {
                bit -= 1;
                bits >> bit & 1 == 1
            }
            Atom::Done(b) => window.contains(&(b.index(), Status::Success)),
            Atom::Failed(b) => window.contains(&(b.index(), Status::Failure)),
        }))
    };
    (0..1 << predicates).map(of).collect()
}

/// Every assignment of a status to each of the behaviours.
fn assignments(behaviors: &BTreeSet<Id<Behavior>>) -> Vec<BTreeMap<Id<Behavior>, Status>> {
    let mut all = vec![BTreeMap::new()];
    for behavior in behaviors {
        let with = |statuses: &BTreeMap<Id<Behavior>, Status>| {
            [Status::Running, Status::Success, Status::Failure].map(|status| {
                let mut statuses = statuses.clone();
                statuses.insert(*behavior, status);
                statuses
            })
        };
        all = all.iter().flat_map(with).collect();
    }
    all
}

/// Both memories and a window, with one tick from there.
pub(crate) struct Lockstep<'a> {
    pub(crate) sides: [&'a Node; 2],
    pub(crate) atoms: Vec<Atom>,
    pub(crate) history: History,
    pub(crate) statuses: Vec<BTreeMap<Id<Behavior>, Status>>,
}

pub(crate) type State = (Memory, Memory, Window);

/// What each side selects, how the left one's selection ends, and what comes then.
pub(crate) struct Ticked {
    pub(crate) selected: [Option<Id<Behavior>>; 2],
    /// What each side ticks after that, each behaviour once.
    then: [Vec<Id<Behavior>>; 2],
    status: Status,
    /// What each behaviour answers.
    statuses: BTreeMap<Id<Behavior>, Status>,
    to: State,
}

impl<'a> Lockstep<'a> {
    pub(crate) fn new(left: &'a Node, right: &'a Node, history: History) -> Self {
        let all = behaviors(left).union(&behaviors(right)).copied().collect();
        Self {
            sides: [left, right],
            atoms: asked(left, right),
            history,
            statuses: assignments(&all),
        }
    }

    fn starts(&self) -> BTreeSet<State> {
        let windows = windows(&self.atoms, self.history).into_iter();
        windows.map(|w| (Memory::new(), Memory::new(), w)).collect()
    }

    /// What both select, and where that leads by each assignment of statuses.
    pub(crate) fn ticks(&self, state: &State, minterm: &Minterm) -> Vec<Ticked> {
        let holds = holds(&self.atoms, minterm);
        let (left, right, window) = state;
        let one = |statuses: &BTreeMap<Id<Behavior>, Status>| {
            let [l, r] = [(self.sides[0], left), (self.sides[1], right)]
                .map(|(root, memory)| tick(root, memory, &holds, &mut |b| statuses[&b]));
            let selected = [&l, &r].map(|t| t.ticked.first().copied());
            let then = [&l, &r].map(|t| {
                let mut others: Vec<Id<Behavior>> = Vec::new();
                for b in &t.ticked {
                    if t.ticked.first() != Some(b) && !others.contains(b) {
                        others.push(*b);
                    }
                }
                others
            });
            let status = selected[0].map_or(Status::Running, |b| statuses[&b]);
            let mut window = window.clone();
            if let Some(b) = selected[0]
                && kept(self.history, status)
                && self.history.window > 0
            {
                window.remove(0);
                let asked = match status {
                    Status::Success => Atom::Done(b),
                    _ => Atom::Failed(b),
                };
                let known = self.atoms.contains(&asked);
                window.push(if known { (b.index(), status) } else { NOBODY });
            }
            Ticked {
                selected,
                then,
                status,
                statuses: statuses.clone(),
                to: (l.memory, r.memory, window),
            }
        };
        self.statuses.iter().map(one).collect()
    }

    /// How many ticks the sides agree for on the shortest way apart, with the least valuation in which they part at
    /// once; `None` if they never do. Gives up beyond `most` states.
    pub(crate) fn parts(&self, most: usize) -> Option<Option<(usize, Option<Minterm>)>> {
        let mut known = self.starts();
        let mut layer: Vec<State> = known.iter().cloned().collect();
        let mut depth = 0;
        while !layer.is_empty() {
            let mut next = vec![];
            let mut least: Option<Minterm> = None;
            for state in &layer {
                for minterm in valuations(&self.atoms, &state.2) {
                    for Ticked { selected, to, .. } in self.ticks(state, &minterm) {
                        if selected[0] != selected[1] {
                            least = Some(least.map_or(minterm.clone(), |m| m.min(minterm.clone())));
                        } else if known.insert(to.clone()) {
                            next.push(to);
                        }
                    }
                }
            }
            if least.is_some() {
                return Some(Some((depth, least.filter(|_| depth == 0))));
            }
            if known.len() > most {
                return None;
            }
            layer = next;
            depth += 1;
        }
        Some(None)
    }

    /// How many ticks there are on the shortest way to one in which both sides, which never part, go on differently: another
    /// behaviour comes next, or others are ticked at all.
    pub(crate) fn goes_on_differently(&self) -> Option<usize> {
        let mut known = self.starts();
        let mut layer: Vec<State> = known.iter().cloned().collect();
        for depth in 0.. {
            let mut next = vec![];
            for state in &layer {
                for minterm in valuations(&self.atoms, &state.2) {
                    for ticked in self.ticks(state, &minterm) {
                        let [left, right] = &ticked.then;
                        let all = [left, right].map(|then| then.iter().collect::<BTreeSet<_>>());
                        if left.first() != right.first() || all[0] != all[1] {
                            return Some(depth);
                        } else if known.insert(ticked.to.clone()) {
                            next.push(ticked.to);
                        }
                    }
                }
            }
            if next.is_empty() {
                return None;
            }
            layer = next;
        }
        None
    }

    /// Replays a trace: each step is one that both can take, and in the last tick they part as it says.
    pub(crate) fn replay(&self, trace: &Trace) {
        let last = self.last(trace);
        let parts = |ticked: &Ticked| ticked.selected == [trace.left, trace.right];
        assert!(
            last.iter().any(parts) && trace.left != trace.right,
            "{trace:?}"
        );
    }

    /// Replays a trace that ends where both sides go on differently.
    pub(crate) fn replay_onward(&self, Parted { ended, trace }: &Parted) {
        let last = self.last(trace);
        let parts = |ticked: &Ticked| {
            let [left, right] = [0, 1].map(|side| {
                let selected = ticked.selected[side].iter();
                let all: Vec<Id<Behavior>> = selected.chain(&ticked.then[side]).copied().collect();
                let alike = ended.iter().zip(&all).all(|((b, _), other)| b == other);
                alike.then(|| all.get(ended.len()).copied())
            });
            ended
                .iter()
                .all(|(b, status)| ticked.statuses[b] == *status)
                && [left, right] == [Some(trace.left), Some(trace.right)]
        };
        assert!(
            last.iter().any(parts) && trace.left != trace.right,
            "{trace:?}"
        );
    }

    /// Every way in which the last tick of a trace can go, behind its steps.
    fn last(&self, trace: &Trace) -> Vec<Ticked> {
        assert_eq!(trace.atoms, self.atoms);
        let ticks = |states: &BTreeSet<State>, valuation: &Minterm| -> Vec<Ticked> {
            let there = |state: &&State| valuations(&self.atoms, &state.2).contains(valuation);
            let states = states.iter().filter(there);
            states
                .flat_map(|state| self.ticks(state, valuation))
                .collect()
        };
        let mut states = self.starts();
        for step in &trace.steps {
            states = ticks(&states, &step.valuation)
                .into_iter()
                .filter(|ticked| {
                    ticked.selected == [step.behavior; 2] && ticked.status == step.status
                })
                .map(|ticked| ticked.to)
                .collect();
        }
        ticks(&states, &trace.valuation)
    }
}
