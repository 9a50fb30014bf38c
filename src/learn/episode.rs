//! Whole episodes under a controller: a policy, a tree, or anything else that acts once a tick.

use super::process::{Earned, Process};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::world::{End, Gone, Start};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// What decides in each tick what a robot does.
pub trait Controller {
    /// Forgets everything: an episode starts.
    fn reset(&mut self);

    /// Ticks behaviours of the process, between its `begin_tick` and its `end_tick`.
    fn tick(&mut self, process: &mut impl Process);

    /// The behaviour that the controller would tick now, alone, and again as long as it runs and no atom changes. It may be
    /// ticked by another then, who says so by [`Controller::passed`] and [`Controller::answered`].
    fn steady(&mut self, _process: &impl Process) -> Option<Id<Behavior>> {
        None
    }

    /// The steady behaviour has been ticked in so many ticks, and has run in all of them.
    fn passed(&mut self, _ticks: u64) {}

    /// The steady behaviour has been ticked once more and has answered otherwise than that it runs: what else does the
    /// controller do in this tick?
    fn answered(&mut self, _process: &mut impl Process, _behavior: Id<Behavior>, _status: Status) {}

    /// In how many ticks since the last [`Controller::reset`] the controller had no decision of its own to follow.
    fn outside(&self) -> u64 {
        0
    }
}

/// The figures of an episode.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Episode {
    /// Its length.
    pub ticks: u64,
    /// The sum of the rewards of its transitions.
    pub total: f64,
    /// The reward of its last transition.
    pub last: f64,
    /// How often each event fired.
    pub events: Vec<u64>,
    /// Why it ended.
    pub end: End,
    /// Whether it ended badly, as the process says.
    pub lost: bool,
    /// Ticks in minterms that the controller was not made for.
    pub outside: u64,
}

/// Plays one episode. A transition, which is rewarded once, ends as a decision comes due: when a behaviour terminates,
/// the minterm changes, a rewarded event fires, or `patience` ticks have passed.
pub fn play(
    process: &mut impl Process,
    controller: &mut impl Controller,
    start: Start,
    patience: Option<u64>,
) -> Episode {
    process.start(start);
    controller.reset();
    let patience = patience.unwrap_or(u64::MAX);
    let (mut total, mut since) = (0.0, 0);
    let mut earned = Earned::default();
    loop {
        let outcome = if let Some(behavior) = controller.steady(process) {
            let most = patience.saturating_sub(since).max(1);
            let (ticks, gone) = process.go_on(behavior, most, &mut earned);
            since += ticks;
            match gone {
                Gone::Ended(tick) => {
                    controller.passed(ticks);
                    tick
                }
                Gone::Answered(status) => {
                    controller.passed(ticks - 1);
                    controller.answered(process, behavior, status);
                    process.end_tick()
                }
            }
        } else {
            process.begin_tick();
            controller.tick(process);
            since += 1;
            process.end_tick()
        };
        let due = outcome.terminated
            || outcome.changed
            || outcome.closed
            || outcome.end.is_some()
            || since >= patience;
        let Some(last) = earned.after(&outcome, due) else {
            continue;
        };
        total += last;
        since = 0;
        if let Some(end) = outcome.end {
            return Episode {
                ticks: process.ticks(),
                total,
                last,
                events: process.events().to_vec(),
                lost: outcome.lost,
                end,
                outside: controller.outside(),
            };
        }
    }
}

/// Plays n episodes from that of `start` on, on all threads; the result is in their order.
pub fn play_all<P: Process, C: Controller>(
    episodes: u64,
    start: Start,
    patience: Option<u64>,
    make: impl Fn() -> (P, C) + Sync + Send,
) -> Vec<Episode> {
    let played = play_each(episodes, start, patience, make, |_| ());
    played.into_iter().map(|(episode, ())| episode).collect()
}

/// Plays n episodes as [`play_all`] does; `asked` is what is wanted of the controller after each.
pub fn play_each<P: Process, C: Controller, T: Send>(
    episodes: u64,
    start: Start,
    patience: Option<u64>,
    make: impl Fn() -> (P, C) + Sync + Send,
    asked: impl Fn(&C) -> T + Sync + Send,
) -> Vec<(Episode, T)> {
    (0..episodes)
        .into_par_iter()
        .map_init(&make, |(process, controller), episode| {
            let start = Start {
                episode: start.episode + episode,
                ..start
            };
            let episode = play(process, controller, start, patience);
            (episode, asked(controller))
        })
        .collect()
}
