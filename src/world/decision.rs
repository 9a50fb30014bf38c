//! One behaviour until a decision is due: an option (Sutton, Precup and Singh 1999).

use super::simulation::{End, Simulation};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;

/// What one decision led to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transition {
    /// The minterm found after it.
    pub key: u128,
    /// How the behaviour ended: running if something else made the next decision due.
    pub status: Status,
    /// The reward of its last tick.
    pub reward: f64,
    /// How many ticks it took.
    pub ticks: u64,
    /// Whether a rewarded event fired in its last tick.
    pub closed: bool,
    /// Whether the episode ended with it.
    pub end: Option<End>,
}

impl Simulation<'_> {
    /// Ticks a behaviour until a decision is due: it terminates, a rewarded event fires, the episode ends, `patience`
    /// ticks have passed, or the minterm is another than before, this last one only after `dwell` ticks.
    #[inline]
    pub fn run_option(
        &mut self,
        behavior: Id<Behavior>,
        patience: Option<u64>,
        dwell: u64,
    ) -> Transition {
        let from = self.key();
        let patience = patience.unwrap_or(u64::MAX);
        let mut ticks = 0;
        loop {
            self.begin_tick();
            let status = self.act(behavior);
            let tick = self.end_tick();
            ticks += 1;
            if tick.terminated
                || tick.closed
                || tick.end.is_some()
                || ticks >= patience
                || (ticks >= dwell && self.key() != from)
            {
                return Transition {
                    key: self.key(),
                    status,
                    reward: tick.reward,
                    ticks,
                    closed: tick.closed,
                    end: tick.end,
                };
            }
        }
    }
}
