//! Cart and pole (Barto, Sutton and Anderson 1983), as CartPole-v1 of Gymnasium has it: a cart is pushed to the left or to
//! the right so that the pole on it does not fall for 500 steps of 0.02 s.
//!
//! `cargo run --release --example cart_pole`

#[path = "seeds.rs"]
mod seeds;

use btc::{Ended, Environment, Outcome, Random, Status, Trainer, math};

/// How far ahead the pole's angle is predicted, in seconds.
const SOON: f64 = 0.2;
/// What counts as tipping, in radians, of this prediction.
const TIPPING: f64 = 0.05;
/// How far ahead the cart's place is predicted, in seconds.
const LATER: f64 = 1.0;
/// What counts as away from the middle, in metres, of this prediction.
const AWAY: f64 = 0.3;

const PREDICATES: [&str; 5] = [
    "leans_right",
    "tips_right",
    "tips_left",
    "leaves_right",
    "leaves_left",
];
const BEHAVIORS: [&str; 2] = ["push_left", "push_right"];
const STEPS: u64 = 500;

const GRAVITY: f64 = 9.8;
const CART: f64 = 1.0;
const POLE: f64 = 0.1;
/// Half the length of the pole in metres.
const HALF: f64 = 0.5;
const FORCE: f64 = 10.0;
const TICK: f64 = 0.02;
/// Where an episode ends, in metres and radians.
const EDGE: f64 = 2.4;
const FALLEN: f64 = 12.0 * std::f64::consts::PI / 180.0;

/// The cart with its pole.
#[derive(Clone, Debug, Default)]
pub struct CartPole {
    /// The place of the cart in metres, from the middle to the right.
    pub x: f64,
    /// Its speed in m/s.
    pub speed: f64,
    /// The angle of the pole in radians, from upright to the right.
    pub angle: f64,
    /// Its rate in rad/s.
    pub rate: f64,
    force: f64,
}

impl Environment for CartPole {
    fn start(&mut self, seed: u64) {
        let mut random = Random::new(seed, 0, 0);
        let mut draw = || random.uniform(-0.05, 0.05);
        let (x, speed, angle, rate) = (draw(), draw(), draw(), draw());
        *self = Self {
            x,
            speed,
            angle,
            rate,
            force: 0.0,
        };
    }

    fn holds(&self, predicate: usize) -> bool {
        let angle = self.angle + SOON * self.rate;
        let x = self.x + LATER * self.speed;
        match PREDICATES.get(predicate).copied().unwrap_or_default() {
            "leans_right" => angle > 0.0,
            "tips_right" => angle > TIPPING,
            "tips_left" => angle < -TIPPING,
            "leaves_right" => x > AWAY,
            _ => x < -AWAY,
        }
    }

    fn act(&mut self, behavior: usize) -> Status {
        self.force = if behavior == 0 { -FORCE } else { FORCE };
        Status::Running
    }

    fn step(&mut self) -> Outcome {
        let (sin, cos) = (math::sin(self.angle), math::cos(self.angle));
        let mass = CART + POLE;
        let pushed = (self.force + POLE * HALF * self.rate * self.rate * sin) / mass;
        let turning =
            (GRAVITY * sin - cos * pushed) / (HALF * (4.0 / 3.0 - POLE * cos * cos / mass));
        let acceleration = pushed - POLE * HALF * turning * cos / mass;
        self.x += TICK * self.speed;
        self.speed += TICK * acceleration;
        self.angle += TICK * self.rate;
        self.rate += TICK * turning;
        self.force = 0.0;
        if self.x.abs() > EDGE || self.angle.abs() > FALLEN {
            return Outcome::end(1.0, Ended::Bad);
        }
        Outcome::on(1.0)
    }
}

fn main() -> Result<(), btc::Error> {
    let trainer = Trainer::new(CartPole::default)
        .name("cart_pole")
        .predicates(PREDICATES)
        .behaviors(BEHAVIORS)
        .limit(STEPS)
        .episodes(500);
    seeds::show(&trainer, 2_000_000)
}
