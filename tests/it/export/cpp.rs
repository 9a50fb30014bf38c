//! BehaviorTree.CPP 4 on a small scale: it reads the exported file and ticks it as that library's sources say, so that
//! what the file means there is compared with what the tree means to btc.

use super::file::{Leaf, inside, leaf, leaves, only};
use super::play::{Play, Tick};
use super::trees::{Grower, Kinds, atoms};
use super::{names, written};
use crate::examples;
use crate::laws::build::{decorated, leaf as behavior, parallel};
use crate::laws::random::Random;
use btc::emit::form::TreeForm;
use btc::ir::Program;
use btc::ir::tree::{Decorator, Node as Root, Status};
use roxmltree::{Document, Node as Element};
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;

enum Kind {
    Condition(usize),
    Action(usize),
    Always(Status),
    /// `ReactiveSequence` goes on after success, `ReactiveFallback` after failure.
    Reactive(Status),
    /// `Sequence` and `Fallback` likewise.
    Resuming(Status),
    Parallel {
        successes: usize,
        failures: usize,
    },
    /// `Sequence` that runs for a tick behind each child but the last.
    Async,
    Script(String),
    Asks(String),
    Inverter,
    Force(Status),
    Retry(u32),
    Repeat(u32),
    Timeout(u64),
}

struct Node {
    kind: Kind,
    children: Vec<Node>,
    running: bool,
    /// The child to resume at; attempts or cycles that are over.
    count: usize,
    /// The children of a `Parallel` that have finished, with their answers.
    finished: BTreeMap<usize, Status>,
    /// When the timer fires, in ms.
    fires: Option<u64>,
    /// What runs when the node has ended.
    ended: Option<String>,
}

/// What goes on around the tree.
struct World<'a> {
    play: &'a Play,
    tick: usize,
    call: usize,
    calls: Vec<usize>,
    /// The blackboard.
    board: BTreeMap<String, i64>,
}

impl World<'_> {
    fn run(&mut self, code: &str) {
        for statement in code.split(';') {
            let words: Vec<&str> = statement.split_whitespace().collect();
            let [name, operator, value] = words[..] else {
                panic!("{code}");
            };
            let value: i64 = value.parse().unwrap();
            let entry = self.board.entry(name.to_owned()).or_default();
            match operator {
                ":=" => *entry = value,
                "+=" => *entry += value,
                _ => panic!("{code}"),
            }
        }
    }

    fn holds(&self, code: &str) -> bool {
        let words: Vec<&str> = code.split_whitespace().collect();
        let [name, operator, value] = words[..] else {
            panic!("{code}");
        };
        let (found, value): (i64, i64) = (self.board[name], value.parse().unwrap());
        match operator {
            "==" => found == value,
            "<" => found < value,
            _ => panic!("{code}"),
        }
    }
}

impl Node {
    fn read(element: Element, leaves: &BTreeMap<Leaf, (bool, usize)>) -> Self {
        let number = |name: &str| -> u32 { element.attribute(name).unwrap().parse().unwrap() };
        let kind = match element.tag_name().name() {
            "AlwaysSuccess" => Kind::Always(Status::Success),
            "AlwaysFailure" => Kind::Always(Status::Failure),
            "ReactiveSequence" => Kind::Reactive(Status::Success),
            "ReactiveFallback" => Kind::Reactive(Status::Failure),
            "Sequence" => Kind::Resuming(Status::Success),
            "Fallback" => Kind::Resuming(Status::Failure),
            "Parallel" => Kind::Parallel {
                successes: number("success_count") as usize,
                failures: number("failure_count") as usize,
            },
            "AsyncSequence" => Kind::Async,
            "Script" => Kind::Script(element.attribute("code").unwrap().to_owned()),
            "ScriptCondition" => Kind::Asks(element.attribute("code").unwrap().to_owned()),
            "Inverter" => Kind::Inverter,
            "ForceSuccess" => Kind::Force(Status::Success),
            "ForceFailure" => Kind::Force(Status::Failure),
            "RetryUntilSuccessful" => Kind::Retry(number("num_attempts")),
            "Repeat" => Kind::Repeat(number("num_cycles")),
            "Timeout" => Kind::Timeout(number("msec").into()),
            _ => match leaves[&leaf(element)] {
                (false, atom) => Kind::Condition(atom),
                (true, behavior) => Kind::Action(behavior),
            },
        };
        let children = inside(element).into_iter();
        Self {
            kind,
            children: children.map(|child| Self::read(child, leaves)).collect(),
            running: false,
            count: 0,
            finished: BTreeMap::new(),
            fires: None,
            ended: element.attribute("_onSuccess").map(str::to_owned),
        }
    }

    fn halt(&mut self) {
        self.running = false;
        self.count = 0;
        self.finished.clear();
        self.fires = None;
        self.children.iter_mut().for_each(Self::halt);
    }

    fn tick(&mut self, world: &mut World) -> Status {
        let status = self.answer(world);
        self.running = status == Status::Running;
        if !self.running {
            self.halt();
        }
        if let (false, Some(code)) = (self.running, &self.ended) {
            world.run(code);
        }
        status
    }

    fn answer(&mut self, world: &mut World) -> Status {
        let answer = |holds| {
            if holds {
                Status::Success
            } else {
                Status::Failure
            }
        };
        match &self.kind {
            Kind::Script(code) => {
                world.run(code);
                return Status::Success;
            }
            Kind::Asks(code) => return answer(world.holds(code)),
            _ => {}
        }
        match self.kind {
            Kind::Script(_) | Kind::Asks(_) => unreachable!(),
            Kind::Always(status) => status,
            Kind::Async => {
                while self.count < self.children.len() {
                    let status = self.children[self.count].tick(world);
                    if status != Status::Success {
                        return status;
                    }
                    self.count += 1;
                    if self.count < self.children.len() {
                        return Status::Running;
                    }
                }
                Status::Success
            }
            Kind::Condition(atom) => answer(world.play.valuations[world.tick][atom]),
            Kind::Action(behavior) => {
                let status = world.play.answer(behavior, world.call);
                world.call += 1;
                world.calls.push(behavior);
                status
            }
            Kind::Reactive(goes_on) => {
                for i in 0..self.children.len() {
                    let status = self.children[i].tick(world);
                    if status == Status::Running {
                        let others = self.children.iter_mut().enumerate();
                        others
                            .filter(|(j, _)| *j != i)
                            .for_each(|(_, other)| other.halt());
                    }
                    if status != goes_on {
                        return status;
                    }
                }
                goes_on
            }
            Kind::Resuming(goes_on) => {
                while self.count < self.children.len() {
                    let status = self.children[self.count].tick(world);
                    if status != goes_on {
                        return status;
                    }
                    self.count += 1;
                }
                goes_on
            }
            Kind::Parallel {
                successes,
                failures,
            } => {
                for (i, child) in self.children.iter_mut().enumerate() {
                    if let Entry::Vacant(place) = self.finished.entry(i) {
                        let status = child.tick(world);
                        if status != Status::Running {
                            place.insert(status);
                        }
                    }
                    let count = |s| self.finished.values().filter(|f| **f == s).count();
                    if count(Status::Success) >= successes {
                        return Status::Success;
                    }
                    if count(Status::Failure) >= failures {
                        return Status::Failure;
                    }
                }
                Status::Running
            }
            Kind::Inverter => match self.children[0].tick(world) {
                Status::Success => Status::Failure,
                Status::Failure => Status::Success,
                Status::Running => Status::Running,
            },
            Kind::Force(status) => match self.children[0].tick(world) {
                Status::Running => Status::Running,
                _ => status,
            },
            Kind::Retry(times) => self.again(world, times, Status::Failure),
            Kind::Repeat(times) => self.again(world, times, Status::Success),
            Kind::Timeout(msec) => {
                let now = world.tick as u64 * 100;
                if now >= *self.fires.get_or_insert(now + msec) {
                    return Status::Failure;
                }
                self.children[0].tick(world)
            }
        }
    }

    /// Up to this many times, as long as the child answers `with`.
    fn again(&mut self, world: &mut World, times: u32, with: Status) -> Status {
        loop {
            let fresh = !self.children[0].running;
            let status = self.children[0].tick(world);
            if status != with {
                return status;
            }
            self.count += 1;
            if self.count >= times as usize {
                return with;
            }
            if fresh {
                return Status::Running;
            }
        }
    }
}

/// What the tree of a file does.
fn by_cpp(text: &str, leaves: &BTreeMap<Leaf, (bool, usize)>, play: &Play) -> Vec<Tick> {
    let document = Document::parse(text).unwrap();
    let root = inside(only(&document, "BehaviorTree"))[0];
    let mut root = Node::read(root, leaves);
    let mut world = World {
        play,
        tick: 0,
        call: 0,
        calls: Vec::new(),
        board: BTreeMap::new(),
    };
    let mut ticks = Vec::new();
    for tick in 0..play.valuations.len() {
        world.tick = tick;
        let status = root.tick(&mut world);
        let calls = std::mem::take(&mut world.calls);
        ticks.push(Tick { calls, status });
    }
    ticks
}

/// A tree, and what it meets.
pub(super) type Case = (Root, Play);

/// Plays here and there; gives how many behaviours were ticked.
pub(super) fn compare(
    program: &Program,
    cases: &[Case],
    there: &[Vec<Tick>],
    files: &[String],
) -> usize {
    let mut calls = 0;
    assert_eq!(cases.len(), there.len());
    for (((root, play), there), text) in cases.iter().zip(there).zip(files) {
        let here = play.by_btc(program, root);
        if let Some(at) = (0..here.len()).find(|&at| here[at] != there[at]) {
            panic!(
                "tick {at}: {:?} here, {:?} there\n{text}",
                here[at], there[at]
            );
        }
        calls += here.iter().map(|tick| tick.calls.len()).sum::<usize>();
    }
    calls
}

/// Compares with the reading above.
fn compare_reading(program: &Program, cases: &[Case]) {
    let leaves = leaves(program);
    let files = files(program, cases);
    let plays = files.iter().zip(cases);
    let there: Vec<Vec<Tick>> = plays
        .map(|(text, (_, play))| by_cpp(text, &leaves, play))
        .collect();
    assert!(compare(program, cases, &there, &files) > 10 * cases.len());
}

pub(super) fn files(program: &Program, cases: &[Case]) -> Vec<String> {
    let file = |(root, _): &Case| written(program, root, TreeForm::BtCpp).unwrap();
    cases.iter().map(file).collect()
}

/// Random trees of these kinds with their plays.
pub(super) fn random(program: &Program, number: u64, kinds: Kinds, learned: bool) -> Vec<Case> {
    let atoms = atoms(program);
    let cases = (0..number).map(|seed| {
        let random = &mut Random::new(seed);
        let mut grower = Grower {
            random,
            atoms: &atoms,
            behaviors: program.behaviors.len(),
            kinds,
        };
        let root = match learned {
            false => grower.plain(4),
            true => grower.learned(2),
        };
        (root, Play::new(random, atoms.len(), 40, learned))
    });
    cases.collect()
}

pub(super) const PLAIN: Kinds = Kinds {
    counters: true,
    timeouts: true,
    all: true,
};
pub(super) const LEARNED: Kinds = Kinds {
    counters: true,
    timeouts: false,
    all: false,
};

/// Trees of every node, tick by tick.
#[test]
fn plain_trees_do_the_same_in_each_tick() {
    let program = names().program;
    compare_reading(&program, &random(&program, 1000, PLAIN, false));
}

#[test]
fn learned_trees_do_the_same_in_each_tick() {
    let program = names().program;
    compare_reading(&program, &random(&program, 1000, LEARNED, true));
}

#[test]
fn examples_do_the_same() {
    on_examples(compare_reading);
}

/// Compares the trees of the examples.
pub(super) fn on_examples(compare: fn(&Program, &[Case])) {
    for name in examples::names() {
        let program = examples::example(&name).program;
        let atoms = atoms(&program);
        let mut cases = Vec::new();
        for tree in program.trees.values() {
            for seed in 0..20 {
                let play = Play::new(&mut Random::new(seed), atoms.len(), 60, false);
                cases.push((tree.root.clone(), play));
            }
        }
        compare(&program, &cases);
    }
}

/// `Parallel` does not ask a child again that has finished, so what would differ is not written.
#[test]
fn a_parallel_that_would_remember_is_refused() {
    let loaded = names();
    let low = super::trees::subjects(&loaded.program).0.swap_remove(0);
    for root in [
        parallel(2, vec![low.clone(), behavior(0)]),
        parallel(
            1,
            vec![low.clone(), decorated(Decorator::Retry(2), low.clone())],
        ),
    ] {
        assert!(written(&loaded.program, &root, TreeForm::BtCpp).is_err());
    }
    let asks = parallel(1, vec![low.clone(), low]);
    assert!(written(&loaded.program, &asks, TreeForm::BtCpp).is_ok());
}
