//! The decision process over the simulator.

use super::process::{Earned, Key, Process, World};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Status};
use crate::world::{Gone, Simulation, Simulator, Start, Tick};

/// What an episode's random numbers are for; the seeds of one purpose never meet those of another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Learning.
    Learn = 0,
    /// The greedy episodes that show the transitions of a policy.
    RollOut = 1,
    /// The points of a learning curve.
    Curve = 2,
    /// `btc run`, and testing claims on events.
    Run = 3,
    /// Finding the best of several runs of learning.
    Validate = 5,
    /// Testing a learned tree, on episodes that nothing was chosen by.
    Test = 6,
    /// Finding the best of a run's proposals.
    Propose = 7,
    /// Races between trees that grow.
    Grow = 16,
    /// Choosing among the trees that have grown.
    Confirm = 17,
    /// The figures of the tree that was chosen.
    Measure = 18,
    /// The search for better values of what may be tuned.
    Tune = 19,
    /// The second opinion on the values that were found.
    TuneConfirm = 20,
    /// The counts that trees grow by.
    Count = 21,
    /// Improving a policy.
    Improve = 22,
    /// Asking what it would be worth to see more.
    Probe = 23,
    /// Two trees that see different things against each other.
    Suggest = 24,
}

impl Purpose {
    /// The start of episode 0, from the first list of start lines, cut after `limit` ticks.
    pub fn start(self, seed: u64, limit: u64) -> Start {
        Start {
            seed,
            stream: self as u64,
            limit,
            ..Start::default()
        }
    }
}

impl Process for Simulation<'_> {
    #[inline]
    fn start(&mut self, start: Start) {
        Simulation::start(self, start);
    }

    #[inline]
    fn key(&self) -> Key {
        Simulation::key(self)
    }

    #[inline]
    fn atoms(&self) -> Key {
        Simulation::atoms(self)
    }

    #[inline]
    fn begin_tick(&mut self) {
        Simulation::begin_tick(self);
    }

    #[inline]
    fn act(&mut self, behavior: Id<Behavior>) -> Status {
        Simulation::act(self, behavior)
    }

    #[inline]
    fn end_tick(&mut self) -> Tick {
        Simulation::end_tick(self)
    }

    #[inline]
    fn go_on(&mut self, behavior: Id<Behavior>, most: u64, earned: &mut Earned) -> (u64, Gone) {
        Simulation::go_on(self, behavior, most, |flow| earned.flows(flow))
    }

    fn ticks(&self) -> u64 {
        Simulation::ticks(self)
    }

    fn events(&self) -> &[u64] {
        self.counts()
    }
}

impl World for Simulator {
    type Process<'w> = Simulation<'w>;

    fn process(&self) -> Simulation<'_> {
        self.simulation()
    }

    fn atoms(&self) -> &[Atom] {
        Simulator::atoms(self)
    }
}
