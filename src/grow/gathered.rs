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
use crate::learn::process::{Earned, End, Key, Process, World};
use crate::random::Random;
use crate::tree::Runner;
use crate::trial::play::Ticked;
use crate::world::{self, Start, Tick};
use rayon::prelude::*;

/// A decision with its outcome.
#[derive(Clone, Copy, Debug)]
pub(super) struct Taken {
    pub(super) from: Key,
    pub(super) choice: usize,
    pub(super) to: Key,
    pub(super) reward: f64,
    pub(super) ticks: u64,
    pub(super) status: Status,
    pub(super) end: End,
    /// Whether something went wrong, see [`Ground::harm`].
    pub(super) harmed: bool,
}

impl Taken {
    /// Whether it failed in its first tick.
    pub(super) fn is_refused(&self) -> bool {
        self.status == Status::Failure && self.ticks == 1
    }
}

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
                    let (end, driver) = gathered.follow(ground, process, &mut trip.runner);
                    if trip.is_over(driver) || random.unit() < HOME {
                        excursion = None;
                    }
                    end
                }
                None => gathered.follow(ground, process, controller).0,
            };
            if end != End::Not {
                gathered.ticks = process.ticks();
                return gathered;
            }
        }
    }

    fn visit(&mut self, key: Key) {
        if self.visits.last() != Some(&key) {
            self.visits.push(key);
        }
    }

    /// Ticks the controller until a decision is due. It is counted where one behaviour alone was ticked all along.
    fn follow<W: World>(
        &mut self,
        ground: &Ground<W>,
        process: &mut impl Process,
        controller: &mut impl Controller,
    ) -> (End, Option<(Id<Behavior>, Status)>) {
        let from = process.key();
        let patience = ground.patience.unwrap_or(u64::MAX);
        let mut ticks = 0;
        let mut driver: Option<(Id<Behavior>, Status)> = None;
        let mut alone = true;
        let mut earned = Earned::default();
        let broken = ground.broken(process.events());
        loop {
            process.begin_tick();
            let before = driver;
            let mut heard = Heard {
                process: &mut *process,
                calls: 0,
                driver,
            };
            controller.tick(&mut heard);
            let calls = heard.calls;
            driver = heard.driver;
            let tick = process.end_tick();
            ticks += 1;
            let same =
                before.is_none_or(|(behavior, _)| driver.is_some_and(|(b, _)| b == behavior));
            alone = alone && calls == 1 && same;
            let due = tick.terminated || tick.closed || process.key() != from || ticks >= patience;
            let Some(reward) = earned.after(&tick, due || tick.end.is_some()) else {
                continue;
            };
            let end = match tick.end {
                None => End::Not,
                Some(world::End::On(line)) => End::Terminal(line),
                Some(world::End::Cut) if due => End::Limit,
                Some(world::End::Cut) => End::Cut,
            };
            let choice = driver.and_then(|(behavior, _)| {
                ground.choices.iter().position(|choice| *choice == behavior)
            });
            if let (Some(choice), Some((_, status))) = (choice, driver) {
                self.visit(from);
                if alone {
                    self.taken.push(Taken {
                        from,
                        choice,
                        to: process.key(),
                        reward,
                        ticks,
                        status,
                        end,
                        harmed: tick.lost || ground.broken(process.events()) > broken,
                    });
                }
            } else {
                self.visit(from);
            }
            return (end, driver);
        }
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

    fn is_over(&self, driver: Option<(Id<Behavior>, Status)>) -> bool {
        match driver {
            None | Some((_, Status::Failure)) => true,
            Some((behavior, Status::Success)) => self.last == Some(behavior),
            Some(_) => false,
        }
    }
}

/// A process that notes which behaviours are ticked.
struct Heard<'p, P> {
    process: &'p mut P,
    calls: usize,
    driver: Option<(Id<Behavior>, Status)>,
}

impl<P: Process> Process for Heard<'_, P> {
    fn start(&mut self, start: Start) {
        self.process.start(start);
    }

    fn key(&self) -> Key {
        self.process.key()
    }

    fn atoms(&self) -> Key {
        self.process.atoms()
    }

    fn begin_tick(&mut self) {
        self.process.begin_tick();
    }

    fn act(&mut self, behavior: Id<Behavior>) -> Status {
        let status = self.process.act(behavior);
        self.calls += 1;
        self.driver = Some((behavior, status));
        status
    }

    fn end_tick(&mut self) -> Tick {
        self.process.end_tick()
    }

    fn ticks(&self) -> u64 {
        self.process.ticks()
    }

    fn events(&self) -> &[u64] {
        self.process.events()
    }
}
