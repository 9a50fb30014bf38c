//! Between which numbers an expression is, whatever happens: what its operators and the world leave possible.

use super::apart;
use super::interval::Interval;
use super::view::View;
use crate::ir::expr::{Binary, Draw, Echo, Expr, ExprId, Pose, Unary};
use crate::ir::input::InputKind;
use crate::ir::program::{Stays, ValueKind};
use crate::ir::world::{Robot, Sensor, SensorKind};
use crate::ir::{Id, Name, Program};
use crate::math::hypot;
use std::f64::consts::PI;

/// How many nodes of an expression are looked at.
const MOST: u32 = 400;

/// An angle in the plane.
const ANGLE: Interval = Interval::between(-PI, PI);

/// So many times its deviation a noise never is: the generator draws from 53 bits, and its tail ends before that.
pub const NEVER_DRAWN: f64 = 13.0;

/// A length.
const LENGTH: Interval = Interval::between(0.0, f64::INFINITY);

/// How many values an expression can have, if it is a state of an enum or an input that has one of a few.
pub fn values(program: &Program, id: ExprId) -> Option<usize> {
    match program.pool.get(id) {
        Expr::State(state) => match &program.states[state].kind {
            // A target may be `nowhere` as well.
            ValueKind::Enum(variants) if is_target(program, variants) => None,
            ValueKind::Enum(variants) => Some(variants.len()),
            ValueKind::Bool | ValueKind::Quantity => None,
        },
        Expr::Input(input) => match &program.inputs[input].kind {
            InputKind::Category(values) => Some(values.len()),
            InputKind::Number { .. } => None,
        },
        _ => None,
    }
}

/// Which of the values of an enum an expression may have, as bits, of the first 64.
pub fn may_be(program: &Program, id: ExprId) -> u64 {
    match program.pool.get(id) {
        Expr::State(state) => match program.states[state].stays {
            Stays::Among(values) => values,
            Stays::Within(_) => u64::MAX,
        },
        _ => u64::MAX,
    }
}

/// Whether these are places, walls or robots.
fn is_target(program: &Program, variants: &[Name]) -> bool {
    let (Some(world), Some(first)) = (&program.world, variants.first()) else {
        return false;
    };
    let mut places = world.places.values().map(|place| &place.name);
    let mut walls = world.walls.values().map(|wall| &wall.name);
    let others = world.others.values().map(|other| &other.robot.name);
    let mut robots = others.chain([&world.robot.name]);
    places.any(|name| name == first)
        || walls.any(|name| name == first)
        || robots.any(|name| name == first)
}

/// Between which numbers an expression is.
pub fn range(view: View, id: ExprId) -> Interval {
    let left = MOST;
    Ranges { view, left }.of(id)
}

struct Ranges<'p> {
    view: View<'p>,
    /// How many nodes may still be looked at.
    left: u32,
}

impl Ranges<'_> {
    fn of(&mut self, id: ExprId) -> Interval {
        let Some(left) = self.left.checked_sub(1) else {
            return Interval::ALL;
        };
        self.left = left;
        match self.view.program.pool.get(id) {
            Expr::Num(value) => hull([value]),
            variable @ (Expr::State(_) | Expr::Local(_) | Expr::Temp(_)) => {
                match self.view.stays(variable) {
                    Some(Stays::Within(within)) => hull([*within.start(), *within.end()]),
                    Some(Stays::Among(_)) | None => Interval::ALL,
                }
            }
            Expr::Draw(_, Draw::Uniform(a, b)) => {
                let ((a, b), (c, d)) = (self.of(a).ends(), self.of(b).ends());
                hull([a, b, c, d])
            }
            Expr::Pose(pose) => {
                let anywhere = || self.pose(self.view.robot, pose);
                self.near(pose).unwrap_or_else(anywhere)
            }
            Expr::Robot(robot, pose) => self.pose(robot, pose),
            Expr::Elapsed | Expr::Visits => LENGTH,
            Expr::Progress => Interval::between(0.0, 1.0),
            Expr::NearestWall(Echo::Distance) | Expr::Wall(_, Echo::Distance) => {
                let least = apart::least(self.view, id).unwrap_or(0.0);
                let most = apart::most(self.view, id).unwrap_or(f64::INFINITY);
                Interval::between(least, most)
            }
            Expr::Sensor(sensor, Echo::Distance) => {
                let least = apart::least(self.view, id).unwrap_or(0.0);
                self.sensor(sensor).and(Interval::above(least, false))
            }
            Expr::NearestWall(Echo::Direction)
            | Expr::Wall(_, Echo::Direction)
            | Expr::Sensor(_, Echo::Direction) => ANGLE,
            Expr::Unary(op, a) => self.unary(op, a),
            Expr::Binary(op, a, b) => {
                let found = self.binary(op, a, b);
                let least = apart::least(self.view, id);
                least.map_or(found, |least| found.and(Interval::above(least, false)))
            }
            Expr::Select(_, a, b) => {
                let ((a, b), (c, d)) = (self.of(a).ends(), self.of(b).ends());
                hull([a, b, c, d])
            }
            _ => Interval::ALL,
        }
    }

    fn near(&self, pose: Pose) -> Option<Interval> {
        let [x, y] = self.view.near?;
        match pose {
            Pose::X => Some(x),
            Pose::Y => Some(y),
            Pose::Heading => None,
        }
    }

    /// The body of a robot is within the bounds of the arena.
    fn pose(&self, robot: Id<Robot>, pose: Pose) -> Interval {
        let Some(world) = &self.view.program.world else {
            return Interval::ALL;
        };
        let ([left, bottom], [right, top]) = world.arena.bounds();
        let room = world.robot_of(robot).radius - apart::SLACK;
        match pose {
            Pose::X => Interval::between(left + room, right - room),
            Pose::Y => Interval::between(bottom + room, top - room),
            Pose::Heading => ANGLE,
        }
    }

    /// What a sensor reads.
    fn sensor(&self, id: Id<Sensor>) -> Interval {
        let Some(world) = &self.view.program.world else {
            return Interval::ALL;
        };
        let sensor = &world.robot_of(self.view.robot).sensors[id];
        let (SensorKind::Scanner { range, .. }
        | SensorKind::RangeFinder { range, .. }
        | SensorKind::Beacon { range, .. }) = sensor.kind;
        Interval::between(0.0, range + NEVER_DRAWN * sensor.noise)
    }

    fn unary(&mut self, op: Unary, a: ExprId) -> Interval {
        match op {
            Unary::Neg => {
                let (low, high) = self.of(a).ends();
                hull([-low, -high])
            }
            Unary::Abs => {
                let of = self.of(a);
                let (low, high) = of.ends();
                let least = if of.contains(0.0) { 0.0 } else { low.abs() };
                hull([least, low.abs(), high.abs()])
            }
            Unary::Sqrt | Unary::Exp => LENGTH,
            Unary::Sin | Unary::Cos | Unary::Sign => Interval::between(-1.0, 1.0),
            Unary::Wrap | Unary::Asin | Unary::Acos | Unary::Atan => ANGLE,
            _ => Interval::ALL,
        }
    }

    fn binary(&mut self, op: Binary, a: ExprId, b: ExprId) -> Interval {
        if op == Binary::Sub && a == b {
            return Interval::just(0.0);
        }
        if op == Binary::Atan2 {
            return ANGLE;
        }
        let ((a, b), (c, d)) = (self.of(a).ends(), self.of(b).ends());
        match op {
            Binary::Add => hull([a + c, b + d]),
            Binary::Sub => hull([a - d, b - c]),
            Binary::Mul => hull([a * c, a * d, b * c, b * d]),
            Binary::Min => hull([a.min(c), b.min(d)]),
            Binary::Max => hull([a.max(c), b.max(d)]),
            Binary::Hypot => {
                let far = |low: f64, high: f64| low.abs().max(high.abs());
                Interval::between(0.0, hypot(far(a, b), far(c, d)))
            }
            _ => Interval::ALL,
        }
    }
}

/// The interval from the least to the greatest of some numbers; every number if one of them is none.
fn hull<const N: usize>(ends: [f64; N]) -> Interval {
    if ends.iter().any(|end| end.is_nan()) {
        return Interval::ALL;
    }
    let least = ends.iter().copied().fold(f64::INFINITY, f64::min);
    let greatest = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    Interval::between(least, greatest)
}
