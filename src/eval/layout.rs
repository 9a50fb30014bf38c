//! Which register holds what.

use super::code::Register;
use super::compiler::TooLarge;
use super::machine::{REGISTERS, Registers};
use crate::ir::expr::Pose;
use crate::ir::law::Behavior;
use crate::ir::program::{Event, State};
use crate::ir::tree::Status;
use crate::ir::world::{Robot, Sensor, Wall};
use crate::ir::{Expr, Id, Program};
use rustc_hash::FxHashMap;

/// The registers that every program has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u16)]
pub enum Fixed {
    /// The robot's x coordinate.
    X,
    /// The robot's y coordinate.
    Y,
    /// The robot's heading.
    Heading,
    /// Whether the last commanded motion was blocked.
    Touching,
    /// Seconds since the behaviour started.
    Elapsed,
    /// How often a behaviour was tried in a minterm.
    Visits,
    /// How much of the learning is done.
    Progress,
    /// How far the robot has come, at most, since it was put somewhere: no point of its way is farther from here than what was
    /// added since.
    Path,
    /// A length that the nearest wall is away, at least.
    Clear,
    /// The commanded speed forwards.
    Speed,
    /// The commanded speed to the left.
    Strafe,
    /// The commanded rate of turn.
    Turn,
    /// The reward of the tick.
    Reward,
    /// Whether a rewarded event fired.
    Closed,
    /// Which line of `end on` fired, counted from one; zero for none.
    End,
    /// What a start line says of the history.
    History,
    /// What the tick pays, whatever happens in it.
    Flow,
}

impl Fixed {
    const COUNT: usize = 17;

    /// Whether a register takes an answer of the code, which is given once.
    pub(super) fn is_output(register: Register) -> bool {
        (Self::Speed.register()..=Self::Flow.register()).contains(&register)
    }

    /// Its register.
    #[inline(always)]
    pub fn register(self) -> Register {
        self as Register
    }
}

/// The most lines of sight that are remembered.
const SIGHTS: usize = 256;

/// Where an echo comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The nearest wall or arena boundary.
    NearestWall,
    /// A sensor.
    Sensor(Id<Sensor>),
    /// One wall.
    Wall(Id<Wall>),
}

/// The registers of a program: what is fixed from below, scratch above it, constants from the top downwards.
#[derive(Clone, Debug)]
pub struct Layout {
    states: usize,
    locals: Vec<usize>,
    events: usize,
    ended: usize,
    /// The registers that say whether a behaviour runs, of those that are asked.
    running: FxHashMap<Id<Behavior>, Register>,
    /// The poses of all robots, where there are several.
    robots: usize,
    echoes: usize,
    /// The fixed points whose lines of sight are asked, by the bits of their coordinates, with the first of two registers.
    sights: FxHashMap<[u64; 2], Register>,
    sensors: usize,
    scratch: usize,
    /// The first register that no code has used as scratch.
    used: usize,
    constants: Vec<f64>,
    known: FxHashMap<u64, Register>,
}

impl Layout {
    /// The layout of a program.
    ///
    /// # Errors
    /// If its variables and readings do not leave room for anything else.
    pub fn new(program: &Program) -> Result<Self, TooLarge> {
        let mut next = Fixed::COUNT;
        let mut take = |count: usize| {
            let first = next;
            next += count;
            first
        };
        let states = take(program.states.len());
        let locals = program
            .behaviors
            .values()
            .map(|behavior| take(behavior.law.as_ref().map_or(0, |law| law.locals.len())))
            .collect();
        let events = take(program.events.len());
        let ended = take(2 * program.behaviors.len());
        let mut asked: Vec<Id<Behavior>> = Vec::new();
        for (_, expr) in program.pool.iter() {
            if let Expr::Ended(behavior, Status::Running) = expr {
                asked.push(behavior);
            }
        }
        let running = asked.into_iter();
        let running = running.map(|behavior| (behavior, take(1) as Register));
        let running = running.collect();
        let (mut sensors, mut walls, mut robots) = (0, 0, 0);
        if let Some(world) = &program.world {
            let counts = world.robots().map(|robot| robot.sensors.len());
            sensors = counts.max().unwrap_or(0);
            walls = world.walls.len();
            if !world.others.is_empty() {
                robots = take(3 * (1 + world.others.len()));
            }
        }
        let echoes = take(4 * (1 + sensors + walls));
        let mut sights = FxHashMap::default();
        for (_, expr) in program.pool.iter() {
            if let Expr::Visible(x, y) = expr
                && let (Some(x), Some(y)) = (program.pool.constant(x), program.pool.constant(y))
                && sights.len() < SIGHTS
            {
                let register = sights.entry([x, y].map(f64::to_bits));
                register.or_insert_with(|| take(2) as Register);
            }
        }
        if next >= REGISTERS {
            return Err(TooLarge);
        }
        Ok(Self {
            states,
            locals,
            events,
            ended,
            running,
            robots,
            echoes,
            sights,
            sensors,
            scratch: next,
            used: next,
            constants: Vec::new(),
            known: FxHashMap::default(),
        })
    }

    /// The register of a state variable.
    pub fn state(&self, id: Id<State>) -> Register {
        (self.states + id.index()) as Register
    }

    /// The first register of a behaviour's variables.
    pub fn locals(&self, id: Id<Behavior>) -> Register {
        self.locals.get(id.index()).copied().unwrap_or_default() as Register
    }

    /// The register that says whether an event happens.
    pub fn event(&self, id: Id<Event>) -> Register {
        (self.events + id.index()) as Register
    }

    /// The register that says whether a behaviour ended so; whether it runs has one only where that is asked.
    pub fn ended(&self, id: Id<Behavior>, status: Status) -> Option<Register> {
        let offset = match status {
            Status::Success => 0,
            Status::Failure => 1,
            Status::Running => return self.running.get(&id).copied(),
        };
        Some((self.ended + 2 * id.index() + offset) as Register)
    }

    /// The behaviours of which it is asked whether they run, with their registers, in order.
    pub fn running(&self) -> Vec<(Id<Behavior>, Register)> {
        let mut running: Vec<_> = self.running.iter().map(|(id, at)| (*id, *at)).collect();
        running.sort_unstable();
        running
    }

    /// A register of a robot's pose, by the robot's place among all of them.
    pub fn robot(&self, robot: Id<Robot>, pose: Pose) -> Register {
        (self.robots + 3 * robot.index() + pose as usize) as Register
    }

    /// How many sensors a robot may have: the number that echo sources count with.
    pub fn sensors(&self) -> usize {
        self.sensors
    }

    /// The number of an echo source: the nearest wall, then the sensors, then the walls.
    pub fn source(&self, source: Source) -> u16 {
        (match source {
            Source::NearestWall => 0,
            Source::Sensor(id) => 1 + id.index(),
            Source::Wall(id) => 1 + self.sensors + id.index(),
        }) as u16
    }

    /// The first of the four registers of an echo source.
    pub(super) fn echo(&self, source: u16) -> Register {
        (self.echoes + 4 * usize::from(source)) as Register
    }

    /// The first of the two registers of a line of sight to a fixed point; none for a point past the first few hundred.
    pub(super) fn sight(&self, point: [f64; 2]) -> Option<Register> {
        self.sights.get(&point.map(f64::to_bits)).copied()
    }

    /// The registers of all lines of sight to fixed points, in order: until where on its way the robot may rely on what was
    /// seen, and that.
    pub fn sights(&self) -> Vec<Register> {
        let mut sights: Vec<_> = self.sights.values().flat_map(|&it| [it, it + 1]).collect();
        sights.sort_unstable();
        sights
    }

    /// Where scratch registers begin.
    pub(super) fn scratch(&self) -> usize {
        self.scratch
    }

    /// Notes that scratch registers below `end` are in use.
    pub(super) fn reserve(&mut self, end: usize) -> Result<(), TooLarge> {
        self.used = self.used.max(end);
        self.check()
    }

    /// The register of a constant.
    pub(super) fn constant(&mut self, value: f64) -> Result<Register, TooLarge> {
        if let Some(&register) = self.known.get(&value.to_bits()) {
            return Ok(register);
        }
        self.constants.push(value);
        self.check()?;
        let register = (REGISTERS - self.constants.len()) as Register;
        self.known.insert(value.to_bits(), register);
        Ok(register)
    }

    fn check(&self) -> Result<(), TooLarge> {
        if self.used + self.constants.len() > REGISTERS {
            return Err(TooLarge);
        }
        Ok(())
    }

    /// Registers with the constants in place; everything else is zero.
    pub fn registers(&self) -> Registers {
        let mut registers = Registers::default();
        for (i, &value) in self.constants.iter().enumerate() {
            registers.set((REGISTERS - 1 - i) as Register, value);
        }
        registers
    }
}
