//! Tick by tick.

use super::body::Body;
use super::build::Simulator;
use super::door::Door;
use super::ending::NOT_QUIET;
use super::history::History;
use super::motion::Command;
use super::pose::Pose;
use super::scene::Scene;
use super::script::Other;
use crate::eval::{Fixed, Register, Registers, run, status};
use crate::geometry::{Circle, Point};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::program::{Event, State};
use crate::ir::tree::Status;
use serde::{Deserialize, Serialize};

/// Why an episode ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
    /// What this tick pays whether or not a transition ends with it.
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
    pub(super) until: u64,
    /// The tick in which it started.
    pub(super) since: u64,
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
    /// The other robots.
    pub(super) others: Vec<Other<'a>>,
    /// All robots where they stand, the acting one first; kept so that nothing is allocated in a tick.
    pub(super) robots: Vec<Circle>,
    /// The terminations of other robots' behaviours in this tick.
    pub(super) elsewhere: Vec<(Id<Behavior>, Status)>,
    /// The behaviours of which it is asked whether they run, with their registers.
    pub(super) watched: Vec<(Id<Behavior>, Register)>,
    /// The obstacles as they stand now; where no wall may open, nothing is kept here.
    pub(super) scene: Option<Box<Scene>>,
    pub(super) counts: Vec<u64>,
    pub(super) atoms: u128,
    pub(super) slack: f64,
    /// The registers of the lines of sight to fixed points.
    pub(super) sights: Vec<Register>,
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
            body: Body::new(
                &simulator.around,
                &simulator.probes,
                simulator.radius,
                simulator.events,
            ),
            history: History::new(simulator.history),
            instances: vec![Instance::default(); behaviors],
            terminations: Vec::with_capacity(2 * behaviors),
            others: simulator
                .others
                .iter()
                .map(|script| Other {
                    script,
                    body: Body::new(&simulator.around, &script.probes, script.radius, 0),
                    runner: script.runner.clone(),
                    touching: 0.0,
                    slack: 0.0,
                    sights: vec![0.0; simulator.layout.sights().len()],
                    command: Command::default(),
                    atoms: 0,
                })
                .collect(),
            robots: Vec::new(),
            elsewhere: Vec::new(),
            watched: simulator.layout.running(),
            scene: (!simulator.doors.is_empty()).then(|| Box::new(simulator.around.scene.clone())),
            counts: vec![0; simulator.events],
            atoms: 0,
            slack: 0.0,
            sights: simulator.layout.sights(),
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
        self.registers.set(Fixed::Path.register(), self.body.path());
        self.publish_clear();
        self.body.moved();
    }

    /// Tells the code how far the nearest wall is, at least.
    #[inline]
    fn publish_clear(&mut self) {
        let clear = match self.slack > 0.0 {
            true => self.slack + self.simulator.radius,
            false => 0.0,
        };
        self.registers.set(Fixed::Clear.register(), clear);
    }

    /// Forgets what is remembered of distances and lines of sight, for every robot: nothing changes by it but the time.
    pub fn forget(&mut self) {
        self.slack = 0.0;
        self.publish_clear();
        self.forget_sights();
    }

    /// What was seen holds no more, for any robot.
    pub(super) fn forget_sights(&mut self) {
        self.body.was_put();
        self.registers.set(Fixed::Path.register(), 0.0);
        for &register in &self.sights {
            self.registers.set(register, 0.0);
        }
        for other in &mut self.others {
            other.body.was_put();
            other.slack = 0.0;
            other.sights.fill(0.0);
        }
    }

    /// Clears the terminations and events of the last tick.
    pub(super) fn clear_tick(&mut self) {
        let layout = &self.simulator.layout;
        for &(behavior, status) in &self.terminations {
            if let Some(register) = layout.ended(behavior, status) {
                self.registers.set(register, 0.0);
            }
        }
        for &(behavior, status) in &self.elsewhere {
            if let Some(register) = layout.ended(behavior, status) {
                self.registers.set(register, 0.0);
            }
        }
        self.terminations.clear();
        self.elsewhere.clear();
        for &event in &self.body.fired {
            self.registers.set(layout.event(Id::new(event.into())), 0.0);
        }
        self.body.fired.clear();
    }

    /// Begins a tick: its `each tick` effects (step 2). The atoms stay those of the tick before.
    #[inline]
    pub fn begin_tick(&mut self) {
        let elsewhere = !self.elsewhere.is_empty();
        if !self.terminations.is_empty() || elsewhere || !self.body.fired.is_empty() {
            self.clear_tick();
        }
        self.now += 1;
        self.rest();
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
        let status = tick_behavior(
            self.simulator,
            self.now,
            behavior,
            self.instances.get_mut(behavior.index()),
            &mut self.registers,
            &mut self.body,
        );
        if status != Status::Running {
            self.terminate(behavior, status);
        }
        status
    }

    #[cold]
    pub(super) fn terminate(&mut self, behavior: Id<Behavior>, status: Status) {
        if let Some(instance) = self.instances.get_mut(behavior.index()) {
            instance.until = 0;
        }
        if let Some(register) = self.simulator.layout.ended(behavior, status) {
            self.registers.set(register, 1.0);
        }
        self.terminations.push((behavior, status));
    }

    /// The wheels rest until they are told otherwise, and what was noise is none.
    #[inline(always)]
    pub(super) fn rest(&mut self) {
        for fixed in [Fixed::Speed, Fixed::Strafe, Fixed::Turn] {
            self.registers.set(fixed.register(), 0.0);
        }
        self.body.tick();
    }

    /// Ends a tick: the robot moves, then history, events, effects, predicates, end and reward (steps 4 to 8).
    ///
    /// Events, rewards and `end on` read the state before effects.
    #[inline]
    pub fn end_tick(&mut self) -> Tick {
        if !self.others.is_empty() {
            self.others_act();
        }
        self.go();
        if !self.others.is_empty() {
            self.others_go();
        }
        for &(behavior, register) in &self.watched {
            let runs = self.instances.get(behavior.index());
            let runs = runs.is_some_and(|instance| instance.until == self.now + 1);
            self.registers.set(register, f64::from(u8::from(runs)));
        }
        let unended = self.terminations.is_empty();
        for &(behavior, status) in &self.terminations {
            self.history.record(behavior, status, &self.simulator.atoms);
        }
        let quiet = unended && self.elsewhere.is_empty() && self.ends_quietly();
        self.outcome(quiet)
    }

    /// Whether nothing happens in this tick, in which nothing has ended; what then is to be done is done.
    #[inline]
    pub(super) fn ends_quietly(&mut self) -> bool {
        self.body.atoms = self.history.bits;
        let quiet = &self.simulator.compiled.quiet;
        run(quiet, &mut self.registers, &mut self.body) != NOT_QUIET
    }

    /// What the tick pays, whatever happens in it.
    #[inline]
    pub(super) fn flow(&self) -> f64 {
        match self.simulator.compiled.flow {
            Some(value) => value,
            None => self.registers.get(Fixed::Flow.register()),
        }
    }

    /// What the tick led to. `quiet`: nothing has happened, and the tick has ended so already.
    pub(super) fn outcome(&mut self, quiet: bool) -> Tick {
        let mut tick = Tick {
            changed: false,
            terminated: !self.terminations.is_empty(),
            closed: false,
            reward: 0.0,
            flow: 0.0,
            end: None,
            lost: false,
        };
        if quiet {
            tick.reward = match self.simulator.compiled.otherwise {
                Some(value) => value,
                None => self.registers.get(Fixed::Reward.register()),
            };
        } else {
            self.end_in_full(&mut tick);
        }
        if self.scene.is_some() {
            self.swing_doors();
        }
        if !self.others.is_empty() {
            self.others_look();
        }
        tick.flow = self.flow();
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
        let line = line.checked_sub(1);
        tick.end = line.map(End::On);
        let worth = line.and_then(|line| *self.simulator.compiled.worths.get(line)?);
        let paid = if tick.closed { tick.reward } else { 0.0 };
        tick.lost = line.is_some() && worth.unwrap_or(paid) < 0.0;
        for &event in &self.body.fired {
            if let Some(count) = self.counts.get_mut(usize::from(event)) {
                *count += 1;
            }
        }
    }

    /// Moves the robot by the commands of this tick.
    #[inline(always)]
    pub(super) fn go(&mut self) {
        let motion = &self.simulator.motion;
        let read = |fixed: Fixed| self.registers.get(fixed.register());
        let command = Command {
            speed: read(Fixed::Speed),
            strafe: read(Fixed::Strafe),
            turn: read(Fixed::Turn),
        };
        if self.body.clear > 0.0 {
            self.slack = self.slack.max(motion.slack(self.body.clear));
        }
        let before = self.body.pose.position;
        let (scene, bodies, random, pose) = self.body.moving();
        let touching = motion.step(scene, bodies, command, random, pose, &mut self.slack);
        self.registers
            .set(Fixed::Touching.register(), f64::from(u8::from(touching)));
        if command != Command::default() {
            self.body.came_from(before);
            self.publish_pose();
        }
    }

    /// Lets doors open and close by what holds now, then reads the predicates.
    #[cold]
    fn swing_doors(&mut self) {
        let atoms = self.body.atoms;
        let wanted = self.wanted_doors();
        let robots = self.robots();
        let doors = &self.simulator.doors;
        if let Some(scene) = &mut self.scene
            && Door::swing(doors, wanted, scene, &robots)
        {
            self.publish_scene();
        }
        self.body.atoms = atoms;
        let predicates = &self.simulator.compiled.predicates;
        run(predicates, &mut self.registers, &mut self.body);
    }

    /// Which doors are to stand, a bit each.
    pub(super) fn wanted_doors(&mut self) -> u128 {
        self.body.atoms = 0;
        let doors = &self.simulator.compiled.doors;
        run(doors, &mut self.registers, &mut self.body);
        self.body.atoms
    }

    /// Where all robots are, with their radii, the acting one first.
    pub(super) fn standing(&self) -> impl Iterator<Item = (Point, f64)> + '_ {
        let others = self.others.iter();
        let others = others.map(|other| (other.body.pose.position, other.script.radius));
        std::iter::once((self.body.pose.position, self.simulator.radius)).chain(others)
    }

    /// Where all robots are, with their radii.
    pub(super) fn robots(&self) -> Vec<(Point, f64)> {
        self.standing().collect()
    }

    /// Tells each robot what stands.
    pub(super) fn publish_scene(&mut self) {
        let scene = self.scene.as_deref();
        self.body.set_scene(scene);
        for other in &mut self.others {
            other.body.set_scene(scene);
        }
        self.forget();
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

    /// Where the other robots are, in the order of their declaration.
    pub fn others(&self) -> impl Iterator<Item = Pose> + '_ {
        self.others.iter().map(|other| other.body.pose)
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

/// Ticks a behaviour, in the registers and with the senses of its robot. A behaviour without a law fails.
#[inline(always)]
pub(super) fn tick_behavior(
    simulator: &Simulator,
    now: u64,
    behavior: Id<Behavior>,
    instance: Option<&mut Instance>,
    registers: &mut Registers,
    body: &mut Body<'_>,
) -> Status {
    let (Some(routine), Some(instance)) =
        (simulator.compiled.routines.get(behavior.index()), instance)
    else {
        return Status::Failure;
    };
    let starts = now > instance.until;
    if starts {
        instance.since = now;
    }
    instance.until = now + 1;
    if routine.timed {
        let elapsed = (now - instance.since) as f64 * simulator.tick;
        registers.set(Fixed::Elapsed.register(), elapsed);
    }
    if starts {
        run(&routine.begin, registers, body);
    }
    status(run(&routine.tick, registers, body))
}
