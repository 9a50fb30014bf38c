//! Robots that run a tree of their own.
//!
//! The code of all robots is of one program and one register file. While a script is ticked, the registers that say where
//! the acting robot is and what it commands are the other robot's.

use super::body::Body;
use super::compiled::piece;
use super::error::BuildError;
use super::motion::{Command, Motion};
use super::sensing::Probe;
use crate::eval::{Code, Fixed, Layout, Register, Registers};
use crate::ir::tree::Atom;
use crate::ir::{ExprId, Program};
use crate::tree::Runner;
use crate::tree::atoms::atoms;

/// What a robot that runs a tree of its own is made of.
#[derive(Clone, Debug)]
pub(super) struct Script {
    pub(super) probes: Vec<Probe>,
    pub(super) motion: Motion,
    pub(super) radius: f64,
    pub(super) runner: Runner,
    /// The values of what its tree asks, a bit each.
    pub(super) predicates: Code,
}

/// Another robot, as it runs.
#[derive(Clone, Debug)]
pub(super) struct Other<'a> {
    pub(super) script: &'a Script,
    pub(super) body: Body<'a>,
    pub(super) runner: Runner,
    pub(super) touching: f64,
    /// A length that it can go in any direction without touching a wall.
    pub(super) slack: f64,
    /// What it has seen: the registers of lines of sight while another robot's code runs.
    pub(super) sights: Vec<f64>,
    pub(super) command: Command,
    /// What its tree asks.
    pub(super) atoms: u128,
}

impl Script {
    /// The scripts of a program, compiled.
    pub(super) fn all(program: &Program, layout: &mut Layout) -> Result<Vec<Self>, BuildError> {
        let Some(world) = &program.world else {
            return Ok(Vec::new());
        };
        let mut scripts = Vec::new();
        for other in world.others.values() {
            let Some(root) = &other.script else {
                return Err(BuildError::NoScript(other.robot.name.clone()));
            };
            let asked: Vec<Atom> = atoms(root).into_iter().collect();
            if asked.len() > 128 {
                return Err(BuildError::TooManyAtoms(asked.len()));
            }
            let runner = Runner::new(root, &asked)
                .map_err(|_| BuildError::NoScript(other.robot.name.clone()))?;
            let mut conditions: Vec<ExprId> = Vec::new();
            for atom in &asked {
                let Atom::Predicate(id) = atom else {
                    return Err(BuildError::NoScript(other.robot.name.clone()));
                };
                let predicate = &program.predicates[*id];
                let when = predicate.when;
                let when = when.ok_or_else(|| BuildError::Declared(predicate.name.clone()))?;
                conditions.push(when);
            }
            let predicates = piece(&program.pool, layout, |c| {
                let mut conditions = conditions.iter().zip(0..);
                conditions.try_for_each(|(&when, bit)| c.atom(bit, when))
            })?;
            scripts.push(Self {
                probes: other.robot.sensors.values().map(Probe::new).collect(),
                motion: Motion::new(&other.robot, world.tick),
                radius: other.robot.radius,
                runner,
                predicates,
            });
        }
        Ok(scripts)
    }
}

/// The registers that belong to the robot whose code runs.
const OWN: [Fixed; 10] = [
    Fixed::X,
    Fixed::Y,
    Fixed::Heading,
    Fixed::Touching,
    Fixed::Elapsed,
    Fixed::Path,
    Fixed::Clear,
    Fixed::Speed,
    Fixed::Strafe,
    Fixed::Turn,
];

/// What the registers of the acting robot held while another one's code runs.
pub(super) struct Kept([f64; OWN.len()]);

impl Other<'_> {
    /// Lets the registers be those of this robot.
    pub(super) fn enter(&mut self, registers: &mut Registers, sights: &[Register]) -> Kept {
        let kept = OWN.map(|fixed| registers.get(fixed.register()));
        let pose = &self.body.pose;
        let own = [
            pose.position[0],
            pose.position[1],
            pose.heading,
            self.touching,
            0.0,
            self.body.path(),
            // Not known.
            0.0,
            0.0,
            0.0,
            0.0,
        ];
        for (fixed, value) in OWN.into_iter().zip(own) {
            registers.set(fixed.register(), value);
        }
        self.exchange(registers, sights);
        // The registers of echoes are another robot's.
        self.body.moved();
        Kept(kept)
    }

    /// Exchanges what this robot and the acting one have seen.
    fn exchange(&mut self, registers: &mut Registers, sights: &[Register]) {
        for (&register, seen) in sights.iter().zip(&mut self.sights) {
            let own = std::mem::replace(seen, registers.get(register));
            registers.set(register, own);
        }
    }

    /// Takes the command of this robot and gives the registers back.
    pub(super) fn leave(
        &mut self,
        registers: &mut Registers,
        sights: &[Register],
        Kept(kept): Kept,
    ) {
        self.exchange(registers, sights);
        let read = |fixed: Fixed| registers.get(fixed.register());
        self.command = Command {
            speed: read(Fixed::Speed),
            strafe: read(Fixed::Strafe),
            turn: read(Fixed::Turn),
        };
        for (fixed, value) in OWN.into_iter().zip(kept) {
            registers.set(fixed.register(), value);
        }
    }
}
