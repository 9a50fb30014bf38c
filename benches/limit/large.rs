//! `examples/delivery_large.bt` under its tree `expert`, written out by hand.

use super::hand::{Loop, Robot, Status, Vector, Wall, cross, crosses, dot, minus, nearest, wrap};
use btc::random::Random;
use std::f64::consts::{FRAC_PI_2, PI};

const A: Vector = [1.15, 2.35];
const B: Vector = [4.45, 1.95];
const C: Vector = [5.65, 2.50];

const BARRIER: [Wall; 2] = [[[2.60, 0.95], [2.60, 2.55]], [[2.60, 2.55], [1.50, 2.55]]];

const ECHOES: [Wall; 6] = [
    [[0.0, 0.0], [6.0, 0.0]],
    [[6.0, 0.0], [6.0, 4.0]],
    [[6.0, 4.0], [0.0, 4.0]],
    [[0.0, 4.0], [0.0, 0.0]],
    BARRIER[0],
    BARRIER[1],
];

const RADIUS: f64 = 0.17;

#[derive(Clone, Copy, PartialEq)]
enum Behavior {
    GotoA,
    GotoB,
    GotoC,
    Dock,
    FollowWall,
}

/// What the tree asks.
#[derive(Clone, Copy, PartialEq)]
struct Asked {
    carrying: bool,
    low: bool,
    sees: [bool; 3],
}

pub struct Large {
    robot: Robot,
    random: Random,
    carrying: bool,
    battery: f64,
    docking: bool,
    touching: bool,
    /// The side of the wall that is followed.
    hand: f64,
    last: Option<Behavior>,
    asked: Asked,
    since: u32,
    now: u32,
    total: f64,
}

/// Whether nothing stands between two points.
fn sees(p: Vector, q: Vector) -> bool {
    !BARRIER.iter().any(|wall| crosses(wall, p, q))
}

/// Whether the body can go a step from `p` without touching the barrier or a side.
fn is_free(p: Vector, step: Vector) -> bool {
    let q = [p[0] + step[0], p[1] + step[1]];
    let apart = |wall: &Wall| {
        let far = |v: Vector| dot(v, v) >= RADIUS * RADIUS;
        let stands = step == [0.0; 2];
        !crosses(wall, p, q)
            && far(nearest(wall, p))
            && far(nearest(wall, q))
            && (stands || wall.iter().all(|&end| far(nearest(&[p, q], end))))
    };
    Robot::fits(q) && BARRIER.iter().all(apart)
}

impl Large {
    /// The nearest echo on the side of `right`, a unit vector: the sector is the half plane on its left.
    fn scan(&self, right: Vector) -> Option<Vector> {
        let p = self.robot.position();
        let (mut best, mut found) = (9.0, None);
        for wall in &ECHOES {
            let whole = nearest(wall, p);
            let (mut vector, mut square) = (whole, dot(whole, whole));
            if square >= best {
                continue;
            }
            if cross(right, whole) < 0.0 {
                let (from, to) = (minus(wall[0], p), minus(wall[1], p));
                let (a, b) = (cross(right, from), cross(right, to));
                if a < 0.0 && b < 0.0 {
                    continue;
                }
                // The nearest point is behind: the one on the edge is nearer than all before it.
                let t = a / (a - b);
                vector = [
                    from[0] + t * (to[0] - from[0]),
                    from[1] + t * (to[1] - from[1]),
                ];
                square = dot(vector, vector);
            }
            if square < best {
                (best, found) = (square, Some(vector));
            }
        }
        found
    }

    /// The distance and the direction of what a scanner meets on one side: 1 left, −1 right.
    fn read(&mut self, side: f64) -> (f64, Vector) {
        let (sin, cos) = self.robot.heading.sin_cos();
        match self.scan([side * cos, side * sin]) {
            Some(vector) => {
                let noise = 0.005 * self.random.gaussian();
                ((dot(vector, vector).sqrt() + noise).max(0.0), vector)
            }
            None => (3.0, [-side * sin, side * cos]),
        }
    }

    fn follow_wall(&mut self) {
        if self.last != Some(Behavior::FollowWall) {
            self.hand = 0.0;
        }
        let (far, at) = if self.hand == 0.0 {
            let (left, right) = (self.read(1.0), self.read(-1.0));
            if left.0.min(right.0) <= 0.5 {
                self.hand = if left.0 <= right.0 { 1.0 } else { -1.0 };
            }
            if self.hand >= 0.0 { left } else { right }
        } else {
            self.read(self.hand)
        };
        if self.hand != 0.0 && far > 0.9 {
            self.hand = 0.0;
        }
        let (hand, robot) = (self.hand, &mut self.robot);
        (robot.speed, robot.turn) = if hand == 0.0 {
            (robot.max_speed, 0.0)
        } else if self.touching {
            (0.0, -hand * 2.0)
        } else {
            let error = wrap(at[1].atan2(at[0]) - robot.heading) - hand * FRAC_PI_2;
            let bend = 3.0 * (error + hand * 2.5 * (far - 0.35).clamp(-0.25, 0.25));
            let bend = bend.clamp(-robot.max_turn, robot.max_turn);
            let pace = error.cos().max(0.15).min(1.0 - bend.abs() / 10.0);
            (robot.max_speed * pace, bend)
        };
    }

    fn nearest_wall(&self) -> Vector {
        let p = self.robot.position();
        let mut best = self.robot.nearest_side();
        for wall in &BARRIER {
            let vector = nearest(wall, p);
            if dot(vector, vector) < dot(best, best) {
                best = vector;
            }
        }
        best
    }

    fn drive(&mut self) {
        let robot = &mut self.robot;
        robot.turn = robot.turn.clamp(-robot.max_turn, robot.max_turn);
        if robot.speed != 0.0 || robot.turn != 0.0 {
            robot.turn += 0.2 * self.random.gaussian();
        }
        let goes = robot.speed != 0.0;
        let step = robot.swing();
        self.touching = goes && !is_free(robot.position(), step);
        if goes && !self.touching {
            robot.x += step[0];
            robot.y += step[1];
        }
    }

    fn ask(&self) -> Asked {
        let p = self.robot.position();
        Asked {
            carrying: self.carrying,
            low: self.battery <= 0.25,
            sees: [sees(p, A), sees(p, B), sees(p, C)],
        }
    }
}

impl Loop for Large {
    fn start(mut random: Random) -> Self {
        let position = loop {
            let p = [random.uniform(0.0, 6.0), random.uniform(0.0, 4.0)];
            if is_free(p, [0.0; 2]) {
                break p;
            }
        };
        let heading = random.uniform(-PI, PI);
        let carrying = random.chance(0.5);
        let battery = random.uniform(0.3, 1.0);
        let mut started = Self {
            robot: Robot {
                x: position[0],
                y: position[1],
                heading,
                max_speed: 0.5,
                max_turn: 2.5,
                ..Robot::default()
            },
            random,
            carrying,
            battery,
            docking: false,
            touching: false,
            hand: 0.0,
            last: None,
            asked: Asked {
                carrying,
                low: false,
                sees: [false; 3],
            },
            since: 0,
            now: 0,
            total: 0.0,
        };
        started.asked = started.ask();
        started
    }

    fn tick(&mut self) -> bool {
        (self.robot.speed, self.robot.turn) = (0.0, 0.0);
        self.now += 1;
        self.battery -= 0.001;

        let Asked {
            carrying,
            low,
            sees: [sees_a, sees_b, sees_c],
        } = self.asked;
        let recharges = low && sees_c;
        self.docking &= recharges;
        let behavior = match (recharges, self.docking) {
            (true, true) => Behavior::Dock,
            (true, false) => Behavior::GotoC,
            _ if carrying && sees_b => Behavior::GotoB,
            _ if !carrying && sees_a => Behavior::GotoA,
            _ => Behavior::FollowWall,
        };
        let status = match behavior {
            Behavior::FollowWall => {
                self.follow_wall();
                Status::Running
            }
            Behavior::Dock => self.robot.dock(0.0),
            _ => {
                let place = match behavior {
                    Behavior::GotoA => A,
                    Behavior::GotoB => B,
                    _ => C,
                };
                let wall = self.nearest_wall();
                self.robot.goto(place, 0.15, wall)
            }
        };
        self.last = Some(behavior);
        let ended = (status == Status::Success).then_some(behavior);
        if ended.is_some() {
            self.docking = behavior == Behavior::GotoC;
            self.last = None;
        }

        self.drive();

        let pickup = ended == Some(Behavior::GotoA) && !self.carrying;
        let dropoff = ended == Some(Behavior::GotoB) && self.carrying;
        let dead = self.battery <= 0.0;
        let reward = match (dead, pickup, dropoff) {
            (true, ..) => -5.0,
            (_, true, _) => 1.0,
            (_, _, true) => 2.0,
            _ => -0.1,
        };
        self.carrying = (self.carrying || pickup) && !dropoff;
        if ended == Some(Behavior::Dock) {
            self.battery = 1.0;
        }
        let asked = self.ask();
        let over = dead || self.now == 5000;
        self.since += 1;
        if asked != self.asked || ended.is_some() || over || self.since >= 600 {
            self.total += reward;
            self.since = 0;
        }
        self.asked = asked;
        over
    }

    fn robot(&self) -> &Robot {
        &self.robot
    }

    fn total(&self) -> f64 {
        self.total
    }
}
