//! From a checked program to a world that runs.

use super::atoms::Atoms;
use super::body::Surroundings;
use super::compiled::Compiled;
use super::door::Door;
use super::error::BuildError;
use super::heat::Heat;
use super::motion::Motion;
use super::pose::Pose;
use super::scene::Scene;
use super::script::Script;
use super::sensing::Probe;
use super::simulation::Simulation;
use super::start::Start;
use crate::eval::{Layout, Registers};
use crate::geometry::{Point, Shape};
use crate::ir::task::{self, StartLine, Task};
use crate::ir::tree::Atom;
use crate::ir::{Id, Program};
use crate::random::Random;
use std::f64::consts::PI;

/// A program's world, compiled for one task.
#[derive(Clone, Debug)]
pub struct Simulator {
    pub(super) around: Surroundings,
    pub(super) probes: Vec<Probe>,
    pub(super) motion: Motion,
    pub(super) others: Vec<Script>,
    pub(super) doors: Vec<Door>,
    pub(super) compiled: Compiled,
    pub(super) atoms: Atoms,
    pub(super) history: task::History,
    pub(super) radius: f64,
    pub(super) tick: f64,
    /// A free position, for when no other is found.
    pub(super) free: Point,
    pub(super) layout: Layout,
    /// The registers with the constants in place.
    pub(super) registers: Registers,
    /// The states' registers with their values at the start.
    pub(super) states: Vec<(u16, f64)>,
    /// How many events there are.
    pub(super) events: usize,
    /// How much it has been used.
    pub(super) heat: Heat,
}

/// How many random positions are tried before the arena counts as full.
const TRIES: u32 = 20_000;

/// How many random positions in a place are tried before the start line is run again.
const WITHIN: u32 = 1_000;

impl Simulator {
    /// Compiles the world of a program for a task.
    ///
    /// `starts` are the lists of start lines that episodes will use; [`Start::lines`] says which. The atoms that a
    /// simulation keeps are those of [`Program::atoms`], from bit 0, then those of `extra` that are not among them.
    ///
    /// # Errors
    /// If there is no world, something that is used is declared only, the robot does not fit, or the program is too
    /// large.
    pub fn build(
        program: &Program,
        task: Id<Task>,
        starts: &[&[StartLine]],
        extra: &[Atom],
    ) -> Result<Self, BuildError> {
        let world = program.world.as_ref().ok_or(BuildError::NoWorld)?;
        if matches!(world.arena, Shape::Polyline(_)) {
            return Err(BuildError::OpenArena);
        }
        let atoms = Atoms::new(program, task, extra)?;
        let task = &program.tasks[task];
        for &id in &task.choose {
            let behavior = &program.behaviors[id];
            if behavior.law.is_none() {
                return Err(BuildError::Declared(behavior.name.clone()));
            }
        }
        let scene = Scene::new(world);
        let radius = world.robot.radius;
        let mut random = Random::new(0, 0, 0);
        let free = find_free(&scene, radius, &mut random, TRIES).ok_or(BuildError::NoFreeArea)?;
        let mut layout = Layout::new(program)?;
        let doors = Door::all(world);
        let open = scene.is_open();
        let compiled = Compiled::new(program, task, starts, &atoms, open, &doors, &mut layout)?;
        let others = Script::all(program, &mut layout)?;
        let states = program
            .states
            .iter()
            .map(|(id, state)| {
                let initial = program.pool.constant(state.initial).unwrap_or_default();
                (layout.state(id), initial)
            })
            .collect();
        let simulator = Self {
            probes: world.robot.sensors.values().map(Probe::new).collect(),
            others,
            doors,
            around: Surroundings {
                sensors: layout.sensors(),
                sights: layout.sights().first().copied().unwrap_or_default(),
                points: layout.sights().len() / 2,
                places: world.places.values().map(|p| p.shape.clone()).collect(),
                scene,
            },
            motion: Motion::new(&world.robot, world.tick),
            compiled,
            atoms,
            history: task.history,
            radius,
            tick: world.tick,
            free,
            registers: layout.registers(),
            layout,
            states,
            events: program.events.len(),
            heat: Heat::default(),
        };
        // Lines that never give a free pose are found here, not in the middle of learning.
        let mut trial = simulator.simulation();
        for lines in 0..starts.len() {
            let start = Start {
                lines,
                ..Start::default()
            };
            if !trial.start(start) {
                let other = trial.blocked(lines).checked_sub(1);
                let other = other.and_then(|other| world.others.values().nth(other));
                let name = other.map(|other| other.robot.name.clone());
                return Err(BuildError::StartBlocked(lines, name));
            }
        }
        Ok(simulator)
    }

    /// A simulation; it can run any number of episodes, one after the other.
    pub fn simulation(&self) -> Simulation<'_> {
        Simulation::new(self)
    }

    /// What each bit of [`Simulation::atoms`] means.
    pub fn atoms(&self) -> &[Atom] {
        &self.atoms.list
    }

    /// The bits of [`Simulation::key`].
    pub fn observed(&self) -> u128 {
        self.atoms.observed
    }

    /// A free pose in a place, by its number: uniform over where a robot of this radius fits in it. Where it fits nowhere, or
    /// the place has no area, its middle; in no place at all, a pose that is nowhere.
    pub(super) fn within(&self, place: Option<usize>, radius: f64, random: &mut Random) -> Pose {
        let shape = place.and_then(|place| self.around.places.get(place));
        let position = shape.map_or([f64::INFINITY; 2], |shape| {
            let is_free = |p: Point| shape.contains(p) && self.around.scene.is_free(p, radius);
            let found = match shape {
                Shape::Polyline(_) => None,
                _ => draw(shape.bounds(), random, WITHIN, is_free),
            };
            found.unwrap_or_else(|| shape.center())
        });
        Pose::new(position, any_heading(random))
    }

    /// A position that is free for a robot of this radius, every wall standing; uniformly drawn.
    pub(super) fn anywhere(&self, radius: f64, random: &mut Random) -> Point {
        find_free(&self.around.scene, radius, random, 100 * TRIES).unwrap_or(self.free)
    }
}

/// A free position, uniform over the free part of the arena, by rejection.
fn find_free(scene: &Scene, radius: f64, random: &mut Random, tries: u32) -> Option<Point> {
    draw(scene.bounds(), random, tries, |p| scene.is_free(p, radius))
}

/// A position in a rectangle that is one of those wanted, uniform over them, by rejection.
fn draw(
    (min, max): (Point, Point),
    random: &mut Random,
    tries: u32,
    is_wanted: impl Fn(Point) -> bool,
) -> Option<Point> {
    (0..tries)
        .map(|_| {
            [
                random.uniform(min[0], max[0]),
                random.uniform(min[1], max[1]),
            ]
        })
        .find(|&p| is_wanted(p))
}

/// Any heading.
pub(super) fn any_heading(random: &mut Random) -> f64 {
    random.uniform(-PI, PI)
}
