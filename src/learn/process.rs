//! The decision process as a learner or a tree sees it (semi-Markov: Sutton, Precup and Singh 1999).
//!
//! Nothing above this trait needs to know what is behind it: btc's simulator or an environment of a user's own.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Status};
use crate::world::{self, Gone, Start, Tick};

/// A minterm in a machine word: bit i is the i-th atom.
pub type Key = u128;

/// A process to decide over, tick by tick. A tick is [`Process::begin_tick`], any number of [`Process::act`], of which at
/// most the last may go on running, and [`Process::end_tick`].
pub trait Process {
    /// Starts an episode; the same start is the same episode again.
    fn start(&mut self, start: Start);

    /// The minterm that holds now: the atoms that a policy decides by.
    fn key(&self) -> Key;

    /// Every atom that a tree may ask now.
    fn atoms(&self) -> Key {
        self.key()
    }

    /// Begins a tick.
    fn begin_tick(&mut self);

    /// Ticks a behaviour. A behaviour that was ticked in the tick before and did not terminate goes on, any other starts.
    fn act(&mut self, behavior: Id<Behavior>) -> Status;

    /// Ends a tick: the world moves on.
    fn end_tick(&mut self) -> Tick;

    /// Goes on with a behaviour alone, for at most `most` ticks and at least one: until it answers otherwise than that it
    /// runs, or a tick ends that may matter to whoever decides. `earned` takes in all ticks before the last. Also says how
    /// many ticks have begun.
    #[inline]
    fn go_on(&mut self, behavior: Id<Behavior>, most: u64, earned: &mut Earned) -> (u64, Gone) {
        // One tick is enough: what is due is seen by whoever asks.
        let _ = (most, earned);
        self.begin_tick();
        let gone = match self.act(behavior) {
            Status::Running => Gone::Ended(self.end_tick()),
            status => Gone::Answered(status),
        };
        (1, gone)
    }

    /// How many ticks of the episode have begun.
    fn ticks(&self) -> u64;

    /// How often each event of the program has fired in this episode.
    fn events(&self) -> &[u64];

    /// Ticks a behaviour until a decision is due: it terminates, a rewarded event fires, the episode ends, `patience`
    /// ticks have passed, or the minterm is another than before, this last one only after `dwell` ticks.
    #[inline]
    fn decide(&mut self, behavior: Id<Behavior>, patience: Option<u64>, dwell: u64) -> Step {
        let from = self.key();
        let patience = patience.unwrap_or(u64::MAX);
        let mut ticks = 0;
        let mut earned = Earned::default();
        loop {
            // Where the minterm is another already, the decision is due after `dwell` ticks.
            let last = match self.key() == from {
                true => patience,
                false => patience.min(dwell),
            };
            let most = last.saturating_sub(ticks).max(1);
            let (gone_on, gone) = self.go_on(behavior, most, &mut earned);
            ticks += gone_on;
            let (status, tick) = match gone {
                Gone::Answered(status) => (status, self.end_tick()),
                Gone::Ended(tick) => (Status::Running, tick),
            };
            let due = tick.terminated
                || tick.closed
                || ticks >= patience
                || (ticks >= dwell && self.key() != from);
            if let Some(reward) = earned.after(&tick, due || tick.end.is_some()) {
                return Step {
                    to: self.key(),
                    status,
                    reward,
                    ticks,
                    closed: tick.closed,
                    lost: tick.lost,
                    end: match tick.end {
                        None => End::Not,
                        Some(world::End::On(line)) => End::Terminal(line),
                        Some(world::End::Cut) if due => End::Limit,
                        Some(world::End::Cut) => End::Cut,
                    },
                };
            }
        }
    }
}

/// The reward of a transition while it goes on: what its ticks pay, and at its end what the transition pays.
#[derive(Clone, Copy, Debug, Default)]
pub struct Earned(f64);

impl Earned {
    /// Takes in what a tick pays, whatever happens in it.
    #[inline]
    pub fn flows(&mut self, flow: f64) {
        self.0 += flow;
    }

    /// Takes in a tick. Where the transition ends with it, gives the transition's reward and begins the next.
    #[inline]
    pub fn after(&mut self, tick: &Tick, due: bool) -> Option<f64> {
        self.flows(tick.flow);
        due.then(|| std::mem::take(&mut self.0) + tick.reward)
    }
}

/// A world that processes run in; it is shared between threads.
pub trait World: Sync {
    /// A process in this world.
    type Process<'w>: Process
    where
        Self: 'w;

    /// A process that has not started.
    fn process(&self) -> Self::Process<'_>;

    /// What the bits of [`Process::atoms`] mean; those of a minterm come first.
    fn atoms(&self) -> &[Atom];
}

/// What a decision led to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The minterm found after it.
    pub to: Key,
    /// How the behaviour stood when the next decision came due.
    pub status: Status,
    /// The reward of the transition.
    pub reward: f64,
    /// How many ticks it took.
    pub ticks: u64,
    /// Whether a rewarded event fired in its last tick.
    pub closed: bool,
    /// Whether the episode ended badly.
    pub lost: bool,
    /// Whether the episode goes on.
    pub end: End,
}

/// Whether and how an episode ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// It goes on.
    Not,
    /// This line of the task's `end on`, counted from zero, ended it: nothing follows.
    Terminal(usize),
    /// The tick limit cut it as a decision was due: the value of what would follow still counts.
    Limit,
    /// The tick limit cut it, and the decision with it: how that would have ended is unknown.
    Cut,
}
