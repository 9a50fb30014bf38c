//! Playing to count: what decisions lead to under a tree or a policy that goes on excursions.
//!
//! Single random decisions seldom get anywhere: a far place is reached by many alike. So what explores is a behaviour, or a
//! small tree, that is followed until it is done.

use super::bodies::bodies;
use super::evidence::Evidence;
use super::ground::Ground;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Node, Status};
use crate::learn::episode::Controller;
use crate::learn::process::{End, Key, Process, World};
use crate::random::Random;
use crate::tree::Runner;
use crate::trial::decisions::{Driver, Taken, Watched};
use crate::trial::play::Ticked;
use crate::world::Start;
use rayon::prelude::*;

/// What one episode gave.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    pub(super) taken: Vec<Taken>,
    /// The minterms, in the order in which they were entered.
    pub(super) visits: Vec<Key>,
    pub(super) ticks: u64,
}

/// The stream of the random choices, apart from those of the world.
const EXPLORATION: u64 = 1 << 40;

impl Gathered {
    /// Plays as many episodes more as are left of so many ticks, at the length of those before, on all threads; at most 200.
    pub(super) fn batch<W: World>(
        ground: &Ground<W>,
        controller: &(impl Controller + Clone + Sync),
        exploring: (f64, &[Excursion]),
        (start, from): (Start, u64),
        (ticks, used): (u64, u64),
    ) -> Vec<Self> {
        let length = used.checked_div(from).unwrap_or(start.limit);
        let due = (ticks.saturating_sub(used) / length.max(1)).clamp(1, 200);
        let episodes = (from..from + due).into_par_iter();
        episodes
            .map(|n| {
                let start = Start {
                    episode: start.episode + n,
                    ..start
                };
                let mut process = ground.world.process();
                Self::of(
                    ground,
                    &mut process,
                    &mut controller.clone(),
                    exploring,
                    start,
                )
            })
            .collect()
    }

    /// Plays an episode. A part `explore` of the decisions begins an excursion.
    pub(super) fn of<W: World>(
        ground: &Ground<W>,
        process: &mut impl Process,
        controller: &mut impl Controller,
        (explore, excursions): (f64, &[Excursion]),
        start: Start,
    ) -> Self {
        let mut random = Random::new(start.seed, EXPLORATION + start.stream, start.episode);
        let mut gathered = Self::default();
        let mut process = Watched::new(process, ground.watch());
        process.start(start);
        controller.reset();
        let mut excursion: Option<Excursion> = None;
        loop {
            if excursion.is_none() && random.unit() < explore {
                controller.reset();
                let at = random.below(excursions.len() as u64) as usize;
                excursion = excursions.get(at).cloned();
            }
            let end = match &mut excursion {
                Some(trip) => {
                    let (end, driver) = gathered.follow(&mut process, &mut trip.runner);
                    if trip.is_over(driver) || random.unit() < HOME {
                        excursion = None;
                    }
                    end
                }
                None => gathered.follow(&mut process, controller).0,
            };
            if end != End::Not {
                gathered.ticks = process.ticks();
                gathered.taken = process.into_taken();
                return gathered;
            }
        }
    }

    /// Ticks the controller until a decision is over.
    fn follow(
        &mut self,
        process: &mut Watched<impl Process>,
        controller: &mut impl Controller,
    ) -> (End, Driver) {
        let over = loop {
            process.begin_tick();
            controller.tick(process);
            process.end_tick();
            if let Some(over) = process.over() {
                break over;
            }
        };
        if self.visits.last() != Some(&over.from) {
            self.visits.push(over.from);
        }
        (over.end, over.driver)
    }
}

/// The part of the decisions of an excursion after which it is given up.
const HOME: f64 = 0.1;

/// A way to explore: a small tree that is followed until it is done, or fails.
#[derive(Clone, Debug)]
pub(super) struct Excursion {
    runner: Ticked,
    /// The behaviour that ends it when it succeeds.
    last: Option<Id<Behavior>>,
}

impl Excursion {
    /// A behaviour each, and what the counts suggest that behaviours need.
    pub(super) fn all<W: World>(ground: &Ground<W>, evidence: &Evidence) -> Vec<Self> {
        let bodies = bodies(ground, evidence).into_iter();
        let remembers = |node: &Node| matches!(node, Node::Composite { memory: true, .. });
        let bodies = bodies.filter(|body| !remembers(body));
        bodies
            .filter_map(|body| {
                let mut last = None;
                body.visit_behaviors(&mut |behavior| last = last.or(Some(behavior)));
                Some(Self {
                    runner: Ticked(Runner::new(&body, ground.world.atoms()).ok()?),
                    last,
                })
            })
            .collect()
    }

    fn is_over(&self, driver: Driver) -> bool {
        match driver {
            None | Some((_, Status::Failure)) => true,
            Some((behavior, Status::Success)) => self.last == Some(behavior),
            Some(_) => false,
        }
    }
}
