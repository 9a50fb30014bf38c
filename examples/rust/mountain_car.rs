//! The car in the valley (Moore 1990), as MountainCar-v0 of Gymnasium has it: the engine is too weak to climb the hill on
//! the right, so the car must swing. A step costs 1, and there are at most 200.
//!
//! `cargo run --release --example mountain_car`

#[path = "seeds.rs"]
mod seeds;

use btc::{Ended, Environment, Outcome, Random, Status, Trainer, math};

/// Places along the valley, whose bottom is near −0.52: high on the left, to the left of the middle, up on the right.
const PLACES: [f64; 3] = [-0.9, -0.48, -0.2];
/// What counts as standing still.
const STILL: f64 = 0.0005;

const PREDICATES: [&str; 5] = ["moves_right", "stands", "high_left", "left", "high_right"];
const BEHAVIORS: [&str; 3] = ["push_left", "coast", "push_right"];
const STEPS: u64 = 200;

const ENGINE: f64 = 0.001;
const SLOPE: f64 = 0.0025;
const FASTEST: f64 = 0.07;
const LEFT: f64 = -1.2;
const RIGHT: f64 = 0.6;
const GOAL: f64 = 0.5;

/// The car: its place along the valley, its speed by step, and its engine.
#[derive(Clone, Debug, Default)]
struct MountainCar {
    x: f64,
    speed: f64,
    engine: f64,
}

impl Environment for MountainCar {
    fn start(&mut self, seed: u64) {
        *self = Self {
            x: Random::new(seed, 0, 0).uniform(-0.6, -0.4),
            ..Self::default()
        };
    }

    fn holds(&self, predicate: usize) -> bool {
        let [high_left, left, high_right] = PLACES;
        match PREDICATES.get(predicate).copied().unwrap_or_default() {
            "moves_right" => self.speed > 0.0,
            "stands" => self.speed.abs() < STILL,
            "high_left" => self.x < high_left,
            "left" => self.x < left,
            _ => self.x > high_right,
        }
    }

    fn act(&mut self, behavior: usize) -> Status {
        self.engine = behavior as f64 - 1.0;
        Status::Running
    }

    fn step(&mut self) -> Outcome {
        self.speed += ENGINE * self.engine - SLOPE * math::cos(3.0 * self.x);
        self.speed = self.speed.clamp(-FASTEST, FASTEST);
        self.x = (self.x + self.speed).clamp(LEFT, RIGHT);
        self.engine = 0.0;
        if self.x <= LEFT && self.speed < 0.0 {
            self.speed = 0.0;
        }
        if self.x >= GOAL && self.speed >= 0.0 {
            return Outcome::end(-1.0, Ended::Good);
        }
        Outcome::on(-1.0)
    }
}

fn main() -> Result<(), btc::Error> {
    let trainer = Trainer::new(MountainCar::default)
        .name("mountain_car")
        .predicates(PREDICATES)
        .behaviors(BEHAVIORS)
        .patience(10)
        .limit(STEPS)
        .explore(1.0, 0.4)
        .episodes(4000);
    seeds::show(&trainer, 3_000_000)
}
