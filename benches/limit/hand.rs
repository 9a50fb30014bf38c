//! What both hand-written loops share: vectors, steering and the two stations' behaviours, as one writes them for one world.

use btc::random::Random;
use std::f64::consts::PI;

pub type Vector = [f64; 2];

/// A segment between two points.
pub type Wall = [Vector; 2];

/// The pose and what the wheels are told.
#[derive(Clone, Copy, Debug, Default)]
pub struct Robot {
    pub x: f64,
    pub y: f64,
    pub heading: f64,
    pub speed: f64,
    pub turn: f64,
    pub max_speed: f64,
    pub max_turn: f64,
}

/// An example's loop: the world, its tree by hand, its reward.
pub trait Loop {
    /// The first tick of an episode is still to come.
    fn start(random: Random) -> Self;
    /// One tick; whether the episode is over.
    fn tick(&mut self) -> bool;
    fn robot(&self) -> &Robot;
    /// The sum of the rewards so far.
    fn total(&self) -> f64;
}

/// How a behaviour stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Status {
    Running,
    Success,
}

pub fn wrap(angle: f64) -> f64 {
    if angle >= PI {
        angle - 2.0 * PI
    } else if angle < -PI {
        angle + 2.0 * PI
    } else {
        angle
    }
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

/// The vector from `p` to the nearest point of a wall.
pub fn nearest(wall: &Wall, p: Vector) -> Vector {
    let (from, along) = (minus(wall[0], p), minus(wall[1], wall[0]));
    let t = (-dot(from, along) / dot(along, along)).clamp(0.0, 1.0);
    [from[0] + t * along[0], from[1] + t * along[1]]
}

/// Whether two segments cross.
pub fn crosses(wall: &Wall, p: Vector, q: Vector) -> bool {
    let (way, along) = (minus(q, p), minus(wall[1], wall[0]));
    let side = |point: Vector| cross(way, minus(point, p));
    let other = |point: Vector| cross(along, minus(point, wall[0]));
    side(wall[0]) * side(wall[1]) <= 0.0 && other(p) * other(q) <= 0.0
}

impl Robot {
    pub fn position(&self) -> Vector {
        [self.x, self.y]
    }

    pub fn to(&self, place: Vector) -> Vector {
        minus(place, self.position())
    }

    fn steer(&mut self, course: f64, goes: bool) {
        let off = wrap(wrap(course) - self.heading);
        self.turn = (4.0 * off).clamp(-self.max_turn, self.max_turn);
        self.speed = if goes && off.abs() <= 0.6 {
            self.max_speed
        } else {
            0.0
        };
    }

    /// Drives to a place in sight, round a wall that is nearer than a quarter of a metre.
    pub fn goto(&mut self, place: Vector, radius: f64, nearest_wall: Vector) -> Status {
        let to = self.to(place);
        if dot(to, to) <= radius * radius {
            return Status::Success;
        }
        let mut course = to[1].atan2(to[0]);
        if dot(nearest_wall, nearest_wall).sqrt() < 0.25 {
            let wall_at = nearest_wall[1].atan2(nearest_wall[0]);
            let off = wrap(course - wall_at);
            let keep = 95.0_f64.to_radians();
            if off.abs() < keep {
                course = wall_at + if off >= 0.0 { keep } else { -keep };
            }
        }
        self.steer(course, true);
        Status::Running
    }

    /// Turns on the spot until the robot looks as the station does.
    pub fn dock(&mut self, facing: f64) -> Status {
        if wrap(facing - self.heading).abs() < 0.1 {
            return Status::Success;
        }
        self.steer(facing, false);
        Status::Running
    }

    /// Turns for a tick of 100 ms; gives the step that the robot would make.
    pub fn swing(&mut self) -> Vector {
        let angle = self.turn * 0.1;
        let mean = self.heading + 0.5 * angle;
        self.heading = wrap(self.heading + angle);
        let length = self.speed * 0.1;
        [length * mean.cos(), length * mean.sin()]
    }

    /// The vector to the nearest side of the arena of 6 m by 4 m.
    pub fn nearest_side(&self) -> Vector {
        let x = if self.x < 6.0 - self.x {
            -self.x
        } else {
            6.0 - self.x
        };
        let y = if self.y < 4.0 - self.y {
            -self.y
        } else {
            4.0 - self.y
        };
        if y.abs() < x.abs() {
            [0.0, y]
        } else {
            [x, 0.0]
        }
    }

    /// Whether a body of 17 cm may stand at a point, as far as the arena's sides go.
    pub fn fits(p: Vector) -> bool {
        p[0] >= 0.17 && p[0] <= 6.0 - 0.17 && p[1] >= 0.17 && p[1] <= 4.0 - 0.17
    }
}
