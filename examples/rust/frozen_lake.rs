//! The frozen lake, as FrozenLake-v1 of Gymnasium has it (4 × 4, slippery): from the upper left to the lower right without
//! falling into a hole. A step goes where it should, or to either side of that, each in a third of all cases. The goal
//! pays 1, nothing else pays, and there are at most 100 steps.
//!
//! `cargo run --release --example frozen_lake`

#[path = "seeds.rs"]
mod seeds;

use btc::{Ended, Environment, Outcome, Random, Status, Trainer};

const WIDTH: usize = 4;
/// The cells row by row: start, frozen, hole, goal.
const LAKE: &[u8] = b"SFFFFHFHFFFHHFFG";

const PREDICATES: [&str; 8] = [
    "row_1", "row_2", "row_3", "row_4", "column_1", "column_2", "column_3", "column_4",
];
/// Each is a quarter turn to the left of the one before.
const BEHAVIORS: [&str; 4] = ["left", "down", "right", "up"];
const STEPS: u64 = 100;

/// The cell that a step to this side of a cell leads to.
fn beside(cell: usize, side: usize) -> usize {
    let (row, column) = (cell / WIDTH, cell % WIDTH);
    match side % 4 {
        0 if column > 0 => cell - 1,
        1 if row + 1 < WIDTH => cell + WIDTH,
        2 if column + 1 < WIDTH => cell + 1,
        3 if row > 0 => cell - WIDTH,
        _ => cell,
    }
}

/// What a cell pays to whom it ends an episode for.
fn ends(cell: usize) -> Option<f64> {
    match LAKE.get(cell) {
        Some(b'G') => Some(1.0),
        Some(b'H') => Some(0.0),
        _ => None,
    }
}

/// The greatest share of episodes that can reach the goal, by backward induction over the table.
fn optimum() -> f64 {
    let mut values = vec![0.0; LAKE.len()];
    for _ in 0..STEPS {
        let value = |cell: usize| ends(cell).unwrap_or(values.get(cell).copied().unwrap_or(0.0));
        let worth = |cell: usize, side: usize| {
            let sides = [side + 3, side, side + 1].map(|side| value(beside(cell, side)));
            sides.iter().sum::<f64>() / 3.0
        };
        let best = |cell| (0..4).map(|side| worth(cell, side)).fold(0.0, f64::max);
        values = (0..LAKE.len()).map(best).collect();
    }
    values.first().copied().unwrap_or(0.0)
}

/// A walker on the lake.
#[derive(Debug)]
struct FrozenLake {
    cell: usize,
    side: Option<usize>,
    random: Random,
}

impl FrozenLake {
    fn new() -> Self {
        Self {
            cell: 0,
            side: None,
            random: Random::new(0, 0, 0),
        }
    }
}

impl Environment for FrozenLake {
    fn start(&mut self, seed: u64) {
        *self = Self {
            random: Random::new(seed, 0, 0),
            ..Self::new()
        };
    }

    fn holds(&self, predicate: usize) -> bool {
        if predicate < WIDTH {
            self.cell / WIDTH == predicate
        } else {
            self.cell % WIDTH == predicate - WIDTH
        }
    }

    fn act(&mut self, behavior: usize) -> Status {
        self.side = Some(behavior);
        Status::Running
    }

    fn step(&mut self) -> Outcome {
        if let Some(side) = self.side.take() {
            let slip = self.random.below(3) as usize;
            self.cell = beside(self.cell, side + 3 + slip);
        }
        match ends(self.cell) {
            Some(reward) if reward > 0.0 => Outcome::end(reward, Ended::Good),
            Some(reward) => Outcome::end(reward, Ended::Neutral),
            None => Outcome::on(0.0),
        }
    }
}

fn main() -> Result<(), btc::Error> {
    let trainer = Trainer::new(FrozenLake::new)
        .name("frozen_lake")
        .predicates(PREDICATES)
        .behaviors(BEHAVIORS)
        .limit(STEPS)
        .discount(1.0)
        .episodes(5000);
    seeds::show(&trainer, 3_000_000)?;
    println!("the optimum of the table is {:.3}", optimum());
    Ok(())
}
