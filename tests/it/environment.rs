//! Worlds that a user's own program simulates, with the cart and pole of the examples among them.

use crate::snapshot;
use btc::environment::Hosted;
use btc::ir::Id;
use btc::ir::task::History;
use btc::ir::tree::Atom;
use btc::learn::process::{End, Process, World};
use btc::world::Start;
use btc::{Ended, Environment, LearnOptions, Outcome, Random, Status, Trained, Trainer};

#[allow(dead_code)]
#[path = "../../examples/rust/cart_pole.rs"]
mod cart_pole;

use cart_pole::CartPole;

/// Two packages are to be fetched, which takes three steps each, and delivered at once. Whether one is carried cannot be
/// seen; it may be dark, which changes nothing.
#[derive(Clone, Debug, Default)]
struct Courier {
    dark: bool,
    carries: bool,
    elapsed: u32,
    delivered: u32,
    failed: bool,
}

const FETCH: usize = 0;

impl Environment for Courier {
    fn start(&mut self, seed: u64) {
        *self = Self {
            dark: Random::new(seed, 0, 0).chance(0.5),
            ..Self::default()
        };
    }

    fn holds(&self, predicate: usize) -> bool {
        match predicate {
            0 => self.dark,
            _ => self.delivered > 0,
        }
    }

    fn begin(&mut self, _behavior: usize) {
        self.elapsed = 0;
    }

    fn act(&mut self, behavior: usize) -> Status {
        self.elapsed += 1;
        match (behavior, self.carries) {
            (FETCH, false) if self.elapsed < 3 => Status::Running,
            (FETCH, false) => {
                self.carries = true;
                Status::Success
            }
            (FETCH, true) | (_, false) => {
                self.failed = true;
                Status::Failure
            }
            (_, true) => {
                self.carries = false;
                self.delivered += 1;
                Status::Success
            }
        }
    }

    fn step(&mut self) -> Outcome {
        let failed = std::mem::take(&mut self.failed);
        match self.delivered {
            2 => Outcome::end(10.0, Ended::Good),
            _ if failed => Outcome::on(-3.0),
            _ => Outcome::on(-1.0),
        }
    }
}

fn courier() -> Trainer<fn() -> Courier> {
    Trainer::new(Courier::default as fn() -> Courier)
        .name("courier")
        .predicates(["dark", "one_delivered"])
        .behaviors(["fetch", "deliver"])
        .history(1)
        .limit(60)
        .episodes(400)
}

fn learned() -> Trained {
    let options = LearnOptions {
        effort: 40_000,
        roll_outs: 100,
        ..LearnOptions::default()
    };
    courier().learn(&options).unwrap()
}

#[test]
fn a_tree_is_learned_in_an_environment() {
    let trained = learned();
    let text = format!(
        "{}\n{}\n{}\n{}\n{}",
        trained.tree(),
        trained.exact(),
        trained.policy(),
        trained.q_table(),
        trained.report().join("\n")
    );
    snapshot::check("environment.courier", &text);
    // Nothing but the darkness is random, so every episode returns the same.
    let returns = courier().play(trained.tree(), 20, 7).unwrap();
    let best = returns.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert_eq!(best, trained.returns().mean);
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(learned)
    };
    let (one, three) = (on(1), on(3));
    assert_eq!(one.report(), three.report());
    assert_eq!(one.q_table(), three.q_table());
    assert_eq!(one.tree().to_string(), three.tree().to_string());
}

#[test]
fn every_step_of_a_decision_is_paid() {
    let atoms = vec![Atom::Predicate(Id::new(0)), Atom::Done(Id::new(0))];
    let history = History {
        window: 1,
        success: true,
        failure: true,
    };
    let world = Hosted::new(Courier::default, 2, atoms, history);
    let mut process = world.process();
    process.start(Start {
        limit: 5,
        ..Start::default()
    });
    let step = process.decide(Id::new(FETCH), Some(2), 0);
    assert_eq!(
        (step.reward, step.ticks, step.status),
        (-2.0, 2, Status::Running)
    );
    // The behaviour goes on where it was.
    let step = process.decide(Id::new(FETCH), None, 0);
    assert_eq!(
        (step.reward, step.ticks, step.status),
        (-1.0, 1, Status::Success)
    );
    assert_eq!(process.key() & 2, 2);
    let step = process.decide(Id::new(FETCH), None, 0);
    assert_eq!((step.reward, step.status), (-3.0, Status::Failure));
    assert_eq!((process.key() & 2, step.end), (0, End::Not));
    // The limit ends the episode as a decision is due.
    let step = process.decide(Id::new(1), None, 0);
    assert_eq!(
        (step.status, step.end, step.lost),
        (Status::Success, End::Limit, false)
    );
}

#[test]
fn a_bad_end_is_a_loss() {
    let world = Hosted::new(CartPole::default, 2, Vec::new(), History::default());
    let mut process = world.process();
    process.start(Start::default());
    let step = process.decide(Id::new(1), None, 0);
    assert_eq!((step.end, step.lost), (End::Terminal(2), true));
    assert_eq!(step.reward, step.ticks as f64);
}

/// From rest, upright: a push of 10 N gives the cart 9.756 m/s² and the pole −14.634 rad/s², by the equations of Barto,
/// Sutton and Anderson; the same push the other way stops both; the third push meets a pole that leans.
#[test]
fn the_cart_moves_as_computed_by_hand() {
    let mut cart = CartPole::default();
    let expected = [
        (1, [0.0, 0.195_121_951, 0.0, -0.292_682_927]),
        (0, [0.003_902_439, 0.0, -0.005_853_659, 0.0]),
        (
            1,
            [0.003_902_439, 0.195_205_410, -0.005_853_659, -0.294_524_064],
        ),
    ];
    for (behavior, [x, speed, angle, rate]) in expected {
        cart.act(behavior);
        assert_eq!(cart.step(), Outcome::on(1.0));
        for (is, should) in [
            (cart.x, x),
            (cart.speed, speed),
            (cart.angle, angle),
            (cart.rate, rate),
        ] {
            assert!((is - should).abs() < 1e-9, "{is} for {should}");
        }
    }
}

#[test]
fn unfit_names_and_numbers_are_refused() {
    let refused = |trainer: Trainer<fn() -> Courier>| {
        let options = LearnOptions::default();
        trainer.learn(&options).unwrap_err().to_string()
    };
    let nobody: [&str; 0] = [];
    assert_eq!(
        [
            refused(courier().behaviors(nobody)),
            refused(courier().behaviors(["fetch", "fetch"])),
            refused(courier().predicates((0..125).map(|i| format!("p{i}")))),
            refused(courier().limit(0)),
            refused(courier().discount(0.0)),
        ],
        [
            "there is no behaviour to choose",
            "`fetch` is named twice",
            "a minterm holds 128 atoms, these are 129",
            "an episode has at least one step",
            "the discount is above 0 and at most 1",
        ]
    );
    let other = Trainer::new(Courier::default).behaviors(["fetch"]);
    let why = other.play(learned().tree(), 1, 1).unwrap_err();
    assert_eq!(
        why.to_string(),
        "the tree is for an environment of other names"
    );
}
