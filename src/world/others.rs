//! The ticks of the other robots, and what robots know of each other.

use super::script::Other;
use super::simulation::{Simulation, tick_behavior};
use crate::eval::run;
use crate::geometry::Circle;
use crate::ir::Id;
use crate::ir::expr;
use crate::ir::tree::Status;
use std::cmp::Ordering;

impl Simulation<'_> {
    /// Ticks the trees of the other robots (step 3), in the order of their declaration.
    #[cold]
    pub(super) fn others_act(&mut self) {
        let Self {
            simulator,
            registers,
            instances,
            others,
            elsewhere,
            now,
            sights,
            ..
        } = self;
        for other in others {
            other.body.tick();
            let kept = other.enter(registers, sights);
            let Other {
                runner,
                body,
                atoms,
                ..
            } = other;
            runner.tick_key(*atoms, |behavior| {
                let instance = instances.get_mut(behavior.index());
                let status = tick_behavior(simulator, *now, behavior, instance, registers, body);
                if status != Status::Running {
                    if let Some(instance) = instances.get_mut(behavior.index()) {
                        instance.until = 0;
                    }
                    if let Some(register) = simulator.layout.ended(behavior, status) {
                        registers.set(register, 1.0);
                    }
                    elsewhere.push((behavior, status));
                }
                status
            });
            other.leave(registers, sights, kept);
        }
        self.body.moved();
    }

    /// Moves the other robots by their commands, one after the other.
    #[cold]
    pub(super) fn others_go(&mut self) {
        self.tell_of(0);
        for index in 0..self.others.len() {
            let Some(other) = self.others.get_mut(index) else {
                continue;
            };
            let (script, command) = (other.script, other.command);
            let before = other.body.pose.position;
            let (scene, bodies, random, pose) = other.body.moving();
            let motion = &script.motion;
            let slack = &mut other.slack;
            let touched = motion.step(scene, bodies, command, random, pose, slack);
            other.body.came_from(before);
            other.touching = f64::from(u8::from(touched));
            self.tell_of(index + 1);
        }
        self.body.moved();
        self.publish_others();
    }

    /// Tells each robot where the others are.
    pub(super) fn meet(&mut self) {
        let mut robots = std::mem::take(&mut self.robots);
        robots.clear();
        robots.extend(
            self.standing()
                .map(|(center, radius)| Circle { center, radius }),
        );
        let but = |own: usize| {
            let circles = robots.iter().enumerate();
            circles.filter(move |(at, _)| *at != own).map(|(_, it)| *it)
        };
        self.body.bodies.clear();
        self.body.bodies.extend(but(0));
        self.body.moved();
        for (other, own) in self.others.iter_mut().zip(1..) {
            other.body.bodies.clear();
            other.body.bodies.extend(but(own));
        }
        self.robots = robots;
    }

    /// Tells all others where a robot is now, by its place among all of them.
    fn tell_of(&mut self, robot: usize) {
        let other = robot.checked_sub(1).and_then(|at| self.others.get(at));
        let center = other
            .map_or(self.body.pose, |other| other.body.pose)
            .position;
        let others = self.others.iter_mut().map(|other| &mut other.body.bodies);
        let all = std::iter::once(&mut self.body.bodies).chain(others);
        for (own, bodies) in all.enumerate() {
            // A robot is not in its own list.
            let at = match robot.cmp(&own) {
                Ordering::Less => robot,
                Ordering::Equal => continue,
                Ordering::Greater => robot - 1,
            };
            if let Some(body) = bodies.get_mut(at) {
                body.center = center;
            }
        }
    }

    /// Tells the code where all robots are.
    pub(super) fn publish_others(&mut self) {
        let others = self.others.iter().map(|other| &other.body.pose);
        let poses = std::iter::once(&self.body.pose).chain(others);
        for (index, pose) in poses.enumerate() {
            let id = Id::new(index);
            let parts = [pose.position[0], pose.position[1], pose.heading];
            let coordinates = [expr::Pose::X, expr::Pose::Y, expr::Pose::Heading];
            for (coordinate, part) in coordinates.into_iter().zip(parts) {
                let register = self.simulator.layout.robot(id, coordinate);
                self.registers.set(register, part);
            }
        }
    }

    /// Asks what the trees of the other robots ask.
    pub(super) fn others_look(&mut self) {
        let Self {
            registers,
            others,
            sights,
            ..
        } = self;
        for other in others {
            let kept = other.enter(registers, sights);
            other.body.atoms = 0;
            run(&other.script.predicates, registers, &mut other.body);
            other.atoms = other.body.atoms;
            other.leave(registers, sights, kept);
        }
        self.body.moved();
    }
}
