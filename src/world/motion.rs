//! How the robot moves: kinematics, limits, noise and contact.
//!
//! A tick's motion is a straight step along the mean heading of the tick (the midpoint rule: exact in direction for a
//! constant turn, of second order in length), then the heading is that of the tick's end. The whole step is tested, so
//! that no speed carries the robot through a thin wall.

use super::pose::{Pose, rotor};
use super::scene::Scene;
use crate::geometry::{Circle, Point, along, dot, minus, turned};
use crate::ir::world::{Contact, Drive, DriveKind, Robot};
use crate::math;
use crate::random::Random;

/// What the wheels are commanded to do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Command {
    /// Forward speed in m/s.
    pub speed: f64,
    /// Speed to the left in m/s.
    pub strafe: f64,
    /// Rate of turn in rad/s.
    pub turn: f64,
}

/// A robot's way of moving.
#[derive(Clone, Debug)]
pub struct Motion {
    drive: Drive,
    contact: Contact,
    radius: f64,
    tick: f64,
}

/// Less than any length that matters, more than rounding.
const SKIN: f64 = 1e-9;

/// The value within ±limit; zero for NaN, so that no pose is ever NaN.
#[inline(always)]
fn limited(value: f64, limit: f64) -> f64 {
    if value > limit {
        limit
    } else if value < -limit {
        -limit
    } else if value.is_nan() {
        0.0
    } else {
        value
    }
}

impl Motion {
    /// The motion of a robot in ticks of this many seconds.
    pub fn new(robot: &Robot, tick: f64) -> Self {
        Self {
            drive: robot.drive.clone(),
            contact: robot.contact,
            radius: robot.radius,
            tick,
        }
    }

    /// Moves the robot for one tick; answers whether something was in its way. `bodies` are other robots where they stand now.
    ///
    /// `slack` is a length that the robot can go in any direction without touching a wall. It is kept up to date,
    /// and saves looking at the walls while it lasts.
    #[inline]
    pub fn step(
        &self,
        scene: &Scene,
        bodies: &[Circle],
        command: Command,
        random: &mut Random,
        pose: &mut Pose,
        slack: &mut f64,
    ) -> bool {
        let drive = &self.drive;
        let mut turn = limited(command.turn, drive.max_turn);
        let (mut speed, mut strafe) = match drive.kind {
            DriveKind::Differential => (limited(command.speed, drive.max_speed), 0.0),
            DriveKind::Holonomic => {
                // Far beyond the limit only so that infinite commands have a direction.
                let bound = 1e6 * drive.max_speed;
                let (speed, strafe) = (
                    limited(command.speed, bound),
                    limited(command.strafe, bound),
                );
                let total = math::hypot(speed, strafe);
                if total > drive.max_speed {
                    let scale = drive.max_speed / total;
                    (speed * scale, strafe * scale)
                } else {
                    (speed, strafe)
                }
            }
        };
        let goes = speed != 0.0 || strafe != 0.0;
        if goes && drive.speed_noise > 0.0 {
            let noise = drive.speed_noise * random.gaussian();
            let total = math::hypot(speed, strafe);
            let scale = (total + noise) / total;
            (speed, strafe) = (speed * scale, strafe * scale);
        }
        if (goes || turn != 0.0) && drive.turn_noise > 0.0 {
            turn += drive.turn_noise * random.gaussian();
        }

        let mut ahead = pose.ahead;
        if turn != 0.0 {
            let angle = turn * self.tick;
            let half = rotor(0.5 * angle);
            ahead = turned(ahead, half);
            let end = turned(ahead, half);
            // One step of Newton's method keeps the length at one.
            let scale = 1.5 - 0.5 * dot(end, end);
            pose.ahead = [end[0] * scale, end[1] * scale];
            pose.heading = math::wrap(pose.heading + angle);
        }
        if !goes {
            return false;
        }
        let (forth, left) = (speed * self.tick, strafe * self.tick);
        let length = if left == 0.0 {
            forth.abs()
        } else {
            math::hypot(forth, left)
        };
        let step = turned(ahead, [forth, left]);
        self.go(scene, bodies, step, length, pose, slack)
    }

    /// How far the robot can go without touching anything where the nearest obstacle is this far from its centre.
    #[inline(always)]
    pub(super) fn slack(&self, clear: f64) -> f64 {
        clear - self.radius - SKIN
    }

    /// Goes a step of this length, as far as contact allows.
    #[inline]
    fn go(
        &self,
        scene: &Scene,
        bodies: &[Circle],
        step: Point,
        length: f64,
        pose: &mut Pose,
        slack: &mut f64,
    ) -> bool {
        if length >= *slack {
            let nearest = scene.nearest(pose.position);
            *slack = self.slack(dot(nearest, nearest).sqrt());
        }
        let apart = |body: &Circle| {
            let gap = minus(body.center, pose.position);
            length < self.slack(dot(gap, gap).sqrt() - body.radius)
        };
        if length < *slack && bodies.iter().all(apart) {
            *slack -= length;
            pose.position = along(pose.position, 1.0, step);
            return false;
        }
        *slack = 0.0;
        if self.is_free_along(scene, bodies, pose.position, step) {
            pose.position = along(pose.position, 1.0, step);
            return false;
        }
        if self.contact == Contact::Slide {
            self.slide(scene, bodies, step, pose);
        }
        true
    }

    /// Whether the way is free of walls and of other robots; from one that is too near already, any way leads that does
    /// not go nearer.
    fn is_free_along(&self, scene: &Scene, bodies: &[Circle], p: Point, step: Point) -> bool {
        let apart = |body: &Circle| {
            let reach = body.radius + self.radius;
            let gap = body.center_gap_square(p, step);
            gap >= reach * reach || dot(minus(body.center, p), step) <= 0.0
        };
        bodies.iter().all(apart) && scene.is_free_along(p, step, self.radius)
    }

    /// The vector from `p` to what is nearest: a wall or another robot.
    fn nearest(scene: &Scene, bodies: &[Circle], p: Point) -> Point {
        let nearer = |one: Point, body: &Circle| {
            let other = body.nearest(p);
            if dot(other, other) < dot(one, one) {
                other
            } else {
                one
            }
        };
        bodies.iter().fold(scene.nearest(p), nearer)
    }

    /// Goes along the wall that is in the way; in a corner, along the second one, if that is free.
    fn slide(&self, scene: &Scene, bodies: &[Circle], mut step: Point, pose: &mut Pose) {
        for _ in 0..2 {
            // Where the step would hit, the nearest wall is the one in the way.
            let mut reach = 0.0;
            for part in [0.5, 0.25, 0.125, 0.0625] {
                let tried = [step[0] * (reach + part), step[1] * (reach + part)];
                if self.is_free_along(scene, bodies, pose.position, tried) {
                    reach += part;
                }
            }
            let toward = Self::nearest(scene, bodies, along(pose.position, reach, step));
            let square = dot(toward, toward);
            let into = dot(step, toward) / square;
            if into > 0.0 {
                step = along(step, -into, toward);
            }
            let end = scene.pulled_in(along(pose.position, 1.0, step), self.radius);
            let tried = [end[0] - pose.position[0], end[1] - pose.position[1]];
            if self.is_free_along(scene, bodies, pose.position, tried) {
                pose.position = along(pose.position, 1.0, tried);
                return;
            }
        }
    }
}
