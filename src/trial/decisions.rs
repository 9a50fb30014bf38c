//! What the decisions of an episode led to, as a tree or a policy took them tick by tick.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::learn::process::{Earned, End, Key, Process};
use crate::world::{self, Start, Tick};

/// A decision with its outcome.
#[derive(Clone, Copy, Debug)]
pub struct Taken {
    /// The minterm in which it was taken.
    pub from: Key,
    /// The place of the behaviour among the choices.
    pub choice: usize,
    /// The minterm found after it.
    pub to: Key,
    /// The reward of the transition.
    pub reward: f64,
    /// How many ticks it took.
    pub ticks: u64,
    /// How the behaviour stood at last.
    pub status: Status,
    /// Whether the episode went on.
    pub end: End,
    /// Whether it did harm, see [`Watch::never`].
    pub harmed: bool,
}

impl Taken {
    /// Whether it failed in its first tick.
    pub fn is_refused(&self) -> bool {
        self.status == Status::Failure && self.ticks == 1
    }
}

/// What counts as a decision, and what as harm.
#[derive(Clone, Copy, Debug)]
pub struct Watch<'w> {
    /// The behaviours to choose from.
    pub choices: &'w [Id<Behavior>],
    /// A decision is due after this many ticks without another reason.
    pub patience: Option<u64>,
    /// The events that are claimed never to happen; an episode that ends badly is harm, too.
    pub never: &'w [usize],
}

impl Watch<'_> {
    /// How many of the events that are claimed never to happen have happened, by how often each event has fired.
    pub fn broken(&self, events: &[u64]) -> u64 {
        let fired = |event: &&usize| events.get(**event).is_some_and(|count| *count > 0);
        self.never.iter().filter(fired).count() as u64
    }
}

/// What was driven last in a decision, with its answer.
pub type Driver = Option<(Id<Behavior>, Status)>;

/// A decision that is over.
#[derive(Clone, Copy, Debug)]
pub struct Over {
    /// The minterm in which it was taken.
    pub from: Key,
    /// What was ticked last.
    pub driver: Driver,
    /// Whether the episode goes on.
    pub end: End,
}

/// A process whose decisions are noted.
#[derive(Debug)]
pub struct Watched<'w, 'p, P> {
    process: &'p mut P,
    watch: Watch<'w>,
    from: Key,
    ticks: u64,
    driver: Driver,
    /// What was driven in the ticks before this one.
    before: Driver,
    calls: usize,
    alone: bool,
    earned: Earned,
    broken: u64,
    over: Option<Over>,
    taken: Vec<Taken>,
}

impl<'w, 'p, P: Process> Watched<'w, 'p, P> {
    /// A process of which nothing was noted.
    pub fn new(process: &'p mut P, watch: Watch<'w>) -> Self {
        let mut watched = Self {
            process,
            watch,
            from: 0,
            ticks: 0,
            driver: None,
            before: None,
            calls: 0,
            alone: true,
            earned: Earned::default(),
            broken: 0,
            over: None,
            taken: Vec::new(),
        };
        watched.next();
        watched
    }

    /// The decision that ended with the last tick, if one did.
    pub fn over(&mut self) -> Option<Over> {
        self.over.take()
    }

    /// The decisions that one behaviour alone was ticked in, since the episode started.
    pub fn into_taken(self) -> Vec<Taken> {
        self.taken
    }

    /// The next decision begins.
    fn next(&mut self) {
        self.from = self.process.key();
        self.ticks = 0;
        self.driver = None;
        self.alone = true;
        self.earned = Earned::default();
        self.broken = self.watch.broken(self.process.events());
    }

    fn note(&mut self, tick: &Tick) {
        self.ticks += 1;
        let driven = self.driver;
        let same = self
            .before
            .is_none_or(|(behavior, _)| driven.is_some_and(|(b, _)| b == behavior));
        self.alone = self.alone && self.calls == 1 && same;
        let to = self.process.key();
        let patience = self.watch.patience.unwrap_or(u64::MAX);
        let due = tick.terminated || tick.closed || to != self.from || self.ticks >= patience;
        let Some(reward) = self.earned.after(tick, due || tick.end.is_some()) else {
            return;
        };
        let end = match tick.end {
            None => End::Not,
            Some(world::End::On(line)) => End::Terminal(line),
            Some(world::End::Cut) if due => End::Limit,
            Some(world::End::Cut) => End::Cut,
        };
        let place = |behavior| {
            self.watch
                .choices
                .iter()
                .position(|choice| *choice == behavior)
        };
        let taken = driven
            .filter(|_| self.alone)
            .and_then(|(behavior, status)| {
                Some(Taken {
                    from: self.from,
                    choice: place(behavior)?,
                    to,
                    reward,
                    ticks: self.ticks,
                    status,
                    end,
                    harmed: tick.lost || self.watch.broken(self.process.events()) > self.broken,
                })
            });
        self.taken.extend(taken);
        self.over = Some(Over {
            from: self.from,
            driver: driven,
            end,
        });
        self.next();
    }
}

impl<P: Process> Process for Watched<'_, '_, P> {
    fn start(&mut self, start: Start) {
        self.process.start(start);
        self.taken.clear();
        self.next();
    }

    fn key(&self) -> Key {
        self.process.key()
    }

    fn atoms(&self) -> Key {
        self.process.atoms()
    }

    fn begin_tick(&mut self) {
        self.before = self.driver;
        self.calls = 0;
        self.process.begin_tick();
    }

    fn act(&mut self, behavior: Id<Behavior>) -> Status {
        let status = self.process.act(behavior);
        self.calls += 1;
        self.driver = Some((behavior, status));
        status
    }

    fn end_tick(&mut self) -> Tick {
        let tick = self.process.end_tick();
        self.note(&tick);
        tick
    }

    fn ticks(&self) -> u64 {
        self.process.ticks()
    }

    fn events(&self) -> &[u64] {
        self.process.events()
    }
}
