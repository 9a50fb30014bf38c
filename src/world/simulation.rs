//! Tick by tick.

use super::body::Body;
use super::build::Simulator;
use super::ending::NOT_QUIET;
use super::history::History;
use super::motion::Command;
use super::pose::Pose;
use crate::eval::{Fixed, Registers, run, status};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::program::{Event, State};
use crate::ir::tree::Status;

/// Why an episode ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// This line of the task's `end on`, counted from zero.
    On(usize),
    /// The limit of ticks.
    Cut,
}

/// What a tick led to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tick {
    /// Whether the minterm changed.
    pub changed: bool,
    /// Whether a behaviour terminated; see [`Simulation::terminations`].
    pub terminated: bool,
    /// Whether a rewarded event fired.
    pub closed: bool,
    /// The value of the first line of `reward` whose event fired, of `otherwise` if none did.
    pub reward: f64,
    /// What this tick pays whether or not a transition ends with it; the simulator pays transitions alone.
    pub flow: f64,
    /// Whether the episode ended.
    pub end: Option<End>,
    /// Whether it ended badly: an event with a negative reward ended it.
    pub lost: bool,
}

/// A running instance of a behaviour.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Instance {
    /// The last tick in which ticking it would resume it; later, it starts.
    until: u64,
    /// The tick in which it started.
    since: u64,
}

/// A run of a world. Nothing is allocated between episodes or ticks.
#[derive(Clone, Debug)]
pub struct Simulation<'a> {
    pub(super) simulator: &'a Simulator,
    pub(super) registers: Registers,
    pub(super) body: Body<'a>,
    pub(super) history: History,
    pub(super) instances: Vec<Instance>,
    pub(super) terminations: Vec<(Id<Behavior>, Status)>,
    pub(super) counts: Vec<u64>,
    pub(super) atoms: u128,
    pub(super) slack: f64,
    /// The number of the tick, from 1; 0 before the first.
    pub(super) now: u64,
    pub(super) limit: u64,
}

impl<'a> Simulation<'a> {
    pub(super) fn new(simulator: &'a Simulator) -> Self {
        let behaviors = simulator.compiled.routines.len();
        Self {
            simulator,
            registers: simulator.registers.clone(),
            body: Body::new(&simulator.around, simulator.events),
            history: History::new(simulator.history),
            instances: vec![Instance::default(); behaviors],
            terminations: Vec::with_capacity(2 * behaviors),
            counts: vec![0; simulator.events],
            atoms: 0,
            slack: 0.0,
            now: 0,
            limit: u64::MAX,
        }
    }

    #[inline]
    pub(super) fn publish_pose(&mut self) {
        let pose = &self.body.pose;
        self.registers.set(Fixed::X.register(), pose.position[0]);
        self.registers.set(Fixed::Y.register(), pose.position[1]);
        self.registers.set(Fixed::Heading.register(), pose.heading);
        self.body.moved();
    }

    /// Clears the terminations and events of the last tick.
    pub(super) fn clear_tick(&mut self) {
        let layout = &self.simulator.layout;
        for &(behavior, status) in &self.terminations {
            if let Some(register) = layout.ended(behavior, status) {
                self.registers.set(register, 0.0);
            }
        }
        self.terminations.clear();
        for &event in &self.body.fired {
            self.registers.set(layout.event(Id::new(event.into())), 0.0);
        }
        self.body.fired.clear();
    }

    /// Begins a tick: its `each tick` effects (step 2). The atoms stay those of the tick before.
    #[inline]
    pub fn begin_tick(&mut self) {
        if !self.terminations.is_empty() || !self.body.fired.is_empty() {
            self.clear_tick();
        }
        self.now += 1;
        for fixed in [Fixed::Speed, Fixed::Strafe, Fixed::Turn] {
            self.registers.set(fixed.register(), 0.0);
        }
        self.body.tick();
        run(
            &self.simulator.compiled.each_tick,
            &mut self.registers,
            &mut self.body,
        );
    }

    /// Ticks a behaviour (step 3). The robot moves at the end of the tick, so all that is ticked in one tick sees the
    /// same world; at most one may drive.
    ///
    /// A behaviour that was running in this tick or the tick before resumes; any other starts, with its variables
    /// set to their initial values. A termination ends the instance. A behaviour without a law fails.
    #[inline]
    pub fn act(&mut self, behavior: Id<Behavior>) -> Status {
        let (Some(routine), Some(instance)) = (
            self.simulator.compiled.routines.get(behavior.index()),
            self.instances.get_mut(behavior.index()),
        ) else {
            return Status::Failure;
        };
        let starts = self.now > instance.until;
        if starts {
            instance.since = self.now;
        }
        instance.until = self.now + 1;
        if routine.timed {
            let elapsed = (self.now - instance.since) as f64 * self.simulator.tick;
            self.registers.set(Fixed::Elapsed.register(), elapsed);
        }
        if starts {
            run(&routine.begin, &mut self.registers, &mut self.body);
        }
        let status = status(run(&routine.tick, &mut self.registers, &mut self.body));
        if status != Status::Running {
            self.terminate(behavior, status);
        }
        status
    }

    #[cold]
    fn terminate(&mut self, behavior: Id<Behavior>, status: Status) {
        if let Some(instance) = self.instances.get_mut(behavior.index()) {
            instance.until = 0;
        }
        if let Some(register) = self.simulator.layout.ended(behavior, status) {
            self.registers.set(register, 1.0);
        }
        self.terminations.push((behavior, status));
    }

    /// Ends a tick: the robot moves, then history, events, effects, predicates, end and reward (steps 4 to 8).
    ///
    /// Events, rewards and `end on` read the state before effects.
    #[inline]
    pub fn end_tick(&mut self) -> Tick {
        self.go();
        let quiet = self.terminations.is_empty();
        for &(behavior, status) in &self.terminations {
            self.history.record(behavior, status, &self.simulator.atoms);
        }
        let compiled = &self.simulator.compiled;
        self.body.atoms = self.history.bits;
        let mut tick = Tick {
            changed: false,
            terminated: !quiet,
            closed: false,
            reward: 0.0,
            flow: 0.0,
            end: None,
            lost: false,
        };
        if quiet && run(&compiled.quiet, &mut self.registers, &mut self.body) != NOT_QUIET {
            tick.reward = match compiled.otherwise {
                Some(value) => value,
                None => self.registers.get(Fixed::Reward.register()),
            };
        } else {
            self.end_in_full(&mut tick);
        }
        tick.changed = (self.atoms ^ self.body.atoms) & self.simulator.atoms.observed != 0;
        self.atoms = self.body.atoms;
        if tick.end.is_none() && self.now >= self.limit {
            tick.end = Some(End::Cut);
        }
        tick
    }

    #[cold]
    fn end_in_full(&mut self, tick: &mut Tick) {
        self.body.atoms = self.history.bits;
        run(
            &self.simulator.compiled.full,
            &mut self.registers,
            &mut self.body,
        );
        tick.closed = self.registers.get(Fixed::Closed.register()) != 0.0;
        tick.reward = self.registers.get(Fixed::Reward.register());
        let line = self.registers.get(Fixed::End.register()) as usize;
        tick.end = line.checked_sub(1).map(End::On);
        tick.lost = tick.end.is_some() && tick.closed && tick.reward < 0.0;
        for &event in &self.body.fired {
            if let Some(count) = self.counts.get_mut(usize::from(event)) {
                *count += 1;
            }
        }
    }

    /// Moves the robot by the commands of this tick.
    #[inline]
    fn go(&mut self) {
        let read = |fixed: Fixed| self.registers.get(fixed.register());
        let command = Command {
            speed: read(Fixed::Speed),
            strafe: read(Fixed::Strafe),
            turn: read(Fixed::Turn),
        };
        let touching = self.simulator.motion.step(
            &self.simulator.around.scene,
            command,
            &mut self.body.random,
            &mut self.body.pose,
            &mut self.slack,
        );
        self.registers
            .set(Fixed::Touching.register(), f64::from(u8::from(touching)));
        if command != Command::default() {
            self.publish_pose();
        }
    }

    /// The minterm: a bit for each atom of the task, see [`Simulator::atoms`].
    #[inline]
    pub fn key(&self) -> u128 {
        self.atoms & self.simulator.atoms.observed
    }

    /// Every atom, those asked for in addition included, as the last tick left them.
    #[inline]
    pub fn atoms(&self) -> u128 {
        self.atoms
    }

    /// The history window, the newest termination first.
    pub fn window(&self) -> &[(Id<Behavior>, Status)] {
        self.history.entries()
    }

    /// The terminations of this tick, in order.
    pub fn terminations(&self) -> &[(Id<Behavior>, Status)] {
        &self.terminations
    }

    /// The events of the last tick, in order of declaration.
    pub fn fired(&self) -> impl Iterator<Item = Id<Event>> + '_ {
        self.body.fired.iter().map(|&event| Id::new(event.into()))
    }

    /// How often each event has happened in this episode.
    pub fn counts(&self) -> &[u64] {
        &self.counts
    }

    /// How many ticks of the episode have begun.
    pub fn ticks(&self) -> u64 {
        self.now
    }

    /// Where the robot is.
    pub fn pose(&self) -> Pose {
        self.body.pose
    }

    /// The value of a state variable.
    pub fn state(&self, id: Id<State>) -> f64 {
        self.registers.get(self.simulator.layout.state(id))
    }

    /// Whether the last commanded motion was blocked.
    pub fn is_touching(&self) -> bool {
        self.registers.get(Fixed::Touching.register()) != 0.0
    }
}
