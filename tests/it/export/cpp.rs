//! BehaviorTree.CPP 4 on a small scale: it reads the exported file and ticks it as that library's sources say, so that
//! what the file means there is compared with what the tree means to btc.

use super::file::{Leaf, inside, leaf, leaves, only};
use super::play::{Play, Tick};
use super::trees::{Grower, Kinds, atoms};
use super::{names, written};
use crate::examples;
use crate::tree::build::{decorated, leaf as behavior, parallel};
use crate::tree::random::Random;
use btc::driver::export::Runtime;
use btc::ir::Program;
use btc::ir::tree::{Decorator, Node as Root, Status};
use roxmltree::{Document, Node as Element};
use std::collections::{BTreeMap, BTreeSet};

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
}

/// What goes on around the tree.
struct World<'a> {
    play: &'a Play,
    tick: usize,
    call: usize,
    calls: Vec<usize>,
    /// Whether a node asked for another tick at once.
    woken: bool,
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
        match self.kind {
            Kind::Always(status) => status,
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
                    if !self.finished.contains_key(&i) {
                        let status = child.tick(world);
                        if status != Status::Running {
                            self.finished.insert(i, status);
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

    /// Up to so many times as long as the child answers `with`.
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
                world.woken = true;
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
        woken: false,
    };
    let mut ticks = Vec::new();
    for tick in 0..play.valuations.len() {
        world.tick = tick;
        let mut status = root.tick(&mut world);
        while status == Status::Running && std::mem::take(&mut world.woken) {
            status = root.tick(&mut world);
        }
        let calls = std::mem::take(&mut world.calls);
        ticks.push(Tick { calls, status });
    }
    ticks
}

/// Plays with one tree, and gives how many behaviours were ticked.
fn compare(
    program: &Program,
    leaves: &BTreeMap<Leaf, (bool, usize)>,
    root: &Root,
    play: &Play,
    held: bool,
) -> usize {
    let text = written(program, root, Runtime::BtCpp).unwrap();
    let there = by_cpp(&text, leaves, play);
    let here = play.by_btc(program, root, held);
    if let Some(at) = (0..here.len()).find(|&at| here[at] != there[at]) {
        panic!(
            "tick {at}: {:?} here, {:?} there\n{text}",
            here[at], there[at]
        );
    }
    here.iter().map(|tick| tick.calls.len()).sum()
}

/// Plays with many random trees.
fn compare_many(kinds: Kinds, learned: bool) {
    let loaded = names();
    let program = &loaded.program;
    let (atoms, leaves) = (atoms(program), leaves(program));
    let mut calls = BTreeSet::new();
    for seed in 0..1000 {
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
        let play = Play::new(random, atoms.len(), 40, learned);
        calls.insert(compare(program, &leaves, &root, &play, learned));
    }
    assert!(calls.len() > 30, "the plays are all alike: {calls:?}");
}

/// Where no node moves on, tick by tick.
#[test]
fn plain_trees_do_the_same_in_each_tick() {
    let kinds = Kinds {
        counters: false,
        timeouts: true,
        all: true,
    };
    compare_many(kinds, false);
}

/// What btc does in several ticks under one valuation, BehaviorTree.CPP does in one.
#[test]
fn learned_trees_do_the_same_one_tick_earlier_at_each_step() {
    let kinds = Kinds {
        counters: true,
        timeouts: false,
        all: false,
    };
    compare_many(kinds, true);
}

#[test]
fn examples_do_the_same() {
    for name in examples::names() {
        let loaded = examples::example(&name);
        let program = &loaded.program;
        let (atoms, leaves) = (atoms(program), leaves(program));
        for tree in program.trees.values() {
            for seed in 0..50 {
                let play = Play::new(&mut Random::new(seed), atoms.len(), 60, false);
                let steady = play.without_failures();
                assert!(compare(program, &leaves, &tree.root, &steady, true) > 0);
            }
        }
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
        assert!(written(&loaded.program, &root, Runtime::BtCpp).is_err());
    }
    let asks = parallel(1, vec![low.clone(), low]);
    assert!(written(&loaded.program, &asks, Runtime::BtCpp).is_ok());
}
