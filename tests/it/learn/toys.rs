//! Small decision processes with known values.

use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::tree::Status;
use btc::learn::process::{End, Key, Process, Step};
use btc::random::Random;
use btc::world::{Start, Tick};

/// A process that is a function from state, choice and noise to what follows.
pub(crate) struct Toy<F> {
    /// State, choice, noise → next state, reward, ticks, end.
    rule: F,
    first: Key,
    state: Key,
    random: Random,
}

/// What a rule says: next state, reward, ticks, end.
pub(crate) type Said = (Key, f64, u64, End);

impl<F: FnMut(Key, usize, &mut Random) -> Said> Toy<F> {
    pub(crate) fn new(first: Key, rule: F) -> Self {
        Self {
            rule,
            first,
            state: first,
            random: Random::new(7, 0, 0),
        }
    }
}

impl<F: FnMut(Key, usize, &mut Random) -> Said> Process for Toy<F> {
    fn start(&mut self, _: Start) {
        self.state = self.first;
    }

    fn key(&self) -> Key {
        self.state
    }

    // A rule says how long a decision takes, so there are no ticks to go through one by one.
    fn begin_tick(&mut self) {
        unreachable!("decisions are taken whole");
    }

    fn act(&mut self, _: Id<Behavior>) -> Status {
        unreachable!("decisions are taken whole");
    }

    fn end_tick(&mut self) -> Tick {
        unreachable!("decisions are taken whole");
    }

    fn ticks(&self) -> u64 {
        0
    }

    fn decide(&mut self, behavior: Id<Behavior>, _: Option<u64>, _: u64) -> Step {
        let choice = behavior.index();
        let (to, reward, ticks, end) = (self.rule)(self.state, choice, &mut self.random);
        self.state = to;
        Step {
            to,
            status: Status::Running,
            reward,
            ticks,
            closed: false,
            lost: false,
            end,
        }
    }

    fn events(&self) -> &[u64] {
        &[]
    }
}

/// A corridor of five cells: choice 0 goes on, choice 1 goes back, choice 2 fails where it stands. A step costs 1; the
/// way out at the end of the corridor brings 10 and ends the episode.
pub(crate) fn corridor() -> Toy<impl FnMut(Key, usize, &mut Random) -> Said> {
    Toy::new(0, |cell, choice, _| match (cell, choice) {
        (4, 0) => (5, 10.0, 1, End::Terminal(0)),
        (_, 0) => (cell + 1, -1.0, 1, End::Not),
        (_, 1) => (cell.saturating_sub(1), -1.0, 1, End::Not),
        _ => (cell, -1.0, 1, End::Not),
    })
}

/// Two arms: one brings 0 or 2 by the toss of a coin, the other 0.5.
pub(crate) fn arms() -> Toy<impl FnMut(Key, usize, &mut Random) -> Said> {
    Toy::new(0, |_, choice, random| {
        let reward = match choice {
            0 if random.chance(0.5) => 2.0,
            0 => 0.0,
            _ => 0.5,
        };
        (1, reward, 1, End::Terminal(0))
    })
}

/// A single state that brings 1 in 20 ticks, after which the episode is over.
pub(crate) fn single(end: End) -> Toy<impl FnMut(Key, usize, &mut Random) -> Said> {
    Toy::new(0, move |_, _, _| (0, 1.0, 20, end))
}

/// A single state. Choice 0 brings 4 and ends the episode, but the limit cuts every second decision before it has; choice 1
/// is always cut.
pub(crate) fn often_cut() -> Toy<impl FnMut(Key, usize, &mut Random) -> Said> {
    let mut even = false;
    Toy::new(0, move |_, choice, _| {
        even = choice == 0 && !even;
        match even {
            true => (0, 4.0, 5, End::Terminal(0)),
            false => (0, -0.1, 20, End::Cut),
        }
    })
}

/// Maximisation bias (Sutton and Barto 2018, example 6.7): from state 0, choice 0 ends with 0 and choice 1 leads to
/// state 1, from where each of ten choices ends with noise of mean −0.1.
pub(crate) fn biased() -> Toy<impl FnMut(Key, usize, &mut Random) -> Said> {
    Toy::new(0, |state, choice, random| match (state, choice) {
        (0, 0) => (2, 0.0, 1, End::Terminal(0)),
        (0, _) => (1, 0.0, 1, End::Not),
        _ => (2, random.gaussian() - 0.1, 1, End::Terminal(0)),
    })
}
