//! Tests of trees without a world: predicates and answers are scripted, and what the tree does is held against what is expected.

use crate::ir::Id;
use crate::ir::history::Window;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::test::{Expected, Line};
use crate::ir::tree::{Atom, Node, Status};
use crate::tree::Runner;
use crate::tree::atoms::atoms;
use crate::tree::tick::Surroundings;
use std::collections::BTreeSet;

/// What came of a test.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outcome {
    /// How many ticks the tree was ticked.
    pub ticks: u64,
    /// How often each node gave each answer, in pre-order.
    pub nodes: Vec<Answers>,
    /// Where the tree first did something else than expected; nothing is ticked after that.
    pub failed: Option<Failed>,
}

/// How often a node gave each answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Answers {
    /// Success.
    pub success: u64,
    /// Failure.
    pub failure: u64,
    /// Running.
    pub running: u64,
}

impl Answers {
    /// How often it was ticked.
    pub fn ticks(&self) -> u64 {
        self.success + self.failure + self.running
    }

    /// Takes in the answers of the same node elsewhere.
    pub fn add(&mut self, other: &Self) {
        self.success += other.success;
        self.failure += other.failure;
        self.running += other.running;
    }

    /// Takes in an answer.
    pub fn count(&mut self, status: Status) {
        match status {
            Status::Success => self.success += 1,
            Status::Failure => self.failure += 1,
            Status::Running => self.running += 1,
        }
    }
}

/// The tick in which a tree did something else than expected.
#[derive(Clone, Debug, PartialEq)]
pub struct Failed {
    /// The line of the test.
    pub line: usize,
    /// The number of the tick, from one.
    pub tick: u64,
    /// What parts the two.
    pub parts: Parts,
    /// What held, of all that the tree asks.
    pub held: Vec<Atom>,
    /// The nodes that were ticked and what they answered, in the order of their answers.
    pub path: Vec<(usize, Status)>,
    /// The behaviours that were ticked, in their order, with the answers that they were given.
    pub ticked: Vec<(Id<Behavior>, Status)>,
    /// What the tree answered.
    pub answer: Status,
}

/// What parts what was expected from what was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parts {
    /// The behaviour at this place of those expected: another one was ticked there, or none.
    Behavior(usize),
    /// As many were expected, and more were ticked.
    More(usize),
    /// The answer of the tree.
    Answer,
}

/// Ticks a tree with fresh memory as the lines say, up to the first tick that is not as expected.
pub fn play(root: &Node, history: History, lines: &[Line]) -> Outcome {
    let asked: Vec<Atom> = atoms(root).into_iter().collect();
    let mut outcome = Outcome {
        nodes: vec![Answers::default(); count(root)],
        ..Outcome::default()
    };
    // The atoms are those that its own guards ask, so that none is missing.
    let Ok(mut runner) = Runner::new(root, &asked) else {
        return outcome;
    };
    let mut holds: BTreeSet<Atom> = BTreeSet::new();
    let mut window = Window::new(history);
    for (at, line) in lines.iter().enumerate() {
        for &(predicate, value) in &line.changes {
            match value {
                true => holds.insert(Atom::Predicate(predicate)),
                false => holds.remove(&Atom::Predicate(predicate)),
            };
        }
        let Some(expected) = &line.expected else {
            continue;
        };
        for _ in 0..expected.ticks {
            let held = |atom: &&Atom| holds.contains(atom) || window.shows(**atom);
            let held: Vec<Atom> = asked.iter().filter(held).copied().collect();
            let mut stage = Stage::new(&asked, &held, expected);
            let answer = runner.tick_in(&mut stage);
            outcome.ticks += 1;
            for &(node, status) in &stage.path {
                if let Some(answers) = outcome.nodes.get_mut(node) {
                    answers.count(status);
                }
            }
            for &(behavior, status) in &stage.ticked {
                window.record(behavior, status);
            }
            if let Some(parts) = parts(expected, &stage.ticked, answer) {
                outcome.failed = Some(Failed {
                    line: at,
                    tick: outcome.ticks,
                    parts,
                    path: stage.path,
                    ticked: stage.ticked,
                    held,
                    answer,
                });
                return outcome;
            }
        }
    }
    outcome
}

/// What parts the expected from the behaviours that were ticked and the answer of the tree.
fn parts(expected: &Expected, ticked: &[(Id<Behavior>, Status)], answer: Status) -> Option<Parts> {
    let done = |at: usize| ticked.get(at).map(|(behavior, _)| *behavior);
    let wanted = expected.behaviors.iter().enumerate();
    let mut wanted = wanted.map(|(at, (behavior, _))| (at, *behavior));
    if let Some((at, _)) = wanted.find(|&(at, behavior)| done(at) != Some(behavior)) {
        return Some(Parts::Behavior(at));
    }
    let wanted = expected.answer?;
    let many = expected.behaviors.len();
    match done(many) {
        Some(_) => Some(Parts::More(many)),
        None => (wanted != answer).then_some(Parts::Answer),
    }
}

/// How many nodes a tree has.
pub fn count(node: &Node) -> usize {
    1 + node.children().iter().map(count).sum::<usize>()
}

/// What a tick meets.
struct Stage<'a> {
    valuation: Vec<u64>,
    expected: &'a Expected,
    ticked: Vec<(Id<Behavior>, Status)>,
    path: Vec<(usize, Status)>,
}

impl<'a> Stage<'a> {
    fn new(asked: &[Atom], held: &[Atom], expected: &'a Expected) -> Self {
        let mut valuation = vec![0; asked.len().div_ceil(64)];
        for (bit, _) in asked
            .iter()
            .enumerate()
            .filter(|(_, atom)| held.contains(atom))
        {
            if let Some(word) = valuation.get_mut(bit / 64) {
                *word |= 1 << (bit % 64);
            }
        }
        Self {
            valuation,
            expected,
            ticked: Vec::new(),
            path: Vec::new(),
        }
    }
}

impl Surroundings for Stage<'_> {
    fn matches(&mut self, word: usize, mask: u64, value: u64) -> bool {
        self.valuation.get(word).copied().unwrap_or(0) & mask == value
    }

    /// A behaviour has one answer in a tick, wherever it is ticked; it runs if the test does not say.
    fn behavior(&mut self, behavior: Id<Behavior>) -> Status {
        let mut said = self.expected.behaviors.iter();
        let said = said.find(|(expected, _)| *expected == behavior);
        let status = said.map_or(Status::Running, |(_, status)| *status);
        if !self.ticked.contains(&(behavior, status)) {
            self.ticked.push((behavior, status));
        }
        status
    }

    fn answered(&mut self, node: usize, status: Status) {
        self.path.push((node, status));
    }
}
