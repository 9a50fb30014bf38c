//! `examples/delivery_small.bt` under its tree `expert`, written out by hand.

use super::hand::{Loop, Robot, Status};
use btc::random::Random;
use std::f64::consts::PI;

const A: [f64; 2] = [0.6, 2.0];
const B: [f64; 2] = [5.4, 2.0];
const C: [f64; 2] = [3.0, 0.3];

/// The behaviours.
#[derive(Clone, Copy, PartialEq)]
enum Done {
    GotoA,
    GotoB,
    GotoC,
    Dock,
}

pub struct Small {
    robot: Robot,
    carrying: bool,
    battery: f64,
    /// Whether the memory sequence has come to its second step.
    docking: bool,
    low: bool,
    now: u32,
    total: f64,
}

impl Loop for Small {
    fn start(mut random: Random) -> Self {
        let position = loop {
            let p = [random.uniform(0.0, 6.0), random.uniform(0.0, 4.0)];
            if Robot::fits(p) {
                break p;
            }
        };
        let heading = random.uniform(-PI, PI);
        let carrying = random.chance(0.5);
        let battery = random.uniform(0.3, 1.0);
        Self {
            robot: Robot {
                x: position[0],
                y: position[1],
                heading,
                max_speed: 0.4,
                max_turn: 2.0,
                ..Robot::default()
            },
            carrying,
            battery,
            docking: false,
            low: battery <= 0.25,
            now: 0,
            total: 0.0,
        }
    }

    fn tick(&mut self) -> bool {
        let robot = &mut self.robot;
        (robot.speed, robot.turn) = (0.0, 0.0);
        self.now += 1;
        self.battery -= 0.001;

        let side = robot.nearest_side();
        let mut ended = None;
        if !self.low {
            self.docking = false;
        }
        if self.low && self.docking {
            if robot.dock(-PI / 2.0) == Status::Success {
                (self.docking, ended) = (false, Some(Done::Dock));
            }
        } else if self.low {
            if robot.goto(C, 0.2, side) == Status::Success {
                (self.docking, ended) = (true, Some(Done::GotoC));
            }
        } else if self.carrying {
            if robot.goto(B, 0.15, side) == Status::Success {
                ended = Some(Done::GotoB);
            }
        } else if robot.goto(A, 0.15, side) == Status::Success {
            ended = Some(Done::GotoA);
        }

        let step = robot.swing();
        let end = [robot.x + step[0], robot.y + step[1]];
        if Robot::fits(end) {
            [robot.x, robot.y] = end;
        }

        let pickup = ended == Some(Done::GotoA) && !self.carrying;
        let dropoff = ended == Some(Done::GotoB) && self.carrying;
        let dead = self.battery <= 0.0;
        let reward = match (dead, pickup, dropoff) {
            (true, ..) => -5.0,
            (_, true, _) => 1.0,
            (_, _, true) => 2.0,
            _ => -0.1,
        };
        self.carrying = (self.carrying || pickup) && !dropoff;
        if ended == Some(Done::Dock) {
            self.battery = 1.0;
        }
        let low = self.battery <= 0.25;
        let changed = low != self.low;
        self.low = low;
        let over = dead || self.now == 5000;
        if changed || ended.is_some() || over {
            self.total += reward;
        }
        over
    }

    fn robot(&self) -> &Robot {
        &self.robot
    }

    fn total(&self) -> f64 {
        self.total
    }
}
