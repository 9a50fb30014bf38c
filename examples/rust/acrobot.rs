//! Two links that hang from a bar (Sutton 1996), as Acrobot-v1 of Gymnasium has them: a torque between them is to swing the
//! tip higher than one link above the bar. A step of 0.2 s costs 1, the last one nothing, and there are at most 500.
//!
//! `cargo run --release --example acrobot`

#[path = "seeds.rs"]
mod seeds;

use btc::{Ended, Environment, Outcome, Random, Status, Trainer, math};
use std::f64::consts::{FRAC_PI_2, PI};

/// What counts as swinging fast, in rad/s.
const FAST: f64 = 1.5;
/// What counts as high: the tip above the bar by so many metres.
const HIGH: f64 = 0.0;

const PREDICATES: [&str; 7] = [
    "hangs_right",
    "swings_right",
    "bends_right",
    "bend_grows_right",
    "tip_swings_right",
    "swings_fast",
    "high",
];
const BEHAVIORS: [&str; 3] = ["torque_left", "no_torque", "torque_right"];
const STEPS: u64 = 500;

/// Mass, length, place of the centre of mass and moment of inertia of either link.
const MASS: f64 = 1.0;
const LENGTH: f64 = 1.0;
const CENTRE: f64 = 0.5;
const INERTIA: f64 = 1.0;
const GRAVITY: f64 = 9.8;
const TICK: f64 = 0.2;
const FASTEST: [f64; 2] = [4.0 * PI, 9.0 * PI];

/// The angle of the first link from hanging, that of the second from the first, and their rates.
type State = [f64; 4];

/// The two links with the torque between them.
#[derive(Clone, Debug, Default)]
struct Acrobot {
    state: State,
    torque: f64,
}

impl Acrobot {
    /// The height of the tip above the bar.
    fn height(&self) -> f64 {
        let [first, second, ..] = self.state;
        -math::cos(first) - math::cos(first + second)
    }
}

/// The derivative of the state: the equations of Sutton and Barto's book.
fn derivative([a, b, da, db]: State, torque: f64) -> State {
    let (sin, cos) = (math::sin(b), math::cos(b));
    let squares = MASS * CENTRE * CENTRE;
    let arm = MASS * LENGTH * CENTRE;
    let d1 = squares + MASS * LENGTH * LENGTH + squares + 2.0 * arm * cos + 2.0 * INERTIA;
    let d2 = squares + arm * cos + INERTIA;
    let fall2 = MASS * CENTRE * GRAVITY * math::cos(a + b - FRAC_PI_2);
    let fall1 = -arm * db * db * sin - 2.0 * arm * db * da * sin
        + (MASS * CENTRE + MASS * LENGTH) * GRAVITY * math::cos(a - FRAC_PI_2)
        + fall2;
    let second = (torque + d2 / d1 * fall1 - arm * da * da * sin - fall2)
        / (squares + INERTIA - d2 * d2 / d1);
    let first = -(d2 * second + fall1) / d1;
    [da, db, first, second]
}

/// One step of the classical Runge-Kutta method.
fn runge_kutta(state: State, torque: f64) -> State {
    let moved = |by: &State, part: f64| {
        let mut moved = state;
        for (value, by) in moved.iter_mut().zip(by) {
            *value += part * by;
        }
        moved
    };
    let k1 = derivative(state, torque);
    let k2 = derivative(moved(&k1, TICK / 2.0), torque);
    let k3 = derivative(moved(&k2, TICK / 2.0), torque);
    let k4 = derivative(moved(&k3, TICK), torque);
    let mut sum = [0.0; 4];
    for (k, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
        for (sum, value) in sum.iter_mut().zip(k) {
            *sum += weight * value;
        }
    }
    moved(&sum, TICK / 6.0)
}

impl Environment for Acrobot {
    fn start(&mut self, seed: u64) {
        let mut random = Random::new(seed, 0, 0);
        self.state = [(); 4].map(|()| random.uniform(-0.1, 0.1));
        self.torque = 0.0;
    }

    fn holds(&self, predicate: usize) -> bool {
        let [a, b, da, db] = self.state;
        match PREDICATES.get(predicate).copied().unwrap_or_default() {
            "hangs_right" => a > 0.0,
            "swings_right" => da > 0.0,
            "bends_right" => b > 0.0,
            "bend_grows_right" => db > 0.0,
            "tip_swings_right" => da + db > 0.0,
            "swings_fast" => da.abs() > FAST,
            _ => self.height() > HIGH,
        }
    }

    fn act(&mut self, behavior: usize) -> Status {
        self.torque = behavior as f64 - 1.0;
        Status::Running
    }

    fn step(&mut self) -> Outcome {
        let [a, b, da, db] = runge_kutta(self.state, self.torque);
        let [most_first, most_second] = FASTEST;
        self.state = [
            math::wrap(a),
            math::wrap(b),
            da.clamp(-most_first, most_first),
            db.clamp(-most_second, most_second),
        ];
        self.torque = 0.0;
        if self.height() > LENGTH {
            return Outcome::end(0.0, Ended::Good);
        }
        Outcome::on(-1.0)
    }
}

fn main() -> Result<(), btc::Error> {
    let trainer = Trainer::new(Acrobot::default)
        .name("acrobot")
        .predicates(PREDICATES)
        .behaviors(BEHAVIORS)
        .patience(10)
        .limit(STEPS)
        .explore(1.0, 0.3)
        .episodes(2000);
    seeds::show(&trainer, 5_000_000)
}
