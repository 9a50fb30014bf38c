//! The taxi (Dietterich 2000), as Taxi-v3 of Gymnasium has it: a passenger waits at one of four stops and wants to go to
//! another. A step costs 1, picking up or dropping off in the wrong place 10; arriving pays 20. There are at most 200
//! steps.
//!
//! The behaviours drive to a stop by a shortest way, so what is learned is when to go where.
//!
//! `cargo run --release --example taxi`

#[path = "seeds.rs"]
mod seeds;

use btc::{Ended, Environment, Outcome, Random, Status, Trainer};

/// Five rows of five cells; a bar between two cells is a wall.
const MAP: [&[u8]; 5] = [
    b"| : | : : |",
    b"| : | : : |",
    b"| : : : : |",
    b"| | : | : |",
    b"| | : | : |",
];
const SIZE: usize = 5;
const CELLS: usize = SIZE * SIZE;
/// The cells of the stops: red, green, yellow, blue.
const STOPS: [usize; 4] = [0, 4, 20, 23];
/// The place of the passenger in the taxi, after those of the stops.
const ABOARD: usize = 4;

const PREDICATES: [&str; 10] = [
    "waits_red",
    "waits_green",
    "waits_yellow",
    "waits_blue",
    "aboard",
    "to_red",
    "to_green",
    "to_yellow",
    "to_blue",
    "arrived",
];
const BEHAVIORS: [&str; 6] = [
    "go_red",
    "go_green",
    "go_yellow",
    "go_blue",
    "pick_up",
    "drop_off",
];
const STEPS: u64 = 200;

/// A state of the table: the cell of the taxi, the place of the passenger, the stop to go to.
#[derive(Clone, Copy, Debug, Default)]
struct State {
    cell: usize,
    passenger: usize,
    to: usize,
}

/// What can be done in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Action {
    South,
    North,
    East,
    West,
    PickUp,
    DropOff,
}

const ACTIONS: [Action; 6] = [
    Action::South,
    Action::North,
    Action::East,
    Action::West,
    Action::PickUp,
    Action::DropOff,
];

/// The cell that a move leads to; the same one where a wall is.
fn moved(cell: usize, action: Action) -> usize {
    let (row, column) = (cell / SIZE, cell % SIZE);
    let open = |at: usize| MAP.get(row).and_then(|row| row.get(at)) == Some(&b':');
    match action {
        Action::South if row + 1 < SIZE => cell + SIZE,
        Action::North if row > 0 => cell - SIZE,
        Action::East if open(2 * column + 2) => cell + 1,
        Action::West if open(2 * column) => cell - 1,
        _ => cell,
    }
}

/// A row of the table: what an action leads to, what it pays, and whether the passenger has arrived.
fn next(state: State, action: Action) -> (State, f64, bool) {
    let here = STOPS.iter().position(|stop| *stop == state.cell);
    let mut next = state;
    match (action, here) {
        (Action::PickUp, Some(stop)) if state.passenger == stop => next.passenger = ABOARD,
        (Action::DropOff, Some(stop)) if state.passenger == ABOARD => {
            next.passenger = stop;
            if stop == state.to {
                return (next, 20.0, true);
            }
        }
        (Action::PickUp | Action::DropOff, _) => return (state, -10.0, false),
        _ => next.cell = moved(state.cell, action),
    }
    (next, -1.0, false)
}

/// The steps to a stop from each cell.
fn distances(stop: usize) -> [usize; CELLS] {
    let mut steps = [CELLS; CELLS];
    for _ in 0..CELLS {
        let near = |cell: usize| {
            let sides = ACTIONS.iter().take(4).map(|action| moved(cell, *action));
            let nearest = sides.filter_map(|side| steps.get(side)).min();
            nearest.map_or(CELLS, |steps| steps + 1)
        };
        let all: [usize; CELLS] =
            std::array::from_fn(|cell| if cell == stop { 0 } else { near(cell) });
        steps = all;
    }
    steps
}

/// The greatest mean return of an episode, by backward induction over the table.
fn optimum() -> f64 {
    let state = |number: usize| State {
        cell: number / 20,
        passenger: number / 4 % 5,
        to: number % 4,
    };
    let number = |state: State| (state.cell * 5 + state.passenger) * 4 + state.to;
    let mut values = vec![0.0; CELLS * 20];
    for _ in 0..STEPS {
        let worth = |from: State, action: Action| {
            let (to, reward, arrived) = next(from, action);
            let follows = values.get(number(to)).copied().unwrap_or(0.0);
            reward + if arrived { 0.0 } else { follows }
        };
        let best = |from| {
            ACTIONS
                .iter()
                .map(|action| worth(from, *action))
                .fold(f64::NEG_INFINITY, f64::max)
        };
        values = (0..CELLS * 20).map(|n| best(state(n))).collect();
    }
    let starts = (0..CELLS * 20).map(state);
    let starts = starts.filter(|start| start.passenger != ABOARD && start.passenger != start.to);
    let starts: Vec<f64> = starts
        .filter_map(|start| values.get(number(start)).copied())
        .collect();
    starts.iter().sum::<f64>() / starts.len() as f64
}

/// The taxi, with the way to each stop.
#[derive(Clone, Debug)]
struct Taxi {
    state: State,
    action: Option<Action>,
    ways: [[usize; CELLS]; 4],
}

impl Taxi {
    fn new() -> Self {
        Self {
            state: State::default(),
            action: None,
            ways: STOPS.map(distances),
        }
    }

    /// The first step of a shortest way to a stop.
    fn towards(&self, stop: usize) -> Option<Action> {
        let steps = |cell: usize| self.ways.get(stop).and_then(|way| way.get(cell)).copied();
        let here = steps(self.state.cell)?;
        let nearer =
            |action: &Action| steps(moved(self.state.cell, *action)).is_some_and(|s| s < here);
        ACTIONS.into_iter().take(4).find(nearer)
    }
}

impl Environment for Taxi {
    fn start(&mut self, seed: u64) {
        let mut random = Random::new(seed, 0, 0);
        let mut below = |n: usize| random.below(n as u64) as usize;
        let (cell, passenger, other) = (below(CELLS), below(4), below(3));
        self.state = State {
            cell,
            passenger,
            to: other + usize::from(other >= passenger),
        };
        self.action = None;
    }

    fn holds(&self, predicate: usize) -> bool {
        let State {
            cell,
            passenger,
            to,
        } = self.state;
        let wanted = if passenger == ABOARD { to } else { passenger };
        match predicate {
            0..=4 => passenger == predicate,
            5..=8 => to == predicate - 5,
            _ => STOPS.get(wanted) == Some(&cell),
        }
    }

    fn act(&mut self, behavior: usize) -> Status {
        self.action = match behavior {
            0..=3 => self.towards(behavior),
            4 => Some(Action::PickUp),
            _ => Some(Action::DropOff),
        };
        Status::Running
    }

    /// A taxi that stays where it is pays for the step like any other.
    fn step(&mut self) -> Outcome {
        let Some(action) = self.action.take() else {
            return Outcome::on(-1.0);
        };
        let (state, reward, arrived) = next(self.state, action);
        self.state = state;
        match arrived {
            true => Outcome::end(reward, Ended::Good),
            false => Outcome::on(reward),
        }
    }
}

fn main() -> Result<(), btc::Error> {
    let taxi = Taxi::new();
    let trainer = Trainer::new(|| taxi.clone())
        .name("taxi")
        .predicates(PREDICATES)
        .behaviors(BEHAVIORS)
        .patience(10)
        .limit(STEPS)
        .episodes(3000);
    seeds::show(&trainer, 2_000_000)?;
    println!("the optimum of the table is {:.3}", optimum());
    Ok(())
}
