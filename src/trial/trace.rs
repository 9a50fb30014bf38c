//! What a tree met and did in an episode, so that another tree can be compared with it without simulation.
//!
//! A simulation depends on the tree through the behaviours that it ticks and on nothing else. A tree that ticks the same
//! behaviours all along a trace therefore plays the same episode.

use super::play::Ticked;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::learn::episode::Controller;
use crate::learn::process::Process;
use crate::tree::Runner;
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// The behaviours that one tick ticked, with their answers.
type Calls = Vec<(Id<Behavior>, Status)>;

/// Ticks in a row with one valuation, the same behaviours and the same answers.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Met {
    atoms: u128,
    calls: Calls,
}

/// An episode as a tree met it.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    met: Vec<(Met, u64)>,
}

impl Trace {
    /// The ticks in which a behaviour was ticked and did not fail.
    pub fn driven(&self, behavior: Id<Behavior>) -> u64 {
        let drives = |met: &Met| {
            let mut calls = met.calls.iter();
            calls.any(|(id, status)| *id == behavior && *status != Status::Failure)
        };
        let met = self.met.iter().filter(|(met, _)| drives(met));
        met.map(|(_, ticks)| ticks).sum()
    }
}

/// A tree that is recorded.
#[derive(Clone, Debug)]
pub struct Recorded {
    runner: Ticked,
    trace: Trace,
    now: Calls,
}

impl Recorded {
    /// A tree that has not been ticked.
    pub fn new(runner: Runner) -> Self {
        Self {
            runner: Ticked(runner),
            trace: Trace::default(),
            now: Vec::new(),
        }
    }

    /// What was met since the last reset.
    pub fn into_trace(self) -> Trace {
        self.trace
    }
}

impl Controller for Recorded {
    fn reset(&mut self) {
        self.runner.reset();
        self.trace.met.clear();
    }

    fn tick(&mut self, process: &mut impl Process) {
        let atoms = process.atoms();
        self.now.clear();
        let now = &mut self.now;
        self.runner
            .tick_noting(process, |behavior, status| now.push((behavior, status)));
        self.note(atoms);
    }

    fn steady(&mut self, process: &impl Process) -> Option<Id<Behavior>> {
        let atoms = process.atoms();
        let behavior = self.runner.steady(process)?;
        // Ticks that are only counted are those of the last entry.
        let (met, _) = self.trace.met.last()?;
        (met.atoms == atoms && *met.calls == [(behavior, Status::Running)]).then_some(behavior)
    }

    fn passed(&mut self, ticks: u64) {
        if let Some((_, times)) = self.trace.met.last_mut() {
            *times += ticks;
        }
    }

    fn answered(&mut self, process: &mut impl Process, behavior: Id<Behavior>, status: Status) {
        let atoms = process.atoms();
        self.now.clear();
        self.now.push((behavior, status));
        let now = &mut self.now;
        self.runner
            .answered_noting(process, status, |behavior, status| {
                now.push((behavior, status));
            });
        self.note(atoms);
    }
}

impl Recorded {
    /// Notes a tick with the behaviours that it ticked.
    fn note(&mut self, atoms: u128) {
        match self.trace.met.last_mut() {
            Some((met, times)) if met.atoms == atoms && met.calls == self.now => *times += 1,
            _ => {
                let calls = self.now.clone();
                self.trace.met.push((Met { atoms, calls }, 1));
            }
        }
    }
}

/// Whether the tree ticks these behaviours in this tick.
fn agrees(runner: &mut Runner, met: &Met) -> bool {
    let mut calls = met.calls.iter();
    let mut same = true;
    runner.tick_key(met.atoms, |behavior| match calls.next() {
        Some((expected, status)) if *expected == behavior => *status,
        _ => {
            same = false;
            Status::Running
        }
    });
    same && calls.next().is_none()
}

impl Trace {
    /// Whether a tree, its memory fresh, ticks the same behaviours all along.
    pub fn replays(&self, runner: &mut Runner) -> bool {
        runner.reset();
        self.met.iter().all(|(met, times)| {
            for _ in 0..*times {
                let before = runner.memory().to_vec();
                if !agrees(runner, met) {
                    return false;
                }
                if runner.memory() == before {
                    break;
                }
            }
            true
        })
    }
}

/// Every tick that the episodes of a tree had, each with those that followed it.
///
/// A tree that agrees on every path through it agrees with every episode; one that does not may still do so.
#[derive(Clone, Debug, Default)]
pub struct Paths {
    met: Vec<Met>,
    next: Vec<BTreeSet<usize>>,
    starts: BTreeSet<usize>,
}

/// The most ticks of a comparison.
const EFFORT: usize = 20_000;

impl Paths {
    /// The paths of these episodes.
    pub fn of<'t>(traces: impl Iterator<Item = &'t Trace>) -> Self {
        let mut paths = Self::default();
        let mut known: FxHashMap<Met, usize> = FxHashMap::default();
        for trace in traces {
            let mut last = None;
            for (met, times) in &trace.met {
                let at = *known.entry(met.clone()).or_insert_with(|| {
                    paths.met.push(met.clone());
                    paths.next.push(BTreeSet::new());
                    paths.met.len() - 1
                });
                let from = match last {
                    None => Some(&mut paths.starts),
                    Some(last) => paths.next.get_mut(last),
                };
                from.into_iter().for_each(|next| {
                    next.insert(at);
                });
                if let (Some(next), true) = (paths.next.get_mut(at), *times > 1) {
                    next.insert(at);
                }
                last = Some(at);
            }
        }
        paths
    }

    /// Whether a tree ticks the same behaviours on every path.
    pub fn replay(&self, runner: &mut Runner) -> bool {
        runner.reset();
        let fresh = runner.memory().to_vec();
        let mut open: Vec<(usize, Vec<u64>)> =
            self.starts.iter().map(|at| (*at, fresh.clone())).collect();
        let mut seen: BTreeSet<(usize, Vec<u64>)> = open.iter().cloned().collect();
        let mut ticks = 0;
        while let Some((at, memory)) = open.pop() {
            let (Some(met), Some(next)) = (self.met.get(at), self.next.get(at)) else {
                continue;
            };
            ticks += 1;
            runner.resume(&memory);
            if ticks > EFFORT || !agrees(runner, met) {
                return false;
            }
            for to in next {
                let state = (*to, runner.memory().to_vec());
                if !seen.contains(&state) {
                    seen.insert(state.clone());
                    open.push(state);
                }
            }
        }
        true
    }
}
