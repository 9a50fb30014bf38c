//! `btc run --trace`: episodes line by line.

use super::load::Loaded;
use super::record;
use super::refused::Refused;
use super::run::Subject;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::learn::process::Earned;
use crate::learn::simulated::Purpose;
use crate::report::trace::{Found, Line, Trace};
use crate::world::{Simulation, Start};
use std::ops::Range;

/// How fine a trace is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// A line for each decision, and for each change of the behaviour that drives within one.
    Decision,
    /// A line for each tick.
    Tick,
}

/// Traces episodes of a seed, which [`run`](super::run::run) plays as well.
///
/// # Errors
/// As [`run`](super::run::run).
pub fn trace(
    loaded: &Loaded,
    subject: &Subject,
    episodes: Range<u64>,
    seed: u64,
    step: Step,
) -> Result<Trace, Refused> {
    let program = &loaded.program;
    let id = subject.task(loaded)?;
    let task = &program.tasks[id];
    let patience = task.patience.unwrap_or(u64::MAX);
    let mut trace = Trace::new(program, task);
    for episode in episodes {
        let start = Start {
            episode,
            ..Purpose::Run.start(seed, task.end_after)
        };
        let mut found: Option<Found> = None;
        let mut line: Option<Line> = None;
        let (mut earned, mut since) = (Earned::default(), 0);
        record::watch(loaded, subject, start, &mut |atoms, simulation, done| {
            trace.asks(program, atoms);
            if let (Some(done), Some(before)) = (done, &found) {
                let tick = done.tick;
                since += 1;
                let due = tick.terminated
                    || tick.changed
                    || tick.closed
                    || tick.end.is_some()
                    || since >= patience;
                let reward = earned.after(&tick, due);
                // Where the tree drives on by another behaviour, no decision is due, and the trace tells of both.
                let driver = |of: Option<(Id<Behavior>, Status)>| of.map(|(behavior, _)| behavior);
                if line
                    .as_ref()
                    .is_some_and(|line| driver(line.behavior) != driver(done.behavior))
                {
                    trace.lines.extend(line.take());
                }
                let current = line.get_or_insert_with(|| Line::new(episode, before.clone()));
                current.ticks += 1;
                current.behavior = done.behavior;
                current.beside = done.beside;
                current.reward = reward;
                current.events.extend(simulation.fired());
                current.end = tick.end;
                if due {
                    since = 0;
                }
                if due || step == Step::Tick {
                    trace.lines.extend(line.take());
                }
            }
            found = Some(found_in(simulation, loaded));
            true
        })?;
    }
    Ok(trace)
}

/// The world as the simulation shows it.
fn found_in(simulation: &Simulation, loaded: &Loaded) -> Found {
    let pose = simulation.pose();
    let states = loaded.program.states.ids();
    Found {
        tick: simulation.ticks(),
        position: pose.position,
        heading: pose.heading,
        others: simulation
            .others()
            .map(|pose| (pose.position, pose.heading))
            .collect(),
        states: states.map(|id| simulation.state(id)).collect(),
        atoms: simulation.atoms(),
    }
}
