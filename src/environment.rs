//! A world that a user's own program simulates, as a process to learn in.

use crate::ir::Id;
use crate::ir::history::Window;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Status};
use crate::learn::process::{Key, Process, World};
use crate::random::Random;
use crate::world::{End, Start, Tick};

/// A simulated world with its predicates and behaviours, which are counted from zero in the order in which a
/// [`Trainer`](crate::Trainer) names them.
///
/// A step is: some behaviours are asked to [`act`](Self::act), of which at most the last goes on running, then the world
/// makes one [`step`](Self::step). A decision is due whenever a predicate changes or a behaviour terminates.
pub trait Environment {
    /// Starts an episode. Everything must follow from the seed: the same seed is the same episode again, whatever was
    /// done before. Different seeds are unrelated, so the seed may go into any generator of random numbers.
    fn start(&mut self, seed: u64);

    /// Whether a predicate holds now.
    fn holds(&self, predicate: usize) -> bool;

    /// A behaviour starts: it was not ticked in the step before, or it terminated there. [`act`](Self::act) follows.
    fn begin(&mut self, _behavior: usize) {}

    /// Sets what a behaviour does in this step. The world must not move yet.
    ///
    /// A behaviour that goes on is [`Status::Running`]. If it terminates instead, another may be asked to act in the same
    /// step, and what that one sets replaces what this one has set.
    fn act(&mut self, behavior: usize) -> Status;

    /// The world moves on by one step, under what was set since the last one; nothing was set if all behaviours that
    /// were asked terminated without setting anything.
    fn step(&mut self) -> Outcome;
}

/// What a step led to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// The reward of this step, in any unit; the sum over an episode is its return.
    pub reward: f64,
    /// Whether the episode ended with it. An episode that reaches the limit of steps is cut by btc: what would have
    /// followed still counts, so a limit of the environment's own must not be an end.
    pub end: Option<Ended>,
}

impl Outcome {
    /// The episode goes on.
    pub fn on(reward: f64) -> Self {
        Self { reward, end: None }
    }

    /// The episode ends.
    pub fn end(reward: f64, end: Ended) -> Self {
        Self {
            reward,
            end: Some(end),
        }
    }
}

/// How an episode ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// The goal was reached.
    Good,
    /// Neither good nor bad.
    Neutral,
    /// Something went wrong. Of two trees the one that does less harm is preferred, whatever they return.
    Bad,
}

impl Ended {
    /// All of them, in the order of the lines of a task.
    pub(crate) const ALL: [Self; 3] = [Self::Good, Self::Neutral, Self::Bad];

    /// What reports call it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Good => "a good end",
            Self::Neutral => "a neutral end",
            Self::Bad => "a bad end",
        }
    }
}

/// The world of environments that `make` makes, one for each thread.
#[derive(Debug)]
pub struct Hosted<F> {
    make: F,
    behaviors: usize,
    atoms: Vec<Atom>,
    history: History,
}

impl<F> Hosted<F> {
    /// A world with so many behaviours and these atoms: all predicates, then what the history remembers.
    pub fn new(make: F, behaviors: usize, atoms: Vec<Atom>, history: History) -> Self {
        Self {
            make,
            behaviors,
            atoms,
            history,
        }
    }
}

impl<E: Environment, F: Fn() -> E + Sync> World for Hosted<F> {
    type Process<'w>
        = Episode<'w, E>
    where
        Self: 'w;

    fn process(&self) -> Episode<'_, E> {
        Episode {
            environment: (self.make)(),
            atoms: &self.atoms,
            window: Window::new(self.history),
            terminations: Vec::new(),
            until: vec![0; self.behaviors],
            key: 0,
            ticks: 0,
            limit: u64::MAX,
        }
    }

    fn atoms(&self) -> &[Atom] {
        &self.atoms
    }
}

/// An episode of an environment.
#[derive(Debug)]
pub struct Episode<'w, E> {
    environment: E,
    atoms: &'w [Atom],
    window: Window,
    terminations: Vec<(Id<Behavior>, Status)>,
    /// The last tick in which ticking a behaviour would resume it, for each.
    until: Vec<u64>,
    key: Key,
    ticks: u64,
    limit: u64,
}

impl<E: Environment> Episode<'_, E> {
    fn look(&self) -> Key {
        let holds = |atom: &Atom| match atom {
            Atom::Predicate(id) => self.environment.holds(id.index()),
            Atom::Done(_) | Atom::Failed(_) => self.window.shows(*atom),
        };
        let bits = self.atoms.iter().enumerate();
        bits.fold(0, |key, (bit, atom)| key | Key::from(holds(atom)) << bit)
    }
}

impl<E: Environment> Process for Episode<'_, E> {
    fn start(&mut self, start: Start) {
        self.window.clear();
        self.terminations.clear();
        self.until.fill(0);
        self.ticks = 0;
        self.limit = start.limit;
        let seed = Random::new(start.seed, start.stream, start.episode).word();
        self.environment.start(seed);
        self.key = self.look();
    }

    fn key(&self) -> Key {
        self.key
    }

    fn begin_tick(&mut self) {
        self.ticks += 1;
        self.terminations.clear();
    }

    fn act(&mut self, behavior: Id<Behavior>) -> Status {
        let Some(until) = self.until.get_mut(behavior.index()) else {
            return Status::Failure;
        };
        if self.ticks > *until {
            self.environment.begin(behavior.index());
        }
        let status = self.environment.act(behavior.index());
        if status == Status::Running {
            *until = self.ticks + 1;
        } else {
            *until = 0;
            self.terminations.push((behavior, status));
        }
        status
    }

    fn end_tick(&mut self) -> Tick {
        let Outcome { reward, end } = self.environment.step();
        for &(behavior, status) in &self.terminations {
            self.window.record(behavior, status);
        }
        let before = self.key;
        self.key = self.look();
        let line = |end| Ended::ALL.iter().position(|other| *other == end);
        let cut = (self.ticks >= self.limit).then_some(End::Cut);
        Tick {
            changed: self.key != before,
            terminated: !self.terminations.is_empty(),
            closed: false,
            reward: 0.0,
            flow: reward,
            end: end.and_then(line).map(End::On).or(cut),
            lost: end == Some(Ended::Bad),
        }
    }

    fn ticks(&self) -> u64 {
        self.ticks
    }

    fn events(&self) -> &[u64] {
        &[]
    }
}
